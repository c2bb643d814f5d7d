// The files of shaders/, embedded at build time.
#pragma once

#include "viewer/platform/embedded.h"

namespace patchlab::viewer::shaders {

extern const Embedded background_vert, background_frag, points_vert, points_frag, mesh_vert, mesh_frag,
    lines_vert, lines_frag;

}  // namespace patchlab::viewer::shaders
