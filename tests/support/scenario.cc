#include "tests/support/scenario.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/sensor/noise_model.h"

namespace patchlab::test {
namespace {

constexpr double f = 525.0, cx = 319.5, cy = 239.5, baseline = 0.075, pointing = 0.35, disparity = 0.17;

const NoiseModel& kinect() {
  static const NoiseModel model = *noise_model("stereo:f=525,baseline=0.075,pointing=0.35,disparity=0.17");
  return model;
}

double range_sigma(double z) { return z * z * disparity / (f * baseline); }

Boundary random_boundary(Random& random, BoundaryType type) {
  const int size = type == BoundaryType::circle ? 1 : type == BoundaryType::convex_quad ? 5 : 2;
  Boundary boundary{type, BoundaryVector(size)};
  for (int i = 0; i < size; ++i) boundary.d[i] = random.uniform(0.05, 0.20);
  if (type == BoundaryType::convex_quad) {
    for (int i = 0; i < 4; ++i) boundary.d[i] = random.uniform(0.07, 0.14);
    boundary.d[4] = random.uniform(0.4, 0.75);
  }
  if (size == 2 && boundary.d[0] < boundary.d[1]) std::swap(boundary.d[0], boundary.d[1]);
  return boundary;
}

double random_curvature(Random& random, double d, double sign) {
  const double largest = std::min(0.9 / d, 20.0), least = std::max(0.25 / d, 1.0);
  return sign * random.uniform(least, std::max(largest, least));
}

Eigen::VectorXd random_curvatures(Random& random, const PatchTypeRow& type, const Boundary& boundary,
                                  double sign) {
  Eigen::VectorXd k(type.curvature_size);
  if (type.curvature_size == 1) {
    k[0] = random_curvature(
        random,
        type.surface == SurfaceType::circular_cylinder || type.surface == SurfaceType::cylindric_paraboloid
            ? boundary.d[1]
            : boundary.d[0],
        sign);
  } else if (type.curvature_size == 2) {
    const double across = type.surface == SurfaceType::hyperbolic_paraboloid ? -sign : sign;
    k[0] = random_curvature(random, boundary.d[0], across);
    k[1] = random_curvature(random, boundary.d[1], sign);
  }
  return k;
}

// z_l towards the camera, tilted against the line of sight, turned at random about itself.
Matrix3d random_axes(Random& random, const Vector3d& centre) {
  const Vector3d towards = -centre.normalized();
  const double tilt = random.uniform(5.0, 55.0) * std::numbers::pi / 180.0;
  const Vector3d across = towards.cross(random.unit3()).normalized();
  const Vector3d z = std::cos(tilt) * towards + std::sin(tilt) * across;
  const Vector3d x = z.cross(random.unit3()).normalized();
  return (Matrix3d() << x, z.cross(x), z).finished();
}

bool all_visible(const Patch& patch) {
  const Pose pose = world_from_patch(patch);
  for (const Vector2d& u : outline(boundary(patch), 64)) {
    const Vector3d q = surface_point(u, k3(patch));
    const Vector3d q_world = apply(pose, q), n = axes(patch) * outward_normal(q, k3(patch));
    if (n.dot(-q_world.normalized()) < 0.17 || q_world.z() < 0.3) return false;
    const double column = f * q_world.x() / q_world.z() + cx, row = f * q_world.y() / q_world.z() + cy;
    if (column < 0.0 || column > 639.0 || row < 0.0 || row > 479.0) return false;
    const std::optional<double> s = ray_hit(patch, Vector3d::Zero(), q_world * 0.999999);
    if (s && *s < 0.999) return false;
  }
  return true;
}

double least_sag(const Patch& patch) {
  double sag = 1e9;
  const Vector2d reach = extent(boundary(patch));
  const Vector3d kappa = k3(patch);
  if (kappa.x() != 0.0) sag = std::min(sag, 0.5 * std::abs(kappa.x()) * reach.x() * reach.x());
  if (kappa.y() != 0.0) sag = std::min(sag, 0.5 * std::abs(kappa.y()) * reach.y() * reach.y());
  return sag;
}

// How far apart the heights are that two curvatures give at the lesser reach.
double sag_apart(const Patch& patch) {
  const double reach = extent(boundary(patch)).minCoeff();
  const Vector3d kappa = k3(patch);
  return 0.5 * std::abs(kappa.x() - kappa.y()) * reach * reach;
}

bool has_vertex_prior(SurfaceType surface) {
  return surface == SurfaceType::elliptic_paraboloid || surface == SurfaceType::hyperbolic_paraboloid ||
         surface == SurfaceType::circular_paraboloid || surface == SurfaceType::cylindric_paraboloid;
}

Vector3d measured(Random& random, const Vector3d& q, const Matrix3d& cov, NoiseMode mode) {
  if (mode == NoiseMode::linear) return q + cov.llt().matrixL() * random.normal3();
  const Vector3d e = random.normal3();
  const double u = f * q.x() / q.z() + pointing * e.x(), v = f * q.y() / q.z() + pointing * e.y();
  const double d = f * baseline / q.z() + disparity * e.z(), z = f * baseline / d;
  return {u * z / f, v * z / f, z};
}

// The frame whose xy plane the region is drawn in: tangent to the surface over the region's centre.
Pose patch_from_region(const Scenario& scenario) {
  const Vector3d kappa = k3(scenario.truth), centre = surface_point(scenario.region_offset, kappa);
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), outward_normal(centre, kappa));
  return {log_map(turn.toRotationMatrix()), centre};
}

// A point of the region in a random pixel, on the patch's surface.
Vector3d random_point(Random& random, const Scenario& scenario) {
  const Patch& patch = scenario.truth;
  const Pose pose = world_from_patch(patch);
  const Boundary region = boundary(patch);
  const Pose region_pose = patch_from_region(scenario);
  const double reach = extent(region).norm() + scenario.region_offset.norm();
  const Vector3d c = centre(patch);
  for (;;) {
    const double span = 1.3 * reach / (c.z() - std::min(reach, 0.5 * c.z()));
    const Vector3d direction(c.x() / c.z() + random.uniform(-span, span),
                             c.y() / c.z() + random.uniform(-span, span), 1.0);
    const Vector3d origin = apply_inverse(pose, Vector3d::Zero()),
                   d_patch = axes(patch).transpose() * direction;
    const RayHits hits = ray_hits(origin, d_patch, k3(patch));
    for (int i = 0; i < hits.count; ++i) {
      const Vector3d q = origin + hits.s[i] * d_patch;
      const Vector2d u = apply_inverse(region_pose, q).head<2>();
      const bool near_sheet = on_modelled_sheet(q, k3(patch)) && q.head<2>().norm() < 1.5 * reach;
      if (hits.s[i] > 0.0 && near_sheet && contains(region, u)) return apply(pose, q);
    }
  }
}

Vector3d outlier(Random& random, const Scenario& scenario, const Vector3d& side) {
  const Pose pose = world_from_patch(scenario.truth);
  const Vector2d reach = extent(boundary(scenario.truth));
  const Vector3d u(random.uniform(-1.0, 1.0) * reach.x(), random.uniform(-1.0, 1.0) * reach.y(), 0.0);
  const Vector3d shifted = u + Vector3d(side.x() * reach.x(), side.y() * reach.y(), -side.z());
  return apply(pose, shifted);
}

}  // namespace

Scenario random_scenario(Random& random, const PatchTypeRow& type, bool concave,
                         const ScenarioOptions& options) {
  for (;;) {
    const double depth = random.uniform(0.7, 2.0);
    const Vector3d c(random.uniform(-0.25, 0.25) * depth, random.uniform(-0.2, 0.2) * depth, depth);
    const Boundary bound = random_boundary(random, type.boundary);
    const Eigen::VectorXd k = random_curvatures(random, type, bound, concave ? 1.0 : -1.0);
    Scenario scenario;
    scenario.truth = conventional(make_patch(type, bound, k, random_axes(random, c), c), Vector3d::Zero());
    scenario.range_sigma = range_sigma(depth);
    if (!validate(scenario.truth)) continue;
    if (type.curvature_size > 0 && least_sag(scenario.truth) < options.least_sag * scenario.range_sigma)
      continue;
    if (type.curvature_size == 2 && sag_apart(scenario.truth) < options.least_apart * scenario.range_sigma)
      continue;
    if (options.fully_visible && !all_visible(scenario.truth)) continue;
    if (has_vertex_prior(type.surface)) {
      const BoundaryVector d = boundary(scenario.truth).d;
      const double size = type.boundary == BoundaryType::circle    ? d[0]
                          : type.boundary == BoundaryType::ellipse ? std::sqrt(0.5 * d.squaredNorm())
                                                                   : 2.0 * std::sqrt(d.squaredNorm() / 6.0);
      scenario.region_offset = 0.05 * size * Vector2d(random.normal(), random.normal());
      if (type.surface == SurfaceType::cylindric_paraboloid) scenario.region_offset.x() = 0.0;
    }
    return scenario;
  }
}

Observations observe(Random& random, const Scenario& scenario, const ScenarioOptions& options) {
  Observations observations;
  observations.optical_axis = Vector3d::UnitZ();
  const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
  const Vector3d side(std::cos(angle), std::sin(angle), random.uniform(0.02, 0.10));
  while (observations.size() < options.points) {
    const bool stray = random.uniform() < options.outliers;
    const Vector3d q = stray ? outlier(random, scenario, side) : random_point(random, scenario);
    const Matrix3d cov_true = covariance_in_sensor(kinect(), q);
    const Vector3d point = measured(random, q, cov_true, options.noise);
    observations.points.push_back(point);
    observations.covariances.push_back(
        options.noise == NoiseMode::linear ? cov_true : covariance_in_sensor(kinect(), point));
  }
  if (options.noise == NoiseMode::sensor) {
    observations.covariance_at = [](std::size_t, const Vector3d& foot) {
      return covariance_in_sensor(kinect(), foot);
    };
  }
  return observations;
}

}  // namespace patchlab::test
