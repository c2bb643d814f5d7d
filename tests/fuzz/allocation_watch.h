// How much memory a piece of work takes, as the address sanitizer's allocator counts it; without that
// sanitizer nothing is counted.
#pragma once

#include <cstddef>

namespace patchlab::test {

struct Allocations {
  std::size_t largest = 0;  // of one allocation, bytes
  std::size_t peak = 0;     // of what was held at once beyond what was held before, bytes
};

bool allocations_are_counted();

// Counts from here on.
void watch_allocations();
Allocations watched_allocations();

}  // namespace patchlab::test
