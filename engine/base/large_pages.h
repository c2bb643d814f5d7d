// Memory for millions of points: taken in large pages where the system has them, which costs a fraction of
// the page faults.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace patchlab {

// Reserves memory for `size` elements. A hint, and nothing else, to the system.
template <class T>
void reserve_large(std::vector<T>& elements, std::size_t size) {
  elements.reserve(size);
#ifdef MADV_HUGEPAGE
  constexpr std::uintptr_t page = std::uintptr_t{2} << 20;
  const auto begin = (reinterpret_cast<std::uintptr_t>(elements.data()) + page - 1) / page * page;
  const auto end = (reinterpret_cast<std::uintptr_t>(elements.data()) + size * sizeof(T)) / page * page;
  if (begin < end) ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
}

}  // namespace patchlab
