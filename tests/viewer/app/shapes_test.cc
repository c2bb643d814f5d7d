#include "viewer/app/shapes.h"

#include <gtest/gtest.h>

#include "viewer/app/patch_scene.h"

namespace patchlab::viewer {
namespace {

TEST(Exaggeration, IsTheLargestRoundNumberThatFits) {
  EXPECT_EQ(exaggeration(0.001, 0.0101), 10);
  EXPECT_EQ(exaggeration(0.001, 0.0099), 5);
  EXPECT_EQ(exaggeration(0.001, 0.0020001), 2);
  EXPECT_EQ(exaggeration(0.001, 0.0551), 50);
}

TEST(Exaggeration, NeverMakesAnythingSmaller) { EXPECT_EQ(exaggeration(1.0, 0.1), 1); }

TEST(Exaggeration, IsSaidInWords) {
  EXPECT_EQ(exaggeration_words(10, "larger"), "drawn 10 times larger");
  EXPECT_EQ(exaggeration_words(1, "larger"), "at true size");
}

Ellipsoid example() { return {{1, 2, 3}, Eigen::Matrix3d::Identity(), {0.3, 0.2, 0.1}}; }

TEST(EllipsoidMesh, LiesOnTheEllipsoidThatManyTimesLarger) {
  const Ellipsoid shape = example();
  const MeshItem mesh = ellipsoid_mesh(shape, 5, {1, 0, 0}, {1, 1, 1, 1});
  for (const MeshVertex& vertex : *mesh.vertices) {
    const Eigen::Vector3d at = vertex.position.cast<double>() + Eigen::Vector3d(1, 0, 0) - shape.centre;
    EXPECT_NEAR(at.cwiseQuotient(5 * shape.half_lengths).norm(), 1.0, 1e-5);
    EXPECT_GT(vertex.normal.cast<double>().dot(at), 0.0);
  }
}

TEST(EllipsoidMesh, OfAFlatEllipsoidIsFlatAndFinite) {
  Ellipsoid shape = example();
  shape.half_lengths[2] = 0;
  const MeshItem mesh = ellipsoid_mesh(shape, 1, shape.centre, {1, 1, 1, 1});
  for (const MeshVertex& vertex : *mesh.vertices) {
    EXPECT_TRUE(vertex.position.allFinite());
    EXPECT_TRUE(vertex.normal.allFinite());
    EXPECT_LT(std::abs(vertex.position.z()), 1e-3);
  }
}

TEST(EllipsoidRims, AreTheThreePrincipalEllipses) {
  const std::vector<LineItem> rims = ellipsoid_rims(example(), 1, {1, 2, 3}, {1, 1, 1, 1}, 1);
  ASSERT_EQ(rims.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto across = static_cast<Eigen::Index>((k + 2) % 3);
    for (const Eigen::Vector3f& point : rims[k].points) EXPECT_NEAR(point[across], 0, 1e-6);
  }
}

TEST(ConeRim, TiltsTheNormalByTheHalfAnglesAboutTheAxes) {
  NormalCone cone{{0, 0, 0}, {0, 0, 1}, Eigen::Matrix<double, 3, 2>::Identity(), {0.2, 0.1}};
  const std::vector<Eigen::Vector3d> rim = cone_rim(cone, 1, 2.0);
  for (const Eigen::Vector3d& point : rim) EXPECT_NEAR(point.norm(), 2.0, 1e-12);
  // The first point is tilted about x by 0.2: towards -y.
  EXPECT_NEAR(rim.front().y(), -2.0 * std::sin(0.2), 1e-12);
  EXPECT_NEAR(rim[rim.size() / 4].x(), 2.0 * std::sin(0.1), 1e-12);
}

}  // namespace
}  // namespace patchlab::viewer
