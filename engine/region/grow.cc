#include "engine/region/grow.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "engine/scan/neighbours.h"

namespace patchlab {
namespace {

constexpr std::size_t ring = 8;              // neighbours of a point
constexpr std::size_t around_a_normal = 32;  // points that a normal is made of
constexpr std::size_t look_up = 1024;        // points between two reports of progress

// One flag a point.
using Flags = std::vector<std::uint8_t>;

Flags flags_of(const Scan& scan, const PointIds& ids) {
  Flags in(scan.size(), 0);
  for (const std::uint32_t id : ids) in[id] = 1;
  return in;
}

PointIds ids_of(const Flags& in) {
  PointIds ids;
  for (std::uint32_t i = 0; i < in.size(); ++i) {
    if (in[i]) ids.push_back(i);
  }
  return ids;
}

// Calls visit(neighbour) for the nearest eight of a point.
template <class Visit>
void for_ring(const NeighbourIndex& index, const Scan& scan, std::uint32_t id, std::vector<Neighbour>& found,
              Visit visit) {
  index.nearest(scan.positions[id], ring + 1, found);
  for (const Neighbour& neighbour : found) {
    if (neighbour.id != id) visit(neighbour);
  }
}

// The surface around a point: its normal, of either sign, and how far apart the nearest points are.
struct Facet {
  Eigen::Vector3f normal;
  float spacing;  // m
};

class Flood {
 public:
  Flood(const Scan& scan, const FloodLimits& limits)
      : scan_(scan), index_(scan), limits_(limits), known_(scan.size(), 0), facets_(scan.size()) {}

  std::optional<std::uint32_t> nearest_point(const Eigen::Vector3d& position) {
    index_.nearest((position - scan_.origin).cast<float>(), 1, found_);
    return found_.empty() ? std::nullopt : std::optional(found_.front().id);
  }

  Result<PointIds> from(const PointIds& seeds, const Progress& progress) {
    Flags in = flags_of(scan_, seeds);
    const Eigen::Vector3f first =
        seeds.empty() ? Eigen::Vector3f::Zero().eval() : facet(seeds.front()).normal;
    PointIds front = seeds;
    for (std::size_t done = 0; done < front.size(); ++done) {
      if (done % look_up == 0 &&
          !keep_going(progress, static_cast<double>(done) / static_cast<double>(scan_.size()))) {
        return Error{ErrorCode::cancelled, "The selection was cancelled."};
      }
      const std::uint32_t id = front[done];
      const Facet here = facet(id);
      std::vector<Neighbour> around;
      for_ring(index_, scan_, id, around, [&](const Neighbour& neighbour) {
        if (in[neighbour.id] || !joins(here, neighbour, first)) return;
        in[neighbour.id] = 1;
        front.push_back(neighbour.id);
      });
    }
    return ids_of(in);
  }

 private:
  bool joins(const Facet& here, const Neighbour& neighbour, const Eigen::Vector3f& first) {
    if (std::sqrt(neighbour.squared_distance) > limits_.jump * here.spacing) return false;
    const Eigen::Vector3f& normal = facet(neighbour.id).normal;
    if (std::abs(normal.dot(here.normal)) < std::cos(limits_.step)) return false;
    return !limits_.from_seed || std::abs(normal.dot(first)) >= std::cos(*limits_.from_seed);
  }

  const Facet& facet(std::uint32_t id) {
    if (!known_[id]) facets_[id] = make_facet(id);
    known_[id] = 1;
    return facets_[id];
  }

  Facet make_facet(std::uint32_t id) {
    index_.nearest(scan_.positions[id], around_a_normal, found_);
    Eigen::Vector3f mean = Eigen::Vector3f::Zero();
    for (const Neighbour& neighbour : found_) mean += scan_.positions[neighbour.id];
    mean /= static_cast<float>(found_.size());
    Eigen::Matrix3f spread = Eigen::Matrix3f::Zero();
    for (const Neighbour& neighbour : found_) {
      const Eigen::Vector3f away = scan_.positions[neighbour.id] - mean;
      spread += away * away.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver(spread);
    // As many points as are around a normal fill a disk: its radius says how far apart they are.
    const float radius = std::sqrt(found_.back().squared_distance);
    return {solver.eigenvectors().col(0), 2.0F * radius / std::sqrt(static_cast<float>(found_.size()))};
  }

  const Scan& scan_;
  NeighbourIndex index_;
  FloodLimits limits_;
  Flags known_;
  std::vector<Facet> facets_;
  std::vector<Neighbour> found_;
};

}  // namespace

PointIds invert(const Scan& scan, const PointIds& ids) {
  const Flags in = flags_of(scan, ids);
  PointIds others;
  for (std::uint32_t i = 0; i < scan.size(); ++i) {
    if (scan.finite[i] && !in[i]) others.push_back(i);
  }
  return others;
}

PointIds grow(const Scan& scan, const PointIds& ids, int steps) {
  const NeighbourIndex index(scan);
  Flags in = flags_of(scan, ids);
  std::vector<Neighbour> found;
  PointIds edge = ids;
  for (int step = 0; step < steps; ++step) {
    PointIds next;
    for (const std::uint32_t id : edge) {
      for_ring(index, scan, id, found, [&](const Neighbour& neighbour) {
        if (in[neighbour.id]) return;
        in[neighbour.id] = 1;
        next.push_back(neighbour.id);
      });
    }
    edge = std::move(next);
  }
  return ids_of(in);
}

PointIds shrink(const Scan& scan, const PointIds& ids, int steps) {
  const NeighbourIndex index(scan);
  Flags in = flags_of(scan, ids);
  std::vector<Neighbour> found;
  for (int step = 0; step < steps; ++step) {
    const Flags before = in;
    for (const std::uint32_t id : ids) {
      if (!before[id]) continue;
      for_ring(index, scan, id, found, [&](const Neighbour& neighbour) {
        if (!before[neighbour.id]) in[id] = 0;
      });
    }
  }
  return ids_of(in);
}

Result<PointIds> flood(const Scan& scan, const Eigen::Vector3d& seed, const FloodLimits& limits,
                       const Progress& progress) {
  Flood flooding(scan, limits);
  const std::optional<std::uint32_t> first = flooding.nearest_point(seed);
  return flooding.from(first ? PointIds{*first} : PointIds{}, progress);
}

Result<PointIds> linked(const Scan& scan, const PointIds& ids, const Progress& progress) {
  FloodLimits limits;
  limits.from_seed.reset();
  return Flood(scan, limits).from(ids, progress);
}

}  // namespace patchlab
