#include "engine/patch/patch_type.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace patchlab::test {
namespace {

using testing::ElementsAre;

const PatchTypeRow& row(SurfaceType surface, BoundaryType boundary) {
  return *find_patch_type(surface, boundary);
}

TEST(PatchType, SizesAreTheDofColumnOfTableI) {
  std::vector<int> sizes;
  for (const PatchTypeRow& type : patch_types()) sizes.push_back(type.size());
  EXPECT_THAT(sizes, ElementsAre(10, 10, 9, 7, 8, 6, 8, 11, 7, 9));
}

TEST(PatchType, PartsFollowOneAnotherInTheParameterVector) {
  for (const PatchTypeRow& type : patch_types()) {
    EXPECT_EQ(type.curvature_at(), type.boundary_size);
    EXPECT_EQ(type.rotation_at(), type.curvature_at() + type.curvature_size);
    EXPECT_EQ(type.position_at() + 3, type.size());
    EXPECT_EQ(type.B.cols(), type.curvature_size);
    EXPECT_EQ(parameter_names(type).size(), static_cast<std::size_t>(type.size()));
    EXPECT_EQ(local_names(type).size(), static_cast<std::size_t>(type.size()));
  }
}

TEST(PatchType, ExactlyTheCircularOnesAreRevolute) {
  for (const PatchTypeRow& type : patch_types()) {
    EXPECT_EQ(type.revolute(), type.boundary == BoundaryType::circle);
  }
}

TEST(PatchType, CurvaturesAreTiedAsTheErrataSay) {
  const auto k3 = [](SurfaceType surface) {
    return Eigen::Vector3d(row(surface, default_boundary(surface)).B * 5.0);
  };
  EXPECT_EQ(k3(SurfaceType::cylindric_paraboloid), Eigen::Vector3d(0, 5, 0));
  EXPECT_EQ(k3(SurfaceType::circular_paraboloid), Eigen::Vector3d(5, 5, 0));
  EXPECT_EQ(k3(SurfaceType::sphere), Eigen::Vector3d(5, 5, 5));
  EXPECT_EQ(k3(SurfaceType::circular_cylinder), Eigen::Vector3d(0, 5, 5));
  const auto& ellipse = row(SurfaceType::elliptic_paraboloid, BoundaryType::ellipse);
  EXPECT_EQ(Eigen::Vector3d(ellipse.B * Eigen::Vector2d(3, 4)), Eigen::Vector3d(3, 4, 0));
}

TEST(PatchType, NamesOfParameters) {
  EXPECT_THAT(parameter_names(row(SurfaceType::plane, BoundaryType::convex_quad)),
              ElementsAre("d_1", "d_2", "d_3", "d_4", "gamma", "r_x", "r_y", "r_z", "c_x", "c_y", "c_z"));
  EXPECT_THAT(parameter_names(row(SurfaceType::sphere, BoundaryType::circle)),
              ElementsAre("d", "kappa", "r_x", "r_y", "c_x", "c_y", "c_z"));
  EXPECT_THAT(local_names(row(SurfaceType::sphere, BoundaryType::circle)),
              ElementsAre("d", "kappa", "tilt_x", "tilt_y", "t_x", "t_y", "t_z"));
  EXPECT_THAT(local_names(row(SurfaceType::elliptic_paraboloid, BoundaryType::ellipse)),
              ElementsAre("d_x", "d_y", "kappa_x", "kappa_y", "w_x", "w_y", "w_z", "t_x", "t_y", "t_z"));
}

TEST(PatchType, NamesReadBack) {
  for (const PatchTypeRow& type : patch_types()) {
    EXPECT_EQ(surface_from_name(name(type.surface)), type.surface);
    EXPECT_EQ(boundary_from_name(name(type.boundary)), type.boundary);
    EXPECT_EQ(find_patch_type(type.surface, type.boundary), &type);
  }
  EXPECT_EQ(surface_from_name("torus"), std::nullopt);
  EXPECT_EQ(boundary_from_name(""), std::nullopt);
}

TEST(PatchType, PairsOutsideTableIAreNone) {
  EXPECT_EQ(find_patch_type(SurfaceType::sphere, BoundaryType::ellipse), nullptr);
  EXPECT_EQ(find_patch_type(SurfaceType::circular_cylinder, BoundaryType::circle), nullptr);
}

TEST(PatchType, DefaultBoundaries) {
  EXPECT_EQ(default_boundary(SurfaceType::plane), BoundaryType::ellipse);
  EXPECT_EQ(default_boundary(SurfaceType::hyperbolic_paraboloid), BoundaryType::ellipse);
  EXPECT_EQ(default_boundary(SurfaceType::circular_cylinder), BoundaryType::rectangle);
  EXPECT_EQ(default_boundary(SurfaceType::sphere), BoundaryType::circle);
}

}  // namespace
}  // namespace patchlab::test
