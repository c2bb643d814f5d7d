// Whether OpenGL is drawn by the processor: some things are better done in another way then.
#pragma once

#include <epoxy/gl.h>

#include <string_view>

namespace patchlab::viewer {

// Of the current context.
inline bool is_software_gl() {
  const std::string_view renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return renderer.find("llvmpipe") != std::string_view::npos ||
         renderer.find("softpipe") != std::string_view::npos;
}

}  // namespace patchlab::viewer
