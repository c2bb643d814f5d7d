#include "tests/bench/lasso/open3d.h"

#include <open3d/geometry/PointCloud.h>
#include <open3d/visualization/utility/SelectionPolygonVolume.h>

#include "tests/bench/round_robin/round_robin.h"

namespace patchlab::bench {

std::string open3d_crop(std::size_t points, const std::vector<Eigen::Vector2d>& contour) {
  open3d::geometry::PointCloud cloud;
  std::uint64_t state = 1;
  const auto next = [&state] {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return static_cast<double>(state >> 11) * 0x1p-53;
  };
  for (std::size_t i = 0; i < points; ++i) cloud.points_.emplace_back(1920.0 * next(), 1080.0 * next(), 0.5);
  open3d::visualization::SelectionPolygonVolume volume;
  volume.orthogonal_axis_ = "Z";
  volume.axis_max_ = 1.0;
  for (const Eigen::Vector2d& corner : contour)
    volume.bounding_polygon_.emplace_back(corner.x(), corner.y(), 0.0);
  RoundRobin times(1);
  times.add("crop", [&] { (void)volume.CropPointCloud(cloud); });
  times.run();
  return "\nOpen3D's `CropPointCloud` on " + std::to_string(points) +
         " points in pixels: " + time_of(times, "crop") + ".\n";
}

}  // namespace patchlab::bench
