// Loops of a few turns that are written out by the compiler: each turn knows its number.
#pragma once

#include <type_traits>
#include <utility>

namespace patchlab {

// what(0), what(1), ... what(count - 1), each number a std::integral_constant.
template <int count, class What>
void repeat(const What& what) {
  [&]<int... i>(std::integer_sequence<int, i...>) { (what(std::integral_constant<int, i>{}), ...); }
  (std::make_integer_sequence<int, count>{});
}

}  // namespace patchlab
