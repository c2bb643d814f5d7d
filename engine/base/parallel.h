// Work shared over the processor's threads, with the same bytes as result however many there are: what is
// computed depends on the chunks alone, and these on `count` and `grain` alone.
#pragma once

#include <cstddef>

namespace patchlab {

// A part [first, last) of some items.
struct Chunk {
  std::size_t number = 0, first = 0, last = 0;
};

inline std::size_t chunk_count(std::size_t count, std::size_t grain) { return (count + grain - 1) / grain; }

// A function of chunks that takes nothing from the heap.
struct ChunkWork {
  const void* work = nullptr;
  void (*call)(const void* work, const Chunk& chunk) = nullptr;
};
void run_chunks(std::size_t count, std::size_t grain, const ChunkWork& work);

// Calls `work` once for each chunk of `grain` items of `count` (the last may be smaller), in no order and
// from several threads at once; returns when all are done. One chunk: on the calling thread, without any
// overhead. `work` must not throw. Precondition: grain > 0.
template <class Work>
void for_each_chunk(std::size_t count, std::size_t grain, const Work& work) {
  const auto call = [](const void* w, const Chunk& chunk) { (*static_cast<const Work*>(w))(chunk); };
  run_chunks(count, grain, {&work, call});
}

// How many threads take part.
std::size_t thread_count();

}  // namespace patchlab
