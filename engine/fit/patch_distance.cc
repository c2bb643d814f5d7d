#include "engine/fit/patch_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include "engine/base/parallel.h"
#include "engine/fit/inside_outline.h"
#include "engine/patch/surface.h"

namespace patchlab {
namespace {

constexpr std::size_t blocks_a_chunk = 16;

// The outline as a closed curve of straight pieces on the surface, in groups that balls hold: of most groups
// their ball says that they are farther than what was found.
class Rim {
 public:
  Rim(const Boundary& bound, const Vector3d& kappa) {
    put_outline(bound);
    for (std::size_t i = 0; i < points; ++i) {
      Vector3d& q = curve_[i];
      q.z() = kappa.z() == 0.0 ? 0.5 * (kappa.x() * q.x() * q.x() + kappa.y() * q.y() * q.y())
                               : height(q.head<2>(), kappa);
    }
    curve_[points] = curve_[0];
    for (std::size_t i = 0; i < points; ++i) {
      const double squared = (curve_[i + 1] - curve_[i]).squaredNorm();
      inverse_[i] = squared > 0.0 ? 1.0 / squared : 0.0;
    }
    for (std::size_t i = 0; i < groups; ++i) balls_[i] = ball(i);
  }
  double squared_distance(const Vector3d& q) const {
    std::array<double, groups> away;  // from the middles
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < groups; ++i) {
      away[i] = (q - balls_[i].centre).squaredNorm();
      if (away[i] < away[nearest]) nearest = i;
    }
    double least = squared_distance(q, nearest), reach = std::sqrt(least);
    for (std::size_t i = 0; i < groups; ++i) {
      const double within = reach + balls_[i].radius;
      if (i == nearest || away[i] > within * within) continue;
      least = std::min(least, squared_distance(q, i));
      reach = std::sqrt(least);
    }
    return least;
  }

 private:
  static constexpr std::size_t points = 128, group = 8, groups = points / group;

  struct Ball {
    Vector3d centre;
    double radius;
  };

  static std::array<Vector2d, points> unit_circle() {
    const std::vector<Vector2d> circle =
        outline({BoundaryType::circle, BoundaryVector::Ones(1)}, static_cast<int>(points));
    std::array<Vector2d, points> all;
    std::ranges::copy(circle, all.begin());
    return all;
  }
  void put_outline(const Boundary& bound) {
    static const std::array<Vector2d, points> circle = unit_circle();
    if (is_round(bound)) {
      const Vector2d radii = extent(bound);
      for (std::size_t i = 0; i < points; ++i) curve_[i].head<2>() = radii.cwiseProduct(circle[i]);
      return;
    }
    constexpr std::size_t a_side = points / 4;
    const std::array<Vector2d, 4> corners = vertices(bound);
    for (std::size_t i = 0; i < points; ++i) {
      const double along = static_cast<double>(i % a_side) / a_side;
      curve_[i].head<2>() = (1.0 - along) * corners[i / a_side] + along * corners[(i / a_side + 1) % 4];
    }
  }
  Ball ball(std::size_t of) const {
    const auto at = curve_.begin() + static_cast<std::ptrdiff_t>(of * group);
    Ball ball{0.5 * (at[0] + at[group]), 0.0};
    for (std::size_t i = 0; i <= group; ++i) {
      ball.radius = std::max(ball.radius, (at[static_cast<std::ptrdiff_t>(i)] - ball.centre).squaredNorm());
    }
    ball.radius = std::sqrt(ball.radius);
    return ball;
  }
  double squared_distance(const Vector3d& q, std::size_t of) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = of * group; i < (of + 1) * group; ++i) {
      const Vector3d from = q - curve_[i], along = curve_[i + 1] - curve_[i];
      const double s = std::clamp(along.dot(from) * inverse_[i], 0.0, 1.0);
      least = std::min(least, (from - s * along).squaredNorm());
    }
    return least;
  }

  std::array<Vector3d, points + 1> curve_;
  std::array<double, points> inverse_;
  std::array<Ball, groups> balls_;
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
    for (const std::size_t diagonal : {0U, 3U, 5U}) std::ranges::fill(points_.cov[diagonal], 1.0);
  }
  void find(std::size_t block) {
    constexpr int F = row_count - 1;  // in metres, where noise is of unit variance
    std::memcpy(points_.q, samples_.blocks[block].q, sizeof points_.q);
    const std::size_t first = block * block_size;
    const bool found = fastest_rows().exact(surface_, points_, block_size, rows_);
    for (std::size_t i = 0; !found && i < block_size && first + i < samples_.size(); ++i) {
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
    return R.transpose() * (samples_.q[sample] - Eigen::Map<const Vector3d>(surface_.c));
  }

 private:
  const Samples& samples_;
  Vector3d kappa_;
  RowSurface surface_{};
  SampleBlock points_{};
  RowBlock rows_;
};

}  // namespace

double distance_rms(const Patch& patch, const Samples& samples) {
  const Boundary bound = boundary(patch);
  const InsideOutline inside(bound);
  const Rim rim(bound, k3(patch));
  const std::size_t chunks = chunk_count(samples.blocks.size(), blocks_a_chunk);
  std::vector<double> sums(chunks);
  for_each_chunk(samples.blocks.size(), blocks_a_chunk, [&](const Chunk& chunk) {
    Feet feet(patch, samples);
    double sum = 0.0;
    for (std::size_t block = chunk.first; block < chunk.last; ++block) {
      feet.find(block);
      const std::size_t first = block * block_size, count = std::min(block_size, samples.size() - first);
      for (std::size_t i = 0; i < count; ++i) {
        if (samples.robust[first + i] == 0.0) continue;
        sum += inside.contains(feet.x(i), feet.y(i)) ? feet.squared_distance(i)
                                                     : rim.squared_distance(feet.local(first + i));
      }
    }
    sums[chunk.number] = sum;
  });
  const auto count = std::ranges::count_if(samples.robust, [](double weight) { return weight != 0.0; });
  const double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
  return std::sqrt(sum / static_cast<double>(std::max<std::ptrdiff_t>(count, 1)));
}

}  // namespace patchlab
