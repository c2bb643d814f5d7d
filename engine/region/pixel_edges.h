// Pixels of an organised scan at the edge of what they see: a depth camera's ray there meets two surfaces,
// and the point it reports lies beside either of them by up to a pixel or two.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/scan/scan.h"

namespace patchlab {

// One an id, in their order: 1 where a neighbour of the eight is missing or jumps in depth, by more than 2 %
// of the depth (what a surface reaches at 5 degrees of grazing incidence in a camera of 525 pixels) and by
// more than its noise: four standard deviations of a difference, `sigmas` those of the depths (m, one an id).
// Empty for scans without a pixel grid. Precondition: the ids are finite points.
std::vector<std::uint8_t> pixel_edges(const Scan& scan, std::span<const std::uint32_t> ids,
                                      std::span<const double> sigmas);

}  // namespace patchlab
