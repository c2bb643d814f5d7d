#include "tests/fuzz/allocation_watch.h"

#include <algorithm>
#include <atomic>

// Of the sanitizer's run-time library; null in a build without it.
extern "C" {
__attribute__((weak)) int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void*,
                                                                                      std::size_t),
                                                                    void (*on_free)(const volatile void*));
__attribute__((weak)) std::size_t __sanitizer_get_allocated_size(const volatile void* memory);
}

namespace patchlab::test {
namespace {

std::atomic<std::ptrdiff_t> held = 0, peak = 0;
std::atomic<std::size_t> largest = 0;

void on_malloc(const volatile void*, std::size_t size) {
  largest = std::max(largest.load(), size);
  held += static_cast<std::ptrdiff_t>(size);
  peak = std::max(peak.load(), held.load());
}

void on_free(const volatile void* memory) {
  if (memory != nullptr) held -= static_cast<std::ptrdiff_t>(__sanitizer_get_allocated_size(memory));
}

bool install() {
  return __sanitizer_install_malloc_and_free_hooks != nullptr &&
         __sanitizer_install_malloc_and_free_hooks(on_malloc, on_free) != 0;
}

}  // namespace

bool allocations_are_counted() {
  static const bool installed = install();
  return installed;
}

void watch_allocations() {
  if (!allocations_are_counted()) return;
  held = 0;
  peak = 0;
  largest = 0;
}

Allocations watched_allocations() { return {largest, static_cast<std::size_t>(peak.load())}; }

}  // namespace patchlab::test
