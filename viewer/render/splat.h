// Points drawn by the processor: where OpenGL itself is software, this is many times faster than drawing them
// with it.
#pragma once

#include <cstdint>
#include <vector>

#include "viewer/render/scene.h"
#include "viewer/render/view.h"

namespace patchlab::viewer {

// Row by row from the lower edge, as OpenGL has it.
struct Raster {
  int width = 0, height = 0;
  std::vector<Rgba8> colours;
  std::vector<std::uint32_t> depths;  // of the depth buffer: 0 near to 2^32 - 1 far

  // A point where it is drawn. Room for some is kept from one picture to the next.
  struct Splat {
    int x_parts, y_parts;  // 1/8 px
    std::uint32_t depth;
    Rgba8 colour;
  };
  std::vector<Splat> splats, by_band;

  // The background alone.
  void clear(int w, int h, const Rgba& bottom, const Rgba& top);
};

// Adds the points as antialiased disks, as points.vert and points.frag do. Precondition: as many colours as
// positions.
void splat(Raster& raster, const PointsItem& item, const View& view, const PointFade& fade);

}  // namespace patchlab::viewer
