// Draws a scene with OpenGL 3.3 core into the bound framebuffer (RGBA8, 24 bits of depth). A current GL
// context is required for its whole life. Where OpenGL is software and the framebuffer not multisampled, the
// processor draws the points. Colours are sRGB and blended as such.
#pragma once

#include <memory>

#include "engine/base/result.h"
#include "engine/region/lasso.h"
#include "viewer/render/scene.h"

namespace patchlab::viewer {

struct Viewport {
  int x = 0, y = 0, width = 0, height = 0;  // framebuffer pixels, y from the lower edge
};

class Renderer {
 public:
  // Compiles the embedded shaders; in a debug build they are read from `shaders/` of the source tree when it
  // is there.
  static Result<Renderer> create();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  // camera.viewport is ignored in favour of `viewport`.
  void draw(const Scene& scene, const ViewCamera& camera, const Viewport& viewport);

 private:
  struct State;
  explicit Renderer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace patchlab::viewer
