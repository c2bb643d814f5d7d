#include "engine/base/parallel.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace patchlab {

void run_chunks(std::size_t count, std::size_t grain, const ChunkWork& work) {
  const std::size_t chunks = chunk_count(count, grain);
  const auto run = [&](std::size_t number) {
    work.call(work.work, {number, number * grain, std::min(count, (number + 1) * grain)});
  };
  if (chunks == 1) return run(0);
  tbb::parallel_for(std::size_t{0}, chunks, run, tbb::simple_partitioner());
}

std::size_t thread_count() { return static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()); }

}  // namespace patchlab
