// The same fit by Ceres, as its manual has it: curvatures, orientation vector and apex in one block of eight,
// its covariance by ceres::Covariance. Analytic rows are those of the engine's chart carried to (k, r, c).
#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <cmath>
#include <vector>

#include "engine/patch/surface.h"
#include "tests/bench/fit/solvers.h"

namespace patchlab::bench {
namespace {

struct Row {
  double F;
  ChartVector F_p;
};

// Eqs. (34)-(36).
Row paper_row(const Matrix3d& R, const Vector3d& c, const Vector3d& k_3, const Vector3d& q_world,
              const Matrix3d& cov) {
  const Vector3d q = R.transpose() * (q_world - c), g = gradient(q, k_3);
  const Vector3d Sg = R.transpose() * (cov * (R * g)), KSg = 2.0 * k_3.cwiseProduct(Sg);
  const double v = g.dot(Sg), s = std::sqrt(v), F = implicit(q, k_3) / s;
  Row row{F, {}};
  row.F_p.head<2>() = (q.cwiseAbs2() / s - 2.0 * F / v * q.cwiseProduct(Sg)).head<2>();
  row.F_p.segment<3>(2) = g.cross(q) / s - F / v * (KSg.cross(q) - Sg.cross(g));
  row.F_p.tail<3>() = -g / s + F / v * KSg;
  return row;
}

// Method M2.
Row exact_row(const Matrix3d& R, const Vector3d& c, const Vector3d& k_3, const Vector3d& q_world,
              const Matrix3d& cov) {
  const Matrix3d S = R.transpose() * cov * R;
  const FootPoint foot = foot_point(R.transpose() * (q_world - c), S, k_3);
  const Vector3d g = gradient(foot.x, k_3);
  const double s = std::sqrt(g.dot(S * g));
  Row row{foot.distance, {}};
  row.F_p << foot.x.head<2>().cwiseAbs2() / s, g.cross(foot.x) / s, -g / s;
  return row;
}

class AllPoints : public ceres::CostFunction {
 public:
  AllPoints(const Points& points, Distance distance) : points_(points), distance_(distance) {
    mutable_parameter_block_sizes()->push_back(8);
    set_num_residuals(static_cast<int>(points.q.size()));
  }
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const Eigen::Map<const ChartVector> p(parameters[0]);
    const Vector3d r = p.segment<3>(2), c = p.tail<3>(), k_3(p[0], p[1], 0.0);
    const Matrix3d R = exp_map(r), Jr = right_jacobian(r);
    const auto row_of = distance_ == Distance::paper ? paper_row : exact_row;
    for (std::size_t i = 0; i < points_.q.size(); ++i) {
      const Row row = row_of(R, c, k_3, points_.q[i], points_.cov[i]);
      residuals[i] = row.F;
      if (jacobians == nullptr || jacobians[0] == nullptr) continue;
      Eigen::Map<Eigen::Matrix<double, 1, 8>> J(jacobians[0] + 8 * i);
      J.head<2>() = row.F_p.head<2>().transpose();
      J.segment<3>(2) = row.F_p.segment<3>(2).transpose() * Jr;
      J.tail<3>() = row.F_p.tail<3>().transpose() * R.transpose();
    }
    return true;
  }

 private:
  const Points& points_;
  Distance distance_;
};

// Eq. (35) of one point, differentiated by Ceres.
struct OnePoint {
  const Vector3d& q_world;
  const Matrix3d& cov;

  template <class T>
  bool operator()(const T* p, T* residual) const {
    const T inverse[3] = {-p[2], -p[3], -p[4]};
    const T away[3] = {q_world[0] - p[5], q_world[1] - p[6], q_world[2] - p[7]};
    T q[3], g_world[3];
    ceres::AngleAxisRotatePoint(inverse, away, q);
    const T g[3] = {2.0 * p[0] * q[0], 2.0 * p[1] * q[1], T(-2.0)};
    ceres::AngleAxisRotatePoint(p + 2, g, g_world);
    T v(0.0);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) v += g_world[i] * cov(i, j) * g_world[j];
    }
    *residual = (p[0] * q[0] * q[0] + p[1] * q[1] * q[1] - 2.0 * q[2]) / sqrt(v);
    return true;
  }
};

// Method M4 as two residuals.
class Vertex : public ceres::SizedCostFunction<2, 8> {
 public:
  explicit Vertex(const VertexPrior& prior) : prior_(prior) {}
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const Eigen::Map<const ChartVector> p(parameters[0]);
    const Eigen::Matrix<double, 2, 3> rows = prior_.tangents.transpose() / prior_.sigma;
    Eigen::Map<Vector2d>(residuals, 2) = rows * (p.tail<3>() - prior_.centre);
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    Eigen::Map<Eigen::Matrix<double, 2, 8, Eigen::RowMajor>> J(jacobians[0]);
    J << Eigen::Matrix<double, 2, 5>::Zero(), rows;
    return true;
  }

 private:
  const VertexPrior& prior_;
};

}  // namespace

bool has_ceres() { return true; }

Solved ceres(Ceres way, const Points& points, const Objective& objective, const SurfaceState& start) {
  ChartVector p;
  p << start.k, log_map(start.R), start.c;
  ::ceres::Problem problem;
  if (way == Ceres::per_point) {
    for (std::size_t i = 0; i < points.q.size(); ++i) {
      problem.AddResidualBlock(
          new ::ceres::AutoDiffCostFunction<OnePoint, 1, 8>(new OnePoint{points.q[i], points.cov[i]}),
          nullptr, p.data());
    }
  } else {
    problem.AddResidualBlock(new AllPoints(points, objective.distance), nullptr, p.data());
  }
  if (objective.prior) problem.AddResidualBlock(new Vertex(*objective.prior), nullptr, p.data());
  ::ceres::Solver::Options options;
  options.linear_solver_type =
      way == Ceres::normal_cholesky ? ::ceres::DENSE_NORMAL_CHOLESKY : ::ceres::DENSE_QR;
  options.function_tolerance = stop;
  options.max_num_iterations = most_iterations;
  options.logging_type = ::ceres::SILENT;
  ::ceres::Solver::Summary summary;
  ::ceres::Solve(options, &problem, &summary);
  ::ceres::Covariance covariance{::ceres::Covariance::Options{}};
  Eigen::Matrix<double, 8, 8, Eigen::RowMajor> cov = Eigen::Matrix<double, 8, 8>::Zero();
  if (covariance.Compute(std::vector<const double*>{p.data()}, &problem)) {
    covariance.GetCovarianceBlock(p.data(), p.data(), cov.data());
  }
  return {2.0 * summary.final_cost, cov, p.tail<3>(), summary.num_residual_evaluations};
}

}  // namespace patchlab::bench
