#include "viewer/render/resident_cache.h"

#include <gtest/gtest.h>

#include <vector>

namespace patchlab::viewer {
namespace {

using Array = std::vector<int>;

class ResidentCacheTest : public testing::Test {
 protected:
  std::size_t get(const std::shared_ptr<const Array>& array) {
    return cache.get(array, [this](const Array& values) {
      ++made;
      return values.size();
    });
  }
  ResidentCache<std::size_t> cache;
  int made = 0;
};

TEST_F(ResidentCacheTest, AnArrayIsMadeResidentOnce) {
  const auto array = std::make_shared<const Array>(3);
  EXPECT_EQ(get(array), 3u);
  EXPECT_EQ(get(array), 3u);
  EXPECT_EQ(made, 1);
}

TEST_F(ResidentCacheTest, AnotherArrayAtTheSameAddressIsAnotherArray) {
  Array storage(3);
  const auto unowned = [](const Array*) {};
  get(std::shared_ptr<const Array>(&storage, unowned));
  storage.resize(5);
  EXPECT_EQ(get(std::shared_ptr<const Array>(&storage, unowned)), 5u);
  EXPECT_EQ(made, 2);
}

TEST_F(ResidentCacheTest, ArraysThatNobodyHoldsAreDropped) {
  const auto held = std::make_shared<const Array>(1);
  auto let_go = std::make_shared<const Array>(2);
  get(held);
  get(let_go);
  cache.drop_unheld();
  EXPECT_EQ(cache.size(), 2u);
  let_go.reset();
  cache.drop_unheld();
  EXPECT_EQ(cache.size(), 1u);
}

}  // namespace
}  // namespace patchlab::viewer
