// The same lasso by Open3D.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace patchlab::bench {

// A sentence: how long SelectionPolygonVolume::CropPointCloud takes for points that lie in pixels already;
// empty where the engine is built without Open3D.
std::string open3d_crop(std::size_t points, const std::vector<Eigen::Vector2d>& contour);

}  // namespace patchlab::bench
