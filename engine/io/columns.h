// Point attributes as they lie in memory: what a PCD, PLY or table reader hands over to become a Scan.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace patchlab {

enum class Scalar { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

std::string_view name(Scalar type);  // "float32" ...
std::size_t size_of(Scalar type);    // bytes

// One named attribute of n points, `count` values a point. Value `element` of point i starts at byte
// first + i stride + element size_of(type); no alignment is assumed. It does not own the memory.
struct Column {
  std::string name;
  Scalar type = Scalar::float32;
  std::uint32_t count = 1;
  const char* first = nullptr;
  std::size_t stride = 0;
  bool swapped = false;  // the bytes of a value are in the other order than this machine's
};

// The column of that name; nullptr where there is none.
const Column* find_column(std::span<const Column> columns, std::string_view name);

// The columns of these names that have one value a point, nullptr for each that is missing.
template <std::size_t N>
std::array<const Column*, N> find_columns(std::span<const Column> columns,
                                          const std::array<std::string_view, N>& names) {
  std::array<const Column*, N> found{};
  std::ranges::transform(names, found.begin(), [&](std::string_view name) {
    const Column* column = find_column(columns, name);
    return column != nullptr && column->count == 1 ? column : nullptr;
  });
  return found;
}
template <std::size_t N>
bool is_complete(const std::array<const Column*, N>& found) {
  return std::ranges::count(found, nullptr) == 0;
}

// One element of every point as double: to[0], to[step], to[2 step] ...
void gather(const Column& column, std::size_t points, std::uint32_t element, double* to, std::size_t step);
std::vector<double> values(const Column& column, std::size_t points, std::uint32_t element = 0);

// Reads the text as a value of the type and stores it at `to`; false where it is none (see parse_number).
bool store_number(std::string_view text, Scalar type, char* to);

}  // namespace patchlab
