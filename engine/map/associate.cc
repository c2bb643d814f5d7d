#include "engine/map/associate.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/base/chi_square.h"
#include "engine/map/assignment.h"
#include "engine/map/common_form.h"

namespace patchlab {
namespace {

constexpr double margin_sigmas = 2.0;     // of the uncertain pose, that bounds are grown by
constexpr double worst_overlap_cost = 3;  // -log of an overlap that counts as none
constexpr double settled = 1e-9;          // m, rad

struct Candidate {
  double cost = std::numeric_limits<double>::infinity();
  Match match{};
  Pose plane;
};

std::vector<SampledPatch> sampled_all(std::span<const Patch> patches) {
  std::vector<SampledPatch> out;
  for (const Patch& patch : patches) out.push_back(sampled(patch));
  return out;
}

// Standard deviation of where the pose puts a point, in its worst direction.
double place_sigma(const UncertainPose& a_from_b, const Vector3d& q_a) {
  Eigen::Matrix<double, 3, 6> J;
  J << -skew(q_a - a_from_b.pose.t) * left_jacobian(a_from_b.pose.r), Matrix3d::Identity();
  const Matrix3d cov = J * a_from_b.covariance * J.transpose();
  return std::sqrt(
      std::max(0.0, Eigen::SelfAdjointEigenSolver<Matrix3d>(cov, Eigen::EigenvaluesOnly).eigenvalues()[2]));
}

class Round {
 public:
  Round(const std::vector<SampledPatch>& a, std::span<const Patch> b, const UncertainPose& a_from_b,
        double least_p)
      : a_(a), b_(sampled_all(standing_in(a_from_b.pose, b))), pose_(a_from_b), least_p_(least_p) {}

  std::vector<Candidate> chosen() const {
    Eigen::MatrixXd cost(a_.size(), b_.size());
    std::vector<Candidate> candidates;
    for (std::size_t i = 0; i < a_.size(); ++i) {
      for (std::size_t j = 0; j < b_.size(); ++j) {
        candidates.push_back(candidate(i, j));
        cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = candidates.back().cost;
      }
    }
    const std::vector<int> column_of = assign(cost, worst_overlap_cost - std::log(least_p_));
    std::vector<Candidate> out;
    for (std::size_t i = 0; i < a_.size(); ++i) {
      if (column_of[i] >= 0)
        out.push_back(candidates[i * b_.size() + static_cast<std::size_t>(column_of[i])]);
    }
    return out;
  }

  // The error of the pose by the pairs, those that contradict the others dropped.
  JointUpdate solve(std::vector<Candidate>& pairs, const SharedError& prior) const {
    std::vector<Measurement> measurements;
    for (const Candidate& pair : pairs) {
      const Patch b = facing(pair.match);
      measurements.push_back(measure_pair({a_[pair.match.a].patch, b, pose_.pose, pair.plane})->measurement);
    }
    for (;;) {
      JointUpdate update = update_jointly(measurements, prior);
      const std::optional<std::ptrdiff_t> worst = contradicting(update, measurements);
      if (!worst) return update;
      measurements.erase(measurements.begin() + *worst);
      pairs.erase(pairs.begin() + *worst);
    }
  }

 private:
  Patch facing(const Match& match) const {
    return match.flipped ? flip_normal(b_[match.b].patch) : b_[match.b].patch;
  }

  Candidate candidate(std::size_t i, std::size_t j) const {
    const SampledPatch &a = a_[i], &b = b_[j];
    const bool flipped = a.normals.front().dot(b.normals.front()) < 0.0;
    const Overlap shared =
        overlap(a, flipped ? turned_over(b) : b, margin_sigmas * place_sigma(pose_, b.middle));
    Candidate out;
    if (shared.share <= 0.0) return out;
    out.match = {i, j, {}, shared.share, flipped};
    const Patch b_facing = facing(out.match);
    out.plane = plane_of(a.patch, b_facing, shared);
    const auto distance = pair_distance({a.patch, b_facing, pose_.pose, out.plane}, pose_.covariance);
    if (!distance || !(distance->p_value > least_p_)) return out;
    out.match.distance = *distance;
    out.cost = -std::log(distance->p_value) + std::min(worst_overlap_cost, -std::log(shared.jaccard));
    return out;
  }

  // The pair that the others refute most.
  std::optional<std::ptrdiff_t> contradicting(const JointUpdate& update,
                                              const std::vector<Measurement>& measurements) const {
    std::optional<std::ptrdiff_t> worst;
    double least = least_p_;
    for (std::size_t i = 0; i < measurements.size(); ++i) {
      const double p =
          chi_square_p_value(update.patches[i].chi2, static_cast<double>(measurements[i].y.size()));
      if (p >= least) continue;
      least = p;
      worst = static_cast<std::ptrdiff_t>(i);
    }
    return worst;
  }

  const std::vector<SampledPatch>& a_;
  std::vector<SampledPatch> b_;
  UncertainPose pose_;
  double least_p_;
};

std::vector<Match> matches_of(const std::vector<Candidate>& candidates) {
  std::vector<Match> out;
  for (const Candidate& candidate : candidates) out.push_back(candidate.match);
  return out;
}

bool same_pairs(const std::vector<Match>& a, const std::vector<Match>& b) {
  return std::ranges::equal(a, b, [](const Match& x, const Match& y) { return x.a == y.a && x.b == y.b; });
}

}  // namespace

std::vector<Patch> standing_in(const Pose& a_from_b, std::span<const Patch> b) {
  std::vector<Patch> out;
  for (const Patch& patch : b) out.push_back(transform(a_from_b, patch));
  return out;
}

Association associate(std::span<const Patch> a, std::span<const Patch> b, const UncertainPose& a_from_b,
                      const AssociateOptions& options) {
  const std::vector<SampledPatch> a_sampled = sampled_all(a);
  const double count = static_cast<double>(std::max<std::size_t>(1, std::min(a.size(), b.size())));
  const double least_p = -std::expm1(std::log(options.gate) / count);  // 1 - gate^(1/n)
  Association out;
  out.a_from_b = a_from_b;
  for (int round = 0; round < options.rounds; ++round) {
    const Round now(a_sampled, b, out.a_from_b, least_p);
    std::vector<Candidate> pairs = now.chosen();
    const SharedError prior{a_from_b.pose.vector() - out.a_from_b.pose.vector(), a_from_b.covariance};
    const JointUpdate update = now.solve(pairs, prior);
    const std::vector<Match> matches = matches_of(pairs);
    const bool same = round > 0 && same_pairs(matches, out.matches);
    out.matches = matches;
    out.chi2 = update.chi2;
    out.dof = update.dof;
    const Vector6d vector = out.a_from_b.pose.vector() + update.delta.mean;
    out.a_from_b = {{vector.head<3>(), vector.tail<3>()}, update.delta.covariance};
    if (same && update.delta.mean.norm() < settled) break;
  }
  return out;
}

}  // namespace patchlab
