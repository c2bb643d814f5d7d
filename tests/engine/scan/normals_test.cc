#include "engine/scan/normals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace patchlab {
namespace {

// A tilted plane at z near 1, seen from the origin; the first point is missing.
Scan tilted_plane() {
  Scan scan;
  for (int row = 0; row < 10; ++row) {
    for (int column = 0; column < 10; ++column) {
      const float x = 0.01F * static_cast<float>(column), y = 0.01F * static_cast<float>(row);
      scan.positions.emplace_back(x, y, 1.0F + 0.5F * x);
    }
  }
  scan.width = 100;
  scan.finite.assign(100, 1);
  scan.positions[0].setConstant(std::numeric_limits<float>::quiet_NaN());
  scan.finite[0] = 0;
  scan.finite_count = 99;
  return scan;
}

const Eigen::Vector3f towards_origin = Eigen::Vector3f(0.5F, 0, -1).normalized();

TEST(Normals, ArePerpendicularToThePlaneAndTurnedToTheSensor) {
  Scan scan = tilted_plane();
  const std::vector<Eigen::Vector3f> normals = estimate_normals(scan);
  for (std::size_t i = 1; i < normals.size(); ++i)
    EXPECT_LT((normals[i] - towards_origin).norm(), 1e-4F) << i;
  scan.viewpoint.position = {0, 0, 3};
  EXPECT_LT((estimate_normals(scan)[50] + towards_origin).norm(), 1e-4F);
}

TEST(Normals, FollowTheSensorPositionOfEachPoint) {
  Scan scan = tilted_plane();
  scan.viewpoints.assign(100, Eigen::Vector3f(0, 0, 0));
  scan.viewpoints[42] = {0, 0, 3};
  const std::vector<Eigen::Vector3f> normals = estimate_normals(scan);
  EXPECT_LT((normals[41] - towards_origin).norm(), 1e-4F);
  EXPECT_LT((normals[42] + towards_origin).norm(), 1e-4F);
}

TEST(Normals, DoNotDependOnWhereTheOriginLies) {
  Scan scan = tilted_plane();
  scan.origin = scan.viewpoint.position = {5e5, 5e6, 100};
  EXPECT_LT((estimate_normals(scan)[50] - towards_origin).norm(), 1e-4F);
}

TEST(Normals, AreMissingWhereThePointIs) {
  Scan scan = tilted_plane();
  EXPECT_TRUE(std::isnan(estimate_normals(scan)[0].x()));
  EXPECT_TRUE(estimate_normals(scan)[1].allFinite());
  scan.finite.assign(100, 0);
  scan.finite_count = 0;
  EXPECT_TRUE(std::isnan(estimate_normals(scan)[1].x()));
}

}  // namespace
}  // namespace patchlab
