// Derivatives and covariances of the fit against differences: residuals, the joint covariance, the bounded
// patch.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "engine/fit/distance.h"
#include "engine/fit/fit_patch.h"
#include "engine/fit/soft_edge.h"
#include "tests/support/battery.h"
#include "tests/support/numeric_jacobian.h"
#include "tests/support/seeded_random.h"

namespace patchlab {
namespace {

using test::numeric_jacobian;
using test::SeededRandom;

SurfaceState random_state(Random& random) {
  SurfaceState state;
  state.k = {random.uniform(-6.0, 6.0), random.uniform(-6.0, 6.0)};
  state.R = exp_map(random.normal3());
  state.c = random.normal3();
  return state;
}

Matrix3d random_cov(Random& random) {
  Matrix3d L = 1e-3 * Matrix3d::Identity();
  for (double& entry : L.reshaped()) entry += 5e-4 * random.normal();
  return L * L.transpose();
}

class ResidualJacobian : public testing::TestWithParam<ModelKind> {};

TEST_P(ResidualJacobian, AgreesWithDifferencesInChartAndPoint) {
  SeededRandom random;
  const SurfaceModel& model = surface_model(GetParam());
  for (int trial = 0; trial < 50; ++trial) {
    const SurfaceState state = random_state(random);
    const Vector3d q_local(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1),
                           random.uniform(-0.004, 0.004));
    const Vector3d kappa = k3(model, state.k);
    const Vector3d q =
        state.c + state.R * (surface_point(q_local.head<2>(), kappa) + q_local.z() * Vector3d::UnitZ());
    const Matrix3d cov = random_cov(random);
    for (const Distance distance : {Distance::exact, Distance::paper}) {
      const Residual r = residual(distance, model, state, q, cov);
      const auto of_chart = [&](const Eigen::VectorXd& step) -> Eigen::VectorXd {
        const ChartVector chart = step;
        return Eigen::VectorXd::Constant(1, residual(distance, model, retract(state, chart), q, cov).F);
      };
      EXPECT_TRUE(test::jacobian_matches(r.F_p.transpose(), of_chart, ChartVector::Zero(), {1e-4, 2e-7}));
      if (distance == Distance::paper) continue;  // first order: sigma held
      const auto of_point = [&](const Eigen::VectorXd& p) -> Eigen::VectorXd {
        return Eigen::VectorXd::Constant(1, residual(distance, model, state, q + state.R * p, cov).F);
      };
      EXPECT_TRUE(test::jacobian_matches(r.F_q.transpose(), of_point, Vector3d::Zero(), {1e-5, 2e-7}));
    }
  }
}

std::string model_name(const testing::TestParamInfo<ModelKind>& model) {
  constexpr const char* names[] = {
      "plane", "sphere", "circular_cylinder", "circular_paraboloid", "cylindric_paraboloid", "paraboloid"};
  return names[static_cast<std::size_t>(model.param)];
}

INSTANTIATE_TEST_SUITE_P(AllModels, ResidualJacobian,
                         testing::Values(ModelKind::plane, ModelKind::sphere, ModelKind::circular_cylinder,
                                         ModelKind::circular_paraboloid, ModelKind::cylindric_paraboloid,
                                         ModelKind::paraboloid),
                         model_name);

// The whole pipeline refitted with each coordinate of some points moved by a little: how the patch moves,
// against what the covariance of noise alone (no sampling, no prior) says of it.
class Refit : public testing::TestWithParam<int> {};

TEST_P(Refit, CovarianceFollowsFromMovingEveryPoint) {
  SeededRandom random;
  const PatchTypeRow& type = patch_types()[static_cast<std::size_t>(GetParam())];
  test::ScenarioOptions scenario_options;
  scenario_options.points = 40;
  const test::Scenario scenario = test::random_scenario(random, type, true, scenario_options);
  const Observations observations = test::observe(random, scenario, scenario_options);
  FitOptions options = test::forced_fit(type);
  options.method = FitMethod::paper;  // no sampling and no prior columns: noise alone
  const Result<FitResult> base = fit_patch(observations, options);
  ASSERT_TRUE(base);
  const auto n = base->patch.parameters.size();
  Eigen::MatrixXd cov = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const Matrix3d L = observations.covariances[i].llt().matrixL();
    for (int axis = 0; axis < 3; ++axis) {
      constexpr double step = 1e-3;  // of a standard deviation
      Eigen::VectorXd moved[2];
      for (const int side : {0, 1}) {
        Observations nudged = observations;
        nudged.points[i] += (side == 0 ? step : -step) * L.col(axis);
        const Result<FitResult> fit = fit_patch(nudged, options);
        ASSERT_TRUE(fit);
        moved[side] = fit->patch.parameters;
      }
      const Eigen::VectorXd column = (moved[0] - moved[1]) / (2.0 * step);
      cov += column * column.transpose();
    }
  }
  const Eigen::VectorXd sigma = cov.diagonal().cwiseSqrt();
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n;
         ++j) {  // J'J against the full Hessian: 0.1 to 5 % (12 % for a plane under a curve)
      EXPECT_NEAR((*base->patch.covariance)(i, j) / (sigma[i] * sigma[j]), cov(i, j) / (sigma[i] * sigma[j]),
                  0.15)
          << "parameters " << i << ", " << j;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Planes, Refit, testing::Values(4, 5, 6),
                         [](const auto& row) { return "Type" + std::to_string(row.param); });

TEST(SoftEdge, QuadOfEdgesHasTheDerivativesOfDifferences) {
  SeededRandom random;
  for (int trial = 0; trial < 20; ++trial) {
    EdgeVector edges;
    for (int e = 0; e < 4; ++e) {
      edges.segment<2>(2 * e) << e * 1.5707963 + random.uniform(-0.2, 0.2), random.uniform(0.05, 0.12);
    }
    const auto quad = [](const Eigen::VectorXd& at) -> Eigen::VectorXd {
      const EdgeQuad q = quad_of_edges(at);
      return (Eigen::VectorXd(8) << q.d, q.turn, q.centre).finished();
    };
    EXPECT_TRUE(test::jacobian_matches(quad_of_edges(edges).J_quad_edges, quad, edges, {1e-4, 1e-8}));
  }
}

TEST(SoftEdge, FindsASquareFromPointsInsideIt) {
  SeededRandom random;
  std::vector<Vector2d> points;
  for (int i = 0; i < 4000; ++i) points.emplace_back(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1));
  const std::vector<double> weights(points.size(), 1.0 / static_cast<double>(points.size()));
  for (const Corners corners : {Corners::free, Corners::right}) {
    const std::optional<SoftShape> shape = fit_soft_edges(points, weights, 4000.0, 1e-8, corners);
    ASSERT_TRUE(shape);
    for (int e = 0; e < 4; ++e) EXPECT_NEAR(shape->edges[2 * e + 1], 0.1, 1e-3);
  }
}

}  // namespace
}  // namespace patchlab
