#include "engine/map/pair.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/chi_square.h"
#include "engine/map/common_form.h"
#include "engine/map/correct.h"

namespace patchlab {
namespace {

using Eigen::MatrixXd;

constexpr double prior_deviation = 0.05;  // of a vertex about its patch's centre, in sizes (method M4)
constexpr double least_share = 0.25;      // of what is known of a vertex, that is worth to be told apart

// Elliptic and hyperbolic paraboloids are one family, told apart by a sign that noise can turn.
bool same_family(const Patch& a, const Patch& b) {
  return a.type->surface == b.type->surface || (a.type->curvature_size == 2 && b.type->curvature_size == 2);
}

double size_of(const Patch& patch) { return extent(boundary(patch)).maxCoeff(); }

// Units that make the forms of a patch of size L dimensionless.
using JetScale = Eigen::Matrix<double, jet_size, 1>;
JetScale jet_scale(double L) { return (JetScale() << 1.0 / L, 1.0, 1.0, L, L, L).finished(); }
Eigen::Matrix<double, quadric_size, 1> quadric_scale(double L) {
  return (Eigen::Matrix<double, quadric_size, 1>() << L, L, L, L, L, L, 1.0, 1.0, 1.0, 1.0 / L).finished();
}
PatchVector chart_scale(const PatchTypeRow& type, double L) {
  PatchVector scale = PatchVector::Zero(type.size());
  scale.segment(type.curvature_at(), type.curvature_size).setConstant(1.0 / L);
  scale.segment(type.rotation_at(), type.rotation_size).setOnes();
  scale.tail<3>().setConstant(L);
  return scale;
}

CovJet cov_jet(const Patch& patch, const SurfaceJet& jet) {
  return jet.J_local * cov_local_or_zero(patch) * jet.J_local.transpose();
}

// As the rows of a jet in `plane`: its x and y against those of the patch, the normals taken as one.
CovJet cov_unseen_at(const Patch& patch, const Pose& plane) {
  const Vector3d at = apply_inverse(world_from_patch(patch), plane.t);
  const Vector3d x = axes(patch).transpose() * exp_map(plane.r).col(0);
  const double turn = std::atan2(x.y(), x.x()), c = std::cos(turn), s = std::sin(turn);
  CovJet J = CovJet::Zero();
  J(0, 0) = 1.0;
  J.block<2, 2>(1, 1) << c, s, -s, c;
  J.block<3, 3>(3, 3) << c * c, 2 * c * s, s * s, -c * s, c * c - s * s, c * s, s * s, -2 * c * s, c * c;
  return J * cov_unseen_curvature(patch, at.head<2>()) * J.transpose();
}

struct JetPair {
  SurfaceJet a, b;
};
std::optional<JetPair> jets_of(const Pair& pair) {
  const auto a = surface_jet(pair.a, pair.plane), b = surface_jet(pair.b, pair.plane);
  if (!a || !b) return std::nullopt;
  return JetPair{*a, *b};
}

// x'S^-1 x over the `rank` directions that S says most about.
double distance_in(const JetScale& x, const CovJet& S, int rank) {
  const Eigen::SelfAdjointEigenSolver<CovJet> solver(S);
  const JetScale along = solver.eigenvectors().transpose() * x;
  double sum = 0.0;
  for (int i = jet_size - rank; i < jet_size; ++i)
    sum += along[i] * along[i] / std::max(solver.eigenvalues()[i], 1e-300);
  return sum;
}

Measurement about(const Patch& stands, const Pair& pair) {
  Measurement m;
  m.P = bounds_apart(*stands.type, cov_local_or_zero(stands));
  m.T = Eigen::Matrix<double, Eigen::Dynamic, 6>::Zero(stands.type->size(), 6);
  if (&stands == &pair.a) return m;
  const int at = stands.type->rotation_at(), size = stands.type->rotation_size;
  const Matrix6d J = J_wt_pose(pair.a_from_b, stands);
  m.T.middleRows(at, size) = J.topRows(size);
  m.T.bottomRows<3>() = J.bottomRows<3>();
  return m;
}

// e = b - a, zero for the truth: e + J_b x_b + G delta - J_a x_a = 0.
template <int size>
void state(Measurement& m, bool stands_a, const CommonForm<size>& a, const CommonForm<size>& b,
           const Matrix6d& J_pose) {
  const Eigen::Matrix<double, size, 1> e = b.value - a.value;
  const Eigen::Matrix<double, size, 6> G = b.J_wt * J_pose;
  m.y = stands_a ? e : Eigen::Matrix<double, size, 1>(-e);
  m.G = stands_a ? Eigen::Matrix<double, size, 6>(-G) : G;
  m.H = stands_a ? a.J_local : b.J_local;
}

void reduce(Measurement& m, const MatrixXd& rows) {
  m.y = rows * m.y;
  m.H = rows * m.H;
  m.G = rows * m.G;
  m.R = rows * m.R * rows.transpose();
}

// Of a patch whose apex slides along its surface (in the directions that the type has beyond what its 2-jet
// shows), as far as the prior of method M4 has its share in what is known of the apex: its places in the
// chart, and those columns of the covariance.
struct VertexByPrior {
  std::vector<int> at;
  MatrixXd columns;
};
VertexByPrior vertex_by_prior(const Patch& patch) {
  const SurfaceDof dof = surface_dof(*patch.type);
  const PatchMatrix cov = cov_local_or_zero(patch);
  const double var_prior = 0.5 * extent(boundary(patch)).squaredNorm() * prior_deviation * prior_deviation;
  const int t_z = patch.type->position_at() + 2;
  VertexByPrior vertex;
  for (int t = t_z - (dof.all - dof.jet); t < t_z; ++t) {
    if (cov(t, t) > least_share * var_prior) vertex.at.push_back(t);
  }
  vertex.columns = cov(Eigen::all, vertex.at);
  return vertex;
}

// P of a patch were its vertex known.
PatchMatrix at_vertex(const Patch& patch, const PatchMatrix& P) {
  const std::vector<int> at = vertex_by_prior(patch).at;
  if (at.empty()) return P;
  const MatrixXd columns = P(Eigen::all, at), square = P(at, at);
  return P - columns * square.ldlt().solve(columns.transpose());
}

PairMeasurement by_quadric(const Pair& pair) {
  const SurfaceQuadric a = surface_quadric(pair.a, pair.plane), b = surface_quadric(pair.b, pair.plane);
  PairMeasurement out{true, true, about(pair.a, pair), {}, {}};
  Measurement& m = out.measurement;
  state(m, true, a, b, J_wt_pose(pair.a_from_b, pair.b));
  m.R = b.J_local * cov_local_or_zero(pair.b) * b.J_local.transpose();
  const double L = size_of(pair.a);
  const auto scale = quadric_scale(L);
  // What a surface of this type can change in, and no more: the surface's own gauge drops out.
  const MatrixXd J = scale.asDiagonal() * m.H * chart_scale(*pair.a.type, L).asDiagonal();
  using Square = Eigen::Matrix<double, quadric_size, quadric_size>;
  const Eigen::SelfAdjointEigenSolver<Square> solver(Square(J * J.transpose()));
  const MatrixXd rows =
      solver.eigenvectors().rightCols(surface_dof(*pair.a.type).all).transpose() * scale.asDiagonal();
  reduce(m, rows);
  out.cov_y_vertex = rows * (b.J_local * vertex_by_prior(pair.b).columns);
  out.P_at_vertex = at_vertex(pair.a, m.P);
  return out;
}

PairMeasurement by_jet(const Pair& pair, const JetPair& jets) {
  const bool stands_a = pair.a.type->curvature_size >= pair.b.type->curvature_size;
  const Patch &stands = stands_a ? pair.a : pair.b, &other = stands_a ? pair.b : pair.a;
  PairMeasurement out{stands_a, false, about(stands, pair), {}, {}};
  Measurement& m = out.measurement;
  state(m, stands_a, jets.a, jets.b, J_wt_pose(pair.a_from_b, pair.b));
  const SurfaceJet& jet = stands_a ? jets.b : jets.a;
  m.R = cov_jet(other, jet) + cov_unseen_at(other, pair.plane) + cov_unseen_at(stands, pair.plane);
  const JetScale scale = jet_scale(size_of(stands));
  reduce(m, scale.asDiagonal());
  out.cov_y_vertex = scale.asDiagonal() * (jet.J_local * vertex_by_prior(other).columns);
  out.P_at_vertex = at_vertex(stands, m.P);
  return out;
}

}  // namespace

Pose plane_of(const Patch& a, const Patch& b, const Overlap& overlap) {
  const Patch& finer = a.type->curvature_size >= b.type->curvature_size ? a : b;
  return plane_at(overlap.point, overlap.normal, axes(finer).col(0));
}

std::optional<PairDistance> pair_distance(const Pair& pair, const Matrix6d& cov_pose) {
  if (!local_covariance(pair.a) && !local_covariance(pair.b)) return std::nullopt;
  const auto jets = jets_of(pair);
  if (!jets) return std::nullopt;
  const Eigen::Matrix<double, jet_size, 6> G = jets->b.J_wt * J_wt_pose(pair.a_from_b, pair.b);
  CovJet S = cov_jet(pair.a, jets->a) + cov_jet(pair.b, jets->b) + G * cov_pose * G.transpose();
  const bool same = same_family(pair.a, pair.b);
  if (!same) S += cov_unseen_at(pair.a, pair.plane) + cov_unseen_at(pair.b, pair.plane);
  const JetScale scale = jet_scale(std::min(size_of(pair.a), size_of(pair.b)));
  PairDistance out;
  out.dof = same ? surface_dof(*pair.a.type).jet : jet_size;
  out.chi2 = distance_in(scale.cwiseProduct(jets->b.value - jets->a.value),
                         scale.asDiagonal() * S * scale.asDiagonal(), out.dof);
  out.p_value = std::isfinite(out.chi2) ? chi_square_p_value(out.chi2, out.dof) : 0.0;
  return out;
}

std::optional<PairMeasurement> measure_pair(const Pair& pair) {
  if (!local_covariance(pair.a) && !local_covariance(pair.b)) return std::nullopt;
  if (same_family(pair.a, pair.b)) return by_quadric(pair);  // wherever the plane lies
  const auto jets = jets_of(pair);
  if (!jets) return std::nullopt;
  return by_jet(pair, *jets);
}

Measurement apart_from_vertex(const PairMeasurement& pair) {
  Measurement m = pair.measurement;
  if (pair.cov_y_vertex.cols() == 0) return m;
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(pair.cov_y_vertex);
  const MatrixXd Q = qr.householderQ();
  m.P_gain = pair.P_at_vertex;
  reduce(m, Q.rightCols(Q.cols() - qr.rank()).transpose());
  return m;
}

}  // namespace patchlab
