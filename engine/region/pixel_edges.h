// Pixels of an organised scan at the edge of what they see: a depth camera's ray there meets two surfaces,
// and the point it reports lies beside either of them by up to a pixel.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/scan/scan.h"

namespace patchlab {

struct PixelEdges {
  std::vector<std::uint8_t>
      at_edge;         // one an id: 1 where a neighbour of the eight is missing or jumps in depth
  double pitch = 0.0;  // rad, between the rays of neighbouring pixels; 0 where none is known
};

// Of the ids, in their order. A jump is more than 2 % of the depth: what a surface reaches at 5 degrees of
// grazing incidence in a camera of 525 pixels. Empty for scans without a pixel grid. Precondition: the ids
// are finite points.
PixelEdges pixel_edges(const Scan& scan, std::span<const std::uint32_t> ids);

}  // namespace patchlab
