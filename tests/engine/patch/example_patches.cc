#include "tests/engine/patch/example_patches.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tests/support/monte_carlo.h"

namespace patchlab::test {
namespace {

Boundary random_boundary(Random& random, const PatchTypeRow& type) {
  Boundary bound{type.boundary, BoundaryVector(type.boundary_size)};
  for (double& d : bound.d) d = random.uniform(0.05, 0.2);
  if (type.boundary == BoundaryType::convex_quad) bound.d[4] = random.uniform(0.3, 1.2);
  return bound;
}

VectorXd random_curvatures(Random& random, const PatchCase& patch_case, const Boundary& bound) {
  const PatchTypeRow& type = *patch_case.type;
  VectorXd kappa(type.curvature_size);
  for (double& k : kappa) k = patch_case.sign * random.uniform(0.2, 0.8) / bound.d.maxCoeff();
  if (type.surface == SurfaceType::hyperbolic_paraboloid) kappa[1] = -kappa[1];
  return kappa;
}

Matrix3d random_axes(Random& random, const PatchTypeRow& type, double rotation) {
  Vector3d r = random.unit3();
  if (type.revolute()) r.z() = 0.0;
  return exp_map(rotation * r.normalized());
}

PatchMatrix random_local_covariance(Random& random, const PatchTypeRow& type) {
  PatchVector sigma = PatchVector::Constant(type.size(), 0.002);  // d and t, m
  if (type.boundary == BoundaryType::convex_quad) sigma[4] = 0.02;
  sigma.segment(type.curvature_at(), type.curvature_size).setConstant(0.1);
  sigma.segment(type.rotation_at(), type.rotation_size).setConstant(0.01);
  return sigma.asDiagonal() * PatchMatrix(random_covariance(random, type.size(), 1.0)) * sigma.asDiagonal();
}

std::string capitalised(std::string_view name) {
  std::string out;
  bool start = true;
  for (const char c : name) {
    if (c != '_') out += start ? static_cast<char>(c - 'a' + 'A') : c;
    start = c == '_';
  }
  return out;
}

}  // namespace

std::vector<PatchCase> all_cases() {
  std::vector<PatchCase> cases;
  for (const PatchTypeRow& type : patch_types()) {
    cases.push_back({&type, +1});
    if (type.curvature_size > 0) cases.push_back({&type, -1});
  }
  return cases;
}

std::vector<PatchCase> cases_where(bool (*holds)(const PatchTypeRow&)) {
  std::vector<PatchCase> cases = all_cases();
  std::erase_if(cases, [&](const PatchCase& patch_case) { return !holds(*patch_case.type); });
  return cases;
}

void PrintTo(const PatchCase& patch_case, std::ostream* out) {
  const PatchTypeRow& type = *patch_case.type;
  *out << capitalised(name(type.surface)) << capitalised(name(type.boundary));
  if (type.curvature_size > 0) *out << (patch_case.sign > 0 ? "Concave" : "Convex");
}

std::string case_name(const testing::TestParamInfo<PatchCase>& info) {
  return testing::PrintToString(info.param);
}

Patch random_patch(Random& random, const PatchCase& patch_case, double rotation) {
  const PatchTypeRow& type = *patch_case.type;
  const Boundary bound = random_boundary(random, type);
  return make_patch(type, bound, random_curvatures(random, patch_case, bound),
                    random_axes(random, type, rotation), random.normal3(),
                    random_local_covariance(random, type));
}

Patch random_patch(Random& random, const PatchCase& patch_case) {
  return random_patch(random, patch_case, random.uniform(0.0, 3.0));
}

Patch moved_in_chart(const Patch& base, const VectorXd& e) {
  const PatchTypeRow& type = *base.type;
  Vector3d w = Vector3d::Zero();
  w.head(type.rotation_size) = e.segment(type.rotation_at(), type.rotation_size);
  const Matrix3d R = axes(base);
  const Boundary bound = boundary(base);
  return make_patch(type, {bound.type, bound.d + e.head(type.boundary_size)},
                    curvatures(base) + e.segment(type.curvature_at(), type.curvature_size), R * exp_map(w),
                    centre(base) + R * e.tail<3>());
}

VectorXd chart_difference(const Patch& base, const Patch& moved) {
  const PatchTypeRow& type = *base.type;
  const Matrix3d R = axes(base);
  const Vector3d w = log_map(R.transpose() * axes(moved));
  VectorXd e = moved.parameters - base.parameters;
  if (type.revolute()) {
    e.segment<2>(type.rotation_at()) = r_xy(w);
  } else {
    e.segment<3>(type.rotation_at()) = w;
  }
  e.tail<3>() = R.transpose() * (centre(moved) - centre(base));
  return e;
}

Vector2d random_u(Random& random, const Patch& patch) {
  const Boundary bound = boundary(patch);
  const Vector2d box = extent(bound);
  for (;;) {
    const Vector2d u(random.uniform(-box.x(), box.x()), random.uniform(-box.y(), box.y()));
    if (contains(bound, u)) return u;
  }
}

Vector3d world_point(const Patch& patch, const Vector2d& u) {
  return apply(world_from_patch(patch), surface_point(u, k3(patch)));
}

testing::AssertionResult same_covariance(const PatchMatrix& a, const PatchMatrix& b, double tolerance) {
  if (a.rows() != b.rows()) return testing::AssertionFailure() << a.rows() << " rows and " << b.rows();
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    for (Eigen::Index j = 0; j < a.cols(); ++j) {
      if (std::abs(a(i, j) - b(i, j)) <= tolerance * std::sqrt(b(i, i) * b(j, j))) continue;
      return testing::AssertionFailure()
             << "row " << i << ", column " << j << ": " << a(i, j) << " and " << b(i, j);
    }
  }
  return testing::AssertionSuccess();
}

testing::AssertionResult same_patch(const Patch& a, const Patch& b) {
  if (a.type != b.type) return testing::AssertionFailure() << "the types differ";
  const VectorXd difference = chart_difference(a, b);
  if (!(difference.cwiseAbs().maxCoeff() < 1e-13)) {
    return testing::AssertionFailure() << "the parameters differ by " << difference.transpose();
  }
  return same_covariance(*a.covariance_local, *b.covariance_local, 1e-12);
}

}  // namespace patchlab::test
