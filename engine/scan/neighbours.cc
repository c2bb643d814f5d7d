#include "engine/scan/neighbours.h"

#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>

#include <algorithm>

namespace patchlab {

struct NeighbourIndex::Tree {
  std::vector<std::uint32_t> ids;  // of the scan, for each point of the tree
  pcl::KdTreeFLANN<pcl::PointXYZ> kdtree;

  void translate(const pcl::Indices& rows, const std::vector<float>& squared_distances,
                 std::vector<Neighbour>& found) const {
    found.clear();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      found.push_back({ids[static_cast<std::size_t>(rows[i])], squared_distances[i]});
    }
  }
};

NeighbourIndex::NeighbourIndex(const Scan& scan) {
  auto tree = std::make_shared<Tree>();
  const auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  tree->ids.reserve(scan.finite_count);
  cloud->reserve(scan.finite_count);
  for (std::uint32_t id = 0; id < scan.size(); ++id) {
    if (!scan.finite[id]) continue;
    const Eigen::Vector3f& position = scan.positions[id];
    tree->ids.push_back(id);
    cloud->push_back({position.x(), position.y(), position.z()});
  }
  if (!cloud->empty()) tree->kdtree.setInputCloud(cloud);
  tree_ = std::move(tree);
}

void NeighbourIndex::nearest(const Eigen::Vector3f& position, std::size_t k,
                             std::vector<Neighbour>& found) const {
  pcl::Indices rows;
  std::vector<float> squared_distances;
  const auto count = static_cast<unsigned int>(std::min(k, tree_->ids.size()));
  if (count > 0) {
    tree_->kdtree.nearestKSearch({position.x(), position.y(), position.z()}, count, rows, squared_distances);
  }
  tree_->translate(rows, squared_distances, found);
}

void NeighbourIndex::within(const Eigen::Vector3f& position, double radius,
                            std::vector<Neighbour>& found) const {
  pcl::Indices rows;
  std::vector<float> squared_distances;
  if (!tree_->ids.empty()) {
    tree_->kdtree.radiusSearch({position.x(), position.y(), position.z()}, radius, rows, squared_distances);
  }
  tree_->translate(rows, squared_distances, found);
}

void grid_neighbours(const Scan& scan, std::uint32_t id, std::uint32_t reach,
                     std::vector<std::uint32_t>& found) {
  const std::uint32_t row = id / scan.width, column = id % scan.width;
  const std::uint32_t last_row = std::min(row + reach, scan.height - 1);
  const std::uint32_t last_column = std::min(column + reach, scan.width - 1);
  found.clear();
  for (std::uint32_t r = row - std::min(row, reach); r <= last_row; ++r) {
    for (std::uint32_t c = column - std::min(column, reach); c <= last_column; ++c) {
      const std::uint32_t neighbour = r * scan.width + c;
      if (neighbour != id && scan.finite[neighbour]) found.push_back(neighbour);
    }
  }
}

}  // namespace patchlab
