// A loop over threads for trials that do not know of each other.
#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace patchlab::test {

// body(i) for every i in [0, count), in any order, on `threads` threads. What it writes must belong to i
// alone.
inline void for_each_index(int count, int threads, const std::function<void(int)>& body) {
  std::atomic<int> next = 0;
  const auto work = [&] {
    for (int i = next++; i < count; i = next++) body(i);
  };
  std::vector<std::jthread> others;
  for (int t = 1; t < std::min(threads, count); ++t) others.emplace_back(work);
  work();
}

}  // namespace patchlab::test
