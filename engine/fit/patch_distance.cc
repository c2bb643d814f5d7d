#include "engine/fit/patch_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "engine/fit/inside_outline.h"
#include "engine/fit/sample_rows.h"
#include "engine/patch/surface.h"

namespace patchlab {
namespace {

// The outline as a closed curve of straight pieces on the surface, in groups that balls of one radius hold:
// of most groups their ball says that they are farther than what was found.
class Rim {
 public:
  Rim(const Boundary& bound, const Vector3d& kappa) {
    put_outline(bound);
    if (kappa.z() == 0.0) {
      from_.col(2) = 0.5 * (kappa.x() * from_.col(0).square() + kappa.y() * from_.col(1).square());
    } else {
      for (int i = 0; i < pieces; ++i) from_(i, 2) = height({from_(i, 0), from_(i, 1)}, kappa);
    }
    along_.topRows<pieces - 1>() = from_.bottomRows<pieces - 1>() - from_.topRows<pieces - 1>();
    along_.row(pieces - 1) = from_.row(0) - from_.row(pieces - 1);
    const Eigen::Array<double, pieces, 1> squared = squares(along_);
    inverse_ = (squared > 0.0).select(squared.inverse(), 0.0);
    for (int i = 0; i < groups; ++i) put_ball(i);
  }
  double squared_distance(const Vector3d& q) const {
    const Eigen::Array<double, groups, 1> away = squares(from_to(middle_, q));
    Eigen::Index nearest;
    away.minCoeff(&nearest);
    double least = squared_distance(q, nearest), within = squared_reach(least);
    for (Eigen::Index i = 0; i < groups; ++i) {
      if (away[i] > within || i == nearest) continue;
      least = std::min(least, squared_distance(q, i));
      within = squared_reach(least);
    }
    return least;
  }

 private:
  static constexpr int pieces = 128, group = 8, groups = pieces / group;
  template <int count>
  using Points = Eigen::Array<double, count, 3>;  // one a row

  template <int count>
  static Eigen::Array<double, count, 1> squares(const Points<count>& d) {
    return d.col(0).square() + d.col(1).square() + d.col(2).square();
  }
  template <class From>
  static Points<From::RowsAtCompileTime> from_to(const From& from, const Vector3d& q) {
    Points<From::RowsAtCompileTime> differences;
    for (int axis = 0; axis < 3; ++axis) differences.col(axis) = q[axis] - from.col(axis);
    return differences;
  }
  static Eigen::Array<double, pieces, 2> unit_circle() {
    const std::vector<Vector2d> circle = outline({BoundaryType::circle, BoundaryVector::Ones(1)}, pieces);
    Eigen::Array<double, pieces, 2> all;
    for (int i = 0; i < pieces; ++i) all.row(i) = circle[static_cast<std::size_t>(i)].transpose();
    return all;
  }
  void put_outline(const Boundary& bound) {
    static const Eigen::Array<double, pieces, 2> circle = unit_circle();
    if (is_round(bound)) {
      const Vector2d radii = extent(bound);
      for (int axis = 0; axis < 2; ++axis) from_.col(axis) = radii[axis] * circle.col(axis);
      return;
    }
    constexpr int a_side = pieces / 4;
    const std::array<Vector2d, 4> corners = vertices(bound);
    for (std::size_t i = 0; i < pieces; ++i) {
      const double share = static_cast<double>(i % a_side) / a_side;
      from_.row(static_cast<Eigen::Index>(i)).head<2>() =
          (1.0 - share) * corners[i / a_side] + share * corners[(i / a_side + 1) % 4];
    }
  }
  void put_ball(int of) {
    const int first = of * group;
    const Eigen::RowVector3d start = from_.row(first), end = from_.row((first + group) % pieces);
    middle_.row(of) = 0.5 * (start + end);
    const Vector3d middle = middle_.row(of).transpose();
    const double to_pieces = squares(from_to(from_.middleRows<group>(first), middle)).maxCoeff();
    radius_ = std::max(radius_, std::sqrt(std::max(to_pieces, (end.transpose() - middle).squaredNorm())));
  }
  double squared_reach(double squared) const {
    const double reach = std::sqrt(squared) + radius_;
    return reach * reach;
  }
  double squared_distance(const Vector3d& q, Eigen::Index of) const {
    const Eigen::Index first = of * group;
    const auto along = along_.middleRows<group>(first);
    Points<group> away = from_to(from_.middleRows<group>(first), q);
    const Eigen::Array<double, group, 1> share =
        ((along * away).rowwise().sum() * inverse_.segment<group>(first)).max(0.0).min(1.0);
    for (int axis = 0; axis < 3; ++axis) away.col(axis) -= share * along.col(axis);
    return squares(away).minCoeff();
  }

  Points<pieces> from_, along_;
  Eigen::Array<double, pieces, 1> inverse_;  // of squared lengths
  Points<groups> middle_;
  double radius_ = 0.0;  // m
};

// The feet of samples on the surface of a patch, nearest in metres, a block at a time.
class Feet {
 public:
  Feet(const Patch& patch, const Samples& samples) : samples_(samples), kappa_(k3(patch)) {
    const Matrix3d R = axes(patch);
    const Vector3d c = centre(patch) - samples.origin;
    for (Eigen::Index i = 0; i < 3; ++i) {
      surface_.c[i] = c[i];
      surface_.k3[i] = kappa_[i];
      for (Eigen::Index j = 0; j < 3; ++j) surface_.R[i][j] = R(i, j);
    }
    points_.thin = false;
    for (const std::size_t entry : {0U, 1U, 2U, 3U, 4U, 5U}) {
      const bool diagonal = entry == 0 || entry == 3 || entry == 5;
      std::ranges::fill(points_.cov[entry], diagonal ? 1.0 : 0.0);
    }
  }
  void find(std::size_t block) {
    constexpr int F = row_count - 1;  // in metres, where noise is of unit variance
    std::memcpy(points_.q, samples_.blocks[block].q, sizeof points_.q);
    const std::size_t first = block * block_size;
    const std::size_t count = whole_lanes(std::min(block_size, samples_.size() - first));
    const bool found = fastest_rows().exact(surface_, points_, count, rows_);
    for (std::size_t i = 0; !found && i < count; ++i) {
      if (rows_.failed[i] == 0.0) continue;
      const Vector3d q = local(first + i), x = foot_point(q, Matrix3d::Identity(), kappa_).x;
      rows_.row[F][i] = (q - x).norm();
      for (Eigen::Index axis = 0; axis < 3; ++axis) rows_.x[axis][i] = x[axis];
    }
  }
  double x(std::size_t i) const { return rows_.x[0][i]; }
  double y(std::size_t i) const { return rows_.x[1][i]; }
  double squared_distance(std::size_t i) const {
    return rows_.row[row_count - 1][i] * rows_.row[row_count - 1][i];
  }
  Vector3d local(std::size_t sample) const {
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> R(surface_.R[0]);
    return R.transpose() * (samples_.q(sample) - Eigen::Map<const Vector3d>(surface_.c));
  }

 private:
  const Samples& samples_;
  Vector3d kappa_;
  RowSurface surface_{};
  SampleBlock points_;
  RowBlock rows_;
};

}  // namespace

double distance_rms(const Patch& patch, const Samples& samples) {
  const Boundary bound = boundary(patch);
  const InsideOutline inside(bound);
  const Rim rim(bound, k3(patch));
  const double sum = sum_over_parts<double>(samples.blocks.size(), [&](const Chunk& part) {
    Feet feet(patch, samples);
    double of_part = 0.0;
    for (std::size_t block = part.first; block < part.last; ++block) {
      feet.find(block);
      const std::size_t first = block * block_size, count = std::min(block_size, samples.size() - first);
      for (std::size_t i = 0; i < count; ++i) {
        if (samples.robust[first + i] == 0.0) continue;
        of_part += inside.contains(feet.x(i), feet.y(i)) ? feet.squared_distance(i)
                                                         : rim.squared_distance(feet.local(first + i));
      }
    }
    return of_part;
  });
  const auto count = std::ranges::count_if(samples.robust, [](double weight) { return weight != 0.0; });
  return std::sqrt(sum / static_cast<double>(std::max<std::ptrdiff_t>(count, 1)));
}

}  // namespace patchlab
