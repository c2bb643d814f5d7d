#include "engine/io/columns.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "engine/io/text_numbers.h"

namespace patchlab {
namespace {

template <class T>
void gather_typed(const Column& column, std::size_t points, std::uint32_t element, double* to,
                  std::size_t step) {
  const char* from = column.first + element * sizeof(T);
  for (std::size_t i = 0; i < points; ++i, from += column.stride) {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), from, sizeof(T));
    if (column.swapped) std::ranges::reverse(bytes);
    T value;
    std::memcpy(&value, bytes.data(), sizeof(T));
    to[i * step] = static_cast<double>(value);
  }
}

template <class T>
bool store(std::string_view text, char* to) {
  const std::optional<T> value = parse_number<T>(text);
  if (value) std::memcpy(to, &*value, sizeof(T));
  return value.has_value();
}

struct ScalarRow {
  std::string_view name;
  std::size_t size;
  void (*gather)(const Column& column, std::size_t points, std::uint32_t element, double* to,
                 std::size_t step);
  bool (*store)(std::string_view text, char* to);
};

template <class T>
constexpr ScalarRow row(std::string_view name) {
  return {name, sizeof(T), gather_typed<T>, store<T>};
}

// In the order of Scalar.
constexpr ScalarRow scalars[] = {
    row<std::int8_t>("int8"),     row<std::uint8_t>("uint8"),   row<std::int16_t>("int16"),
    row<std::uint16_t>("uint16"), row<std::int32_t>("int32"),   row<std::uint32_t>("uint32"),
    row<std::int64_t>("int64"),   row<std::uint64_t>("uint64"), row<float>("float32"),
    row<double>("float64"),
};

const ScalarRow& row_of(Scalar type) { return scalars[static_cast<std::size_t>(type)]; }

}  // namespace

std::string_view name(Scalar type) { return row_of(type).name; }

std::size_t size_of(Scalar type) { return row_of(type).size; }

const Column* find_column(std::span<const Column> columns, std::string_view name) {
  const auto found = std::ranges::find(columns, name, &Column::name);
  return found == columns.end() ? nullptr : &*found;
}

void gather(const Column& column, std::size_t points, std::uint32_t element, double* to, std::size_t step) {
  row_of(column.type).gather(column, points, element, to, step);
}

std::vector<double> values(const Column& column, std::size_t points, std::uint32_t element) {
  std::vector<double> out(points);
  gather(column, points, element, out.data(), 1);
  return out;
}

bool store_number(std::string_view text, Scalar type, char* to) { return row_of(type).store(text, to); }

}  // namespace patchlab
