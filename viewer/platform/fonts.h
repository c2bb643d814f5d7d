// The embedded fonts, put into ImGui's atlas.
#pragma once

#include "viewer/platform/embedded.h"
#include "viewer/platform/platform.h"

namespace patchlab::viewer {

// Replaces what the atlas of the current ImGui context holds. The caller remakes the texture.
Fonts load_fonts(float scale);

namespace font_files {
extern const Embedded Inter_Regular_otf, Inter_SemiBold_otf;
}  // namespace font_files

}  // namespace patchlab::viewer
