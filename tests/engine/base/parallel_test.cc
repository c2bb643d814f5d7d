#include "engine/base/parallel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <vector>

namespace patchlab {
namespace {

TEST(ForEachChunk, EveryItemIsInOneChunkAndTheChunksAreThoseThatWereAskedFor) {
  for (const std::size_t count : {0u, 1u, 99u, 100u, 101u, 1234u}) {
    std::vector<int> times(count);  // each item belongs to one chunk's thread
    std::vector<Chunk> chunks(chunk_count(count, 100));
    for_each_chunk(count, 100, [&](const Chunk& chunk) {
      chunks[chunk.number] = chunk;
      for (std::size_t i = chunk.first; i < chunk.last; ++i) ++times[i];
    });
    EXPECT_THAT(times, testing::Each(1)) << count;
    for (std::size_t k = 0; k < chunks.size(); ++k) EXPECT_EQ(chunks[k].first, 100 * k);
  }
}

TEST(ForEachChunk, TheChunksAreTheSameOnOneThread) {
  std::vector<std::size_t> ends(7);
  tbb::task_arena(1).execute([&] {
    EXPECT_EQ(thread_count(), 1u);
    for_each_chunk(65, 10, [&](const Chunk& chunk) { ends[chunk.number] = chunk.last; });
  });
  EXPECT_THAT(ends, testing::ElementsAre(10, 20, 30, 40, 50, 60, 65));
}

}  // namespace
}  // namespace patchlab
