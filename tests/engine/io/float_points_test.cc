#include "engine/io/float_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <limits>
#include <string>

#include "engine/base/random.h"

namespace patchlab {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Points of three floats, the last one at the very end of the memory.
std::vector<char> memory_of(const std::vector<std::array<float, 3>>& points, std::size_t stride) {
  std::vector<char> memory(points.empty() ? 0 : (points.size() - 1) * stride + 12, '\xff');
  for (std::size_t i = 0; i < points.size(); ++i)
    std::memcpy(memory.data() + i * stride, points[i].data(), 12);
  return memory;
}

struct Taken {
  std::vector<std::array<std::uint32_t, 3>> positions;  // as bits, so that NaN equals NaN
  std::vector<std::uint8_t> finite;
  FloatSurvey survey;
};

Taken take(decltype(take_floats)& function, const std::vector<char>& memory, std::size_t stride,
           std::size_t points) {
  std::array<Column, 3> columns;
  for (std::size_t axis = 0; axis < 3; ++axis)
    columns[axis] = {std::string(1, "xyz"[axis]), Scalar::float32, 1, memory.data() + 4 * axis, stride};
  std::vector<Eigen::Vector3f> positions(points);
  Taken taken;
  taken.finite.assign(points, 1);
  taken.survey =
      function({&columns[0], &columns[1], &columns[2]}, points, positions.data(), taken.finite.data());
  for (const Eigen::Vector3f& p : positions)
    taken.positions.push_back(std::bit_cast<std::array<std::uint32_t, 3>>(std::array{p[0], p[1], p[2]}));
  return taken;
}

void expect_same(const Taken& a, const Taken& b) {
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.finite, b.finite);
  EXPECT_EQ(a.survey.low, b.survey.low);
  EXPECT_EQ(a.survey.high, b.survey.high);
  EXPECT_EQ(a.survey.finite, b.survey.finite);
  EXPECT_EQ(a.survey.strange, b.survey.strange);
}

TEST(TakeFloats, IsThePlainOneForAnyStrideAndCountWithHolesAndDamage) {
  Random random(31);
  constexpr float odd[] = {kNaN, kInfinity, -kInfinity, 2e7F, -3e38F, 1e-33F, -1e-44F, 0.0F, 1e7F, 1e-30F};
  for (const double damaged : {0.0, 0.001, 0.2}) {
    for (const std::size_t stride : {12u, 15u, 16u, 32u}) {
      for (const std::size_t count : {1u, 2u, 255u, 256u, 257u, 258u, 2000u}) {
        std::vector<std::array<float, 3>> points(count);
        for (auto& p : points) {
          for (float& value : p) {
            value = static_cast<float>(random.uniform(-5.0, 5.0));
            if (random.uniform() < damaged) value = odd[random.index(std::size(odd))];
          }
        }
        const std::vector<char> memory = memory_of(points, stride);
        const Taken expected = take(take_floats_plain, memory, stride, count);
        expect_same(take(take_floats, memory, stride, count), expected);
      }
    }
  }
}

TEST(TakeFloats, SaysWhatItSaw) {
  const std::vector<char> memory =
      memory_of({{1, 2, 3}, {kNaN, 0, 0}, {-4, 0, 2e7F}, {0, 5, 1e-31F}, {0, 0, kInfinity}, {0, 0, 0}}, 12);
  const Taken taken = take(take_floats, memory, 12, 6);
  EXPECT_THAT(taken.finite, testing::ElementsAre(1, 0, 1, 1, 0, 1));
  EXPECT_EQ(taken.survey.finite, 4u);
  EXPECT_EQ(taken.survey.strange, 2u);
  EXPECT_THAT(taken.survey.low, testing::ElementsAre(-4.0F, 0.0F, 0.0F));
  EXPECT_THAT(taken.survey.high, testing::ElementsAre(1.0F, 5.0F, 2e7F));
}

}  // namespace
}  // namespace patchlab
