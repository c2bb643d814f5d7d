// Tables and polygons, and the covariances of poses in other conventions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <nlohmann/json.hpp>
#include <sstream>

#include "engine/export/foothold.h"
#include "engine/io/pose_covariance.h"
#include "engine/map/queries.h"
#include "engine/patch/marginals.h"
#include "tests/engine/export/consumer.h"
#include "tests/engine/export/ten_types.h"
#include "tests/support/json_schema.h"

namespace patchlab {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) out.push_back(cell);
  return out;
}

TEST(Csv, HoldsEveryParameterSigmaAndCovarianceToTheBit) {
  const PatchSet set = test::ten_types();
  ASSERT_EQ(set.patches.size(), 10u);
  std::istringstream lines(test::exported_bytes("csv", set));
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = cells(line);
  for (const PatchRecord& record : set.patches) {
    std::getline(lines, line);
    const std::vector<std::string> row = cells(line);
    ASSERT_EQ(row.size(), names.size());
    const auto at = [&](const std::string& name) {
      return row.at(static_cast<std::size_t>(std::ranges::find(names, name) - names.begin()));
    };
    const auto number = [&](const std::string& name) { return std::stod(at(name)); };
    EXPECT_EQ(at("id"), record.id);
    EXPECT_EQ(at("surface"), name(record.patch.type->surface));
    const auto parameters = parameter_names(*record.patch.type);
    const PatchMatrix& cov = *record.patch.covariance;
    for (int i = 0; i < cov.rows(); ++i) {
      EXPECT_EQ(number(parameters[static_cast<std::size_t>(i)]), record.patch.parameters[i]);
      EXPECT_EQ(number("sigma_" + parameters[static_cast<std::size_t>(i)]), std::sqrt(cov(i, i)));
      for (int j = i; j < cov.rows(); ++j)
        EXPECT_EQ(number("cov_" + std::to_string(i + 1) + "_" + std::to_string(j + 1)), cov(i, j));
    }
    EXPECT_EQ(at("cov_1_11") == "nan", cov.rows() < 11);
  }
}

TEST(Csv, QuotesWhatWouldSplitAField) {
  PatchSet set = test::designed_set();
  set.patches[0].id = "left, \"sole\"";
  EXPECT_THAT(test::exported_bytes("csv", set), HasSubstr("\n\"left, \"\"sole\"\"\",left_foot,"));
}

// Of the matrix that `of` gives: T(p) = (R, c) moved to (R', c') has the coordinates xi.
using Coordinates = Vector6d (*)(const Matrix3d& R, const Vector3d& c, const Matrix3d& R2,
                                 const Vector3d& c2);

Vector6d right_coordinates(const Matrix3d& R, const Vector3d& c, const Matrix3d& R2, const Vector3d& c2) {
  return (Vector6d() << log_map(R.transpose() * R2), R.transpose() * (c2 - c)).finished();  // to first order
}
Vector6d left_coordinates(const Matrix3d& R, const Vector3d& c, const Matrix3d& R2, const Vector3d& c2) {
  const Matrix3d turn = R2 * R.transpose();  // T2 Tbar^-1
  return (Vector6d() << log_map(turn), c2 - turn * c).finished();
}
Vector6d ros_coordinates(const Matrix3d& R, const Vector3d& c, const Matrix3d& R2, const Vector3d& c2) {
  return (Vector6d() << c2 - c, log_map(R2 * R.transpose())).finished();
}

struct Case {
  const char* name;
  Coordinates coordinates;
};
constexpr Case cases[] = {{"right_rot_trans", right_coordinates},
                          {"left_rot_trans", left_coordinates},
                          {"ros_fixed_axes", ros_coordinates}};

// By central differences over the public parameters, whose covariance is the contract.
TEST(PoseCovariances, AreThoseOfTheParametersCarriedNumerically) {
  for (const Case& one : cases) {
    for (const PatchRecord& record : test::ten_types().patches) {
      const Patch& patch = record.patch;
      const PatchTypeRow& type = *patch.type;
      const auto moved = [&](int parameter, double by) {
        Patch other = patch;
        other.parameters[parameter] += by;
        return one.coordinates(axes(patch), centre(patch), axes(other), centre(other));
      };
      constexpr double h = 1e-6;
      Eigen::MatrixXd J(6, type.size());
      for (int i = 0; i < type.size(); ++i) J.col(i) = (moved(i, h) - moved(i, -h)) / (2.0 * h);
      Matrix6d expected = J * *patch.covariance * J.transpose();
      const Matrix6d cov = find_pose_covariance(one.name)->of(patch);
      if (type.revolute()) {  // what the spin adds, and what lifting r_xy leaves of it
        Patch spun = patch;
        const Vector3d z = axes(patch).col(2);
        const auto turned = [&](double by) {
          return one.coordinates(axes(patch), centre(patch), exp_map(by * z) * axes(spun), centre(spun));
        };
        const Vector6d about_z = (turned(h) - turned(-h)) / (2.0 * h);
        // Without the part about z_l: orthogonal to it in the right coordinates, whatever the convention.
        Eigen::MatrixXd across = J;
        for (int i = 0; i < type.size(); ++i) {
          Patch other = patch;
          other.parameters[i] += h;
          const double spin =
              right_coordinates(axes(patch), centre(patch), axes(other), centre(other))[2] / h;
          across.col(i) -= spin * about_z;
        }
        expected = across * *patch.covariance * across.transpose() +
                   std::numbers::pi * std::numbers::pi / 3.0 * about_z * about_z.transpose();
      }
      EXPECT_LT((cov - expected).norm(), 1e-6 * expected.norm()) << record.id << " " << one.name;
      const Matrix6d scale = expected.diagonal().cwiseSqrt().cwiseInverse().asDiagonal();
      EXPECT_LT((scale * (cov - expected) * scale).norm(), 1e-4) << record.id << " " << one.name;
      EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix6d>(cov).eigenvalues()[0], 0.0) << record.id;
      EXPECT_EQ(cov, cov.transpose());
    }
  }
}

TEST(PoseCovariances, AreWrittenOnRequestAndReadAsDerived) {
  const PatchSet set = test::ten_types();
  const std::string text = test::exported_bytes(
      "patch_set", set, {.covariances = {"right_rot_trans", "left_rot_trans", "ros_fixed_axes"}});
  const json document = json::parse(text);
  EXPECT_EQ(test::complaints("patch_set", document), "");
  for (std::size_t i = 0; i < set.patches.size(); ++i) {
    const json& pose = document["patches"][i]["pose"];
    EXPECT_EQ(pose["covariance_ros_fixed_axes"], pose["covariance_ros"]);
    for (const PoseCovariance& convention : pose_covariances()) {
      const Matrix6d expected = convention.of(set.patches[i].patch);
      const json& written = pose["covariance_" + std::string(convention.name)];
      for (int row = 0; row < 6; ++row) {
        for (int column = 0; column < 6; ++column)
          EXPECT_EQ(written[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)],
                    expected(row, column));
      }
    }
  }
  const Result<PatchSet> read = read_patch_set(text, "set.json");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(*write_patch_set(*read), *write_patch_set(set));
}

TEST(PoseCovariances, OfAnotherNameAreRefused) {
  const Result<Exported> exported =
      export_patches(**export_format("patch_set"), test::ten_types(), {.covariances = {"rot_trans"}});
  ASSERT_FALSE(exported);
  EXPECT_EQ(exported.error().code, ErrorCode::usage);
  EXPECT_THAT(exported.error().message, HasSubstr("right_rot_trans"));
}

TEST(PoseCovariances, OfADesignedPatchAreMissedByName) {
  const Result<Exported> exported = export_patches(**export_format("patch_set"), test::designed_set(),
                                                   {.covariances = {"right_rot_trans"}});
  ASSERT_TRUE(exported);
  EXPECT_THAT(exported->notices, Contains(HasSubstr("left_sole")));
}

// The least of the distances from the outline to a point inside it, and minus that outside.
double depth(const Patch& patch, const Vector2d& point) {
  double least = INFINITY;
  for (const Vector2d& u : outline(boundary(patch), 2000)) least = std::min(least, (u - point).norm());
  return contains(boundary(patch), point) ? least : -least;
}

TEST(Foothold, KeepsAwayFromTheOutlineByItsSigmasAndTheFoot) {
  for (const PatchRecord& record : test::ten_types().patches) {
    constexpr double sigmas = 3.0, radius = 0.01;
    const std::vector<Vector2d> polygon = inner_polygon(record.patch, sigmas, radius);
    double least_sigma = INFINITY;
    for (const BandPoint& point : outline_band(record.patch, 128))
      least_sigma = std::min(least_sigma, point.sigma);
    ASSERT_GE(polygon.size(), 3u) << record.id;
    for (const Vector2d& corner : polygon)
      EXPECT_GT(depth(record.patch, corner), sigmas * least_sigma + radius - 1e-5) << record.id;
  }
}

TEST(Foothold, IsConvexAndCounterclockwise) {
  for (const PatchRecord& record : test::ten_types().patches) {
    for (const double radius : {0.0, 0.02}) {
      const std::vector<Vector2d> polygon = inner_polygon(record.patch, 2.0, radius);
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vector2d a = polygon[(i + 1) % polygon.size()] - polygon[i],
                       b = polygon[(i + 2) % polygon.size()] - polygon[(i + 1) % polygon.size()];
        EXPECT_GT(a.x() * b.y() - a.y() * b.x(), -1e-12) << record.id;
      }
      EXPECT_GT(polygon_area(polygon), 0.0);
    }
  }
}

TEST(Foothold, WithoutAnInsetIsAlmostTheWholePatchAndNeverMore) {
  for (const test::SamplePatch& sample : test::sample_patches()) {
    const double whole = area(boundary(sample.patch)),
                 inner = polygon_area(inner_polygon(sample.patch, 0.0, 0.0));
    EXPECT_LE(inner, whole * (1.0 + 1e-12)) << sample.label;
    EXPECT_GT(inner, 0.999 * whole) << sample.label;
  }
}

TEST(Footholds, SayPoseNormalAndTiltOfEachPatch) {
  const PatchSet set = test::ten_types();
  const ExportOptions options{.foot_radius = 0.01, .up = Vector3d(0.2, -0.3, 0.9), .tilt_limit = 0.7};
  const json document = json::parse(test::exported_bytes("footholds", set, options));
  EXPECT_EQ(test::complaints("footholds", document), "");
  ASSERT_EQ(document["footholds"].size(), set.patches.size());
  for (std::size_t i = 0; i < set.patches.size(); ++i) {
    const json& foothold = document["footholds"][i];
    const Patch& patch = set.patches[i].patch;
    EXPECT_EQ(foothold["patch"], set.patches[i].id);
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_EQ(foothold["normal"][j], axes(patch)(static_cast<int>(j), 2));
      EXPECT_EQ(foothold["pose"]["position"][j], centre(patch)[static_cast<int>(j)]);
    }
    EXPECT_EQ(foothold["tilt"]["angle"], tilt(patch, options.up).value);
    EXPECT_EQ(foothold["tilt"]["sigma"], tilt(patch, options.up).sigma);
    EXPECT_EQ(foothold["tilt"]["probability_above_limit"], tilt_exceeds(patch, options.up, 0.7));
    EXPECT_EQ(foothold["polygon"].size(), inner_polygon(patch, 2.0, 0.01).size());
  }
}

TEST(Footholds, LeavePatchesOutByName) {
  PatchSet set = test::ten_types();
  set.patches.push_back(test::designed_set().patches[0]);
  const Result<Exported> exported = export_patches(**export_format("footholds"), set, {.foot_radius = 0.065});
  ASSERT_TRUE(exported);
  const json document = json::parse(exported->files[0].bytes);
  EXPECT_EQ(document["footholds"].size() + exported->notices.size(), set.patches.size());
  EXPECT_THAT(exported->notices,
              Contains(testing::AllOf(HasSubstr("plane_ellipse"), HasSubstr("too small"))));
  EXPECT_THAT(exported->notices,
              Contains(testing::AllOf(HasSubstr("left_sole"), HasSubstr("no covariance"))));
}

TEST(PlanarRegions, HoldTheFlatPatchesAndNameTheCurvedOnes) {
  const Result<Exported> exported = export_patches(**export_format("planar_regions"), test::ten_types());
  ASSERT_TRUE(exported);
  const json document = json::parse(exported->files[0].bytes);
  ASSERT_EQ(document["patches"].size(), document["planarRegions"].size());
  EXPECT_THAT(document["patches"], Contains("plane_quad"));
  EXPECT_THAT(exported->notices, Contains(HasSubstr("sphere_concave\": is curved")));
  EXPECT_EQ(document["patches"].size() + exported->notices.size(), 10u);
  const PatchSet set = test::ten_types();
  for (std::size_t i = 0; i < document["patches"].size(); ++i) {
    const json& region = document["planarRegions"][i];
    const auto record =
        std::ranges::find(set.patches, document["patches"][i].get<std::string>(), &PatchRecord::id);
    const std::vector<Vector2d> inset = inner_polygon(record->patch, 2.0, 0.0);
    const json& points = region["insets"][0]["outer_boundary"]["points"];
    ASSERT_EQ(points.size(), inset.size());
    for (std::size_t j = 0; j < inset.size(); ++j) {
      EXPECT_EQ(points[j]["x"], inset[j].x());
      EXPECT_EQ(points[j]["y"], inset[j].y());
    }
    EXPECT_EQ(region["plane_parameters"]["position"]["z"], centre(record->patch).z());
    double right = 0.0;
    for (const Vector2d& u : outline(boundary(record->patch), 128)) right = std::max(right, u.x());
    EXPECT_NEAR(region["bbox2d"]["max_x"], right, 1e-12);
    EXPECT_GE(region["boundary"]["outer_boundary"]["points"].size(), 4u);
  }
}

}  // namespace
}  // namespace patchlab
