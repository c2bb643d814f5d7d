// Which points of a scan lie near which: by distance (a k-d tree) or on the pixel grid of an organised scan.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/scan/scan.h"

namespace patchlab {

struct Neighbour {
  std::uint32_t id;        // of the scan
  float squared_distance;  // m^2
};

// Nearest points and balls among the finite points of a scan, by PCL's k-d tree. Positions are about the
// origin of the scan, as Scan::positions. It keeps its own copy of the points, so the scan may go; copies of
// the index share one tree. Searches are const and may run on many threads at once.
class NeighbourIndex {
 public:
  explicit NeighbourIndex(const Scan& scan);

  // The (at most) k points nearest to a finite position, nearest first; the point at the position itself is
  // one of them.
  void nearest(const Eigen::Vector3f& position, std::size_t k, std::vector<Neighbour>& found) const;
  // All points at most `radius` metres from a finite position, nearest first.
  void within(const Eigen::Vector3f& position, double radius, std::vector<Neighbour>& found) const;

 private:
  struct Tree;
  std::shared_ptr<const Tree> tree_;
};

// Ids (ascending) of the finite points at most `reach` pixels away from point `id` in row and in column,
// itself left out. Precondition: scan.organized(), id < scan.size().
void grid_neighbours(const Scan& scan, std::uint32_t id, std::uint32_t reach,
                     std::vector<std::uint32_t>& found);

}  // namespace patchlab
