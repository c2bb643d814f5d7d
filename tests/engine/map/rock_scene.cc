#include "tests/engine/map/rock_scene.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "engine/map/correct.h"
#include "tests/engine/patch/example_patches.h"
#include "tests/support/monte_carlo.h"

namespace patchlab::test {
namespace {

constexpr double spacing = 0.25;  // m

Patch rock(Random& random, const PatchCase& kind, const Vector3d& at) {
  const Patch shape = rock_shape(random, kind);
  BoundaryVector d = 0.5 * boundary(shape).d;  // 2.5 to 10 cm
  if (kind.type->boundary == BoundaryType::convex_quad) d[4] *= 2.0;
  const Matrix3d R =
      exp_map(random.uniform(0.0, 0.6) * random.unit3()) * exp_map(Vector3d(0, 0, random.uniform(-3.0, 3.0)));
  return make_patch(*kind.type, {kind.type->boundary, d}, curvatures(shape), R, at);
}

// Standard deviations of a good fit of a depth camera, mm and degrees. Its errors are normal in the heights
// that it saw: those of H are alike in xx, xy and yy, so the spin is known by the difference of the
// curvatures.
PatchMatrix fit_covariance(Random& random, const Patch& patch) {
  const PatchTypeRow& type = *patch.type;
  PatchVector sigma = PatchVector::Constant(type.size(), 0.001);
  if (type.boundary == BoundaryType::convex_quad) sigma[4] = 0.01;
  sigma.segment(type.curvature_at(), type.curvature_size).setConstant(0.15);
  sigma.segment(type.rotation_at(), type.rotation_size).setConstant(0.008);
  if (type.curvature_size == 2) {
    const Eigen::VectorXd kappa = curvatures(patch);
    sigma[type.rotation_at() + 2] = 0.15 / std::abs(kappa[1] - kappa[0]);
  }
  return sigma.asDiagonal() * PatchMatrix(random_covariance(random, type.size(), 0.7)) * sigma.asDiagonal();
}

// The same surface with other bounds, and where it slides in itself with another apex.
Patch seen_in_part(Random& random, const Patch& truth) {
  Boundary bound = boundary(truth);
  const Eigen::Index lengths = bound.type == BoundaryType::convex_quad ? 4 : bound.d.size();
  bound.d.head(lengths) *= random.uniform(0.7, 1.0);
  const Vector2d slide = 0.3 * random.uniform() *
                         extent(bound).cwiseProduct(Vector2d(random.uniform(-1, 1), random.uniform(-1, 1)));
  const Vector3d q = surface_point(slide, k3(truth));
  Matrix3d R = axes(truth);
  Vector3d c = centre(truth);
  switch (truth.type->surface) {
    case SurfaceType::plane:
      c += R * q;
      break;
    case SurfaceType::sphere:
    case SurfaceType::circular_cylinder: {
      const Vector3d along(slide.x() * (truth.type->surface == SurfaceType::sphere ? 0.0 : 1.0), 0.0, 0.0);
      const double kappa = curvatures(truth)[0];
      const Vector3d middle = c + R.col(2) / kappa;
      const double roll_x = -kappa * slide.y(),
                   roll_y = truth.type->surface == SurfaceType::sphere ? kappa * slide.x() : 0.0;
      c = middle + R * along;
      R = R * exp_map(Vector3d(roll_x, roll_y, 0.0));
      c -= R.col(2) / kappa;
      break;
    }
    default:
      break;
  }
  return make_patch(*truth.type, bound, curvatures(truth), R, c);
}

Matrix6d pose_covariance(Random& random) {
  Vector6d sigma;
  sigma << 0.015, 0.015, 0.015, 0.015, 0.015, 0.015;  // about a degree, and 1.5 cm
  return sigma.asDiagonal() * Matrix6d(random_covariance(random, 6, 0.7)) * sigma.asDiagonal();
}

}  // namespace

Eigen::VectorXd draw(Random& random, const Eigen::MatrixXd& covariance) {
  Eigen::VectorXd e(covariance.rows());
  for (double& entry : e) entry = random.normal();
  return covariance.llt().matrixL() * e;
}

Patch rock_shape(Random& random, const PatchCase& kind) {
  constexpr double least_difference = 2.0;  // 1/m
  for (;;) {
    const Patch shape = random_patch(random, kind);
    const Eigen::VectorXd kappa = curvatures(shape);
    if (kappa.size() == 2 && std::abs(kappa[1] - kappa[0]) < least_difference) continue;
    return make_patch(*shape.type, boundary(shape), kappa, axes(shape), centre(shape));
  }
}

RockScene rock_scene(Random& random, int count) {
  RockScene scene;
  const std::vector<PatchCase> cases = all_cases();
  const int side = static_cast<int>(std::ceil(std::sqrt(count)));
  for (int i = 0; i < count; ++i) {
    const Vector2d place =
        spacing * Vector2d(i % side + random.uniform(-0.15, 0.15), i / side + random.uniform(-0.15, 0.15));
    const Vector3d at(place.x(), place.y(), 0.0);
    if (random.uniform() < 0.25) {
      const PatchTypeRow& type = *find_patch_type(SurfaceType::plane, BoundaryType::ellipse);
      scene.truth.push_back(make_patch(
          type, {type.boundary, Eigen::Vector2d(random.uniform(0.08, 0.12), random.uniform(0.05, 0.08))}, {},
          exp_map(Vector3d(0, 0, random.uniform(-3.0, 3.0))), at));
    } else {
      scene.truth.push_back(
          rock(random, cases[random.index(cases.size())], at + Vector3d(0, 0, random.uniform(0.0, 0.2))));
    }
  }
  return scene;
}

RockView rock_view(Random& random, const RockScene& scene, const std::vector<std::size_t>& seen,
                   bool exact_pose) {
  RockView view;
  view.true_map_from_view = {random.uniform(0.2, 1.5) * random.unit3(), random.normal3()};
  view.map_from_view.pose = view.true_map_from_view;
  if (!exact_pose) {
    view.map_from_view.covariance = pose_covariance(random);
    const Eigen::VectorXd e = draw(random, view.map_from_view.covariance);
    view.map_from_view.pose.r += e.head<3>();
    view.map_from_view.pose.t += e.tail<3>();
  }
  for (const std::size_t i : seen) {
    const Patch part = transform(inverse(view.true_map_from_view), seen_in_part(random, scene.truth[i]));
    const PatchMatrix cov = fit_covariance(random, part);
    view.patches.push_back(corrected(part, draw(random, cov), cov, world_from_patch(part)));
    view.truths.push_back(i);
  }
  return view;
}

TwoViews two_views(Random& random, int count) {
  const RockScene scene = rock_scene(random, count);
  std::vector<std::size_t> in_a, in_b;
  for (std::size_t i = 0; i < scene.truth.size(); ++i) {
    const std::size_t kind = i % 20;  // 3 of 20 in the first alone, 3 in the second
    if (kind >= 3) in_a.push_back(i);
    if (kind < 17) in_b.push_back(i);
  }
  TwoViews views{rock_view(random, scene, in_a, true), rock_view(random, scene, in_b)};
  views.a.patches = standing_in(views.a.true_map_from_view, views.a.patches);
  return views;
}

Score& operator+=(Score& sum, const Score& one) {
  sum.right += one.right;
  sum.wrong += one.wrong;
  sum.possible += one.possible;
  return sum;
}

Score score(const std::vector<Match>& matches, const RockView& a, const RockView& b) {
  Score out;
  for (const Match& match : matches) (a.truths[match.a] == b.truths[match.b] ? out.right : out.wrong)++;
  for (const std::size_t truth : a.truths) out.possible += std::ranges::count(b.truths, truth) > 0;
  return out;
}

}  // namespace patchlab::test
