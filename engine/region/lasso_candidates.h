// The hot loop of the lasso: which of many points may lie in a polygon's grid of cells. In float32, with its
// rounding bounded; what that could decide wrongly is left open. For x86-64 and, chosen at run time, for AVX2
// with FMA.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/region/cell_camera.h"
#include "engine/region/polygon_mask.h"

namespace patchlab {

// Which of up to `capacity` points are candidates: point i is bit i % 64 of word i / 64.
struct LassoCandidates {
  static constexpr std::size_t capacity = 1024;
  using Bits = std::array<std::uint64_t, capacity / 64>;
  Bits points;  // those not surely outside
  Bits open;    // which of them only the exact test can tell
};

// Of `count` points x y z. Those not left open are in the polygon. Precondition: the grid has rows, count is
// at most LassoCandidates::capacity.
void find_candidates(const CellCamera& camera, const PolygonMask::Grid& grid, const float* xyz,
                     std::size_t count, LassoCandidates& found);
std::size_t count_bits(std::span<const std::uint64_t> bits);
// Writes `first` + i for each bit i that is set. Precondition: `numbers` has place for just these.
void write_numbers(std::span<const std::uint64_t> bits, std::uint32_t first,
                   std::span<std::uint32_t> numbers);

// The same for any processor: what the others are held to.
void find_candidates_plain(const CellCamera& camera, const PolygonMask::Grid& grid, const float* xyz,
                           std::size_t count, LassoCandidates& found);
void write_numbers_plain(std::span<const std::uint64_t> bits, std::uint32_t first,
                         std::span<std::uint32_t> numbers);

}  // namespace patchlab
