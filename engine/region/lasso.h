// Selecting points by a lasso: a closed contour on the screen and the camera it was drawn with. What it
// yields depends on nothing else: not on GL, UI scale, point budget or thread count.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/scan/scan.h"

namespace patchlab {

// The camera of a view, as the journal stores it. Looks along -z of its own frame (the OpenGL convention), x
// right, y up.
struct ViewCamera {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();          // m, in the frame of the points
  std::array<double, 4> quaternion_xyzw = {0, 0, 0, 1};        // world_from_view
  double fov_y = 0.8;                                          // vertical field of view, rad (perspective)
  double near_plane = 0.01;                                    // m: nothing nearer is selected
  double far_plane = std::numeric_limits<double>::infinity();  // m: nor anything farther
  bool perspective = true;
  double height = 1.0;                        // m, world height of the viewport (orthographic)
  std::array<int, 2> viewport = {1280, 800};  // px
};

// A point in viewport pixels, x right, y down from the upper left corner, with its depth along the view axis
// in metre.
struct Projected {
  double x, y, depth;
};
Projected project(const ViewCamera& camera, const Eigen::Vector3d& point);

// Is it between the planes of the camera?
inline bool in_depth(const ViewCamera& camera, double depth) {
  return depth > camera.near_plane && depth <= camera.far_plane;
}

enum class SelectMode { set, add, subtract, intersect };

// Ids (ascending) of the finite points inside the contour (viewport pixels, even-odd rule), between
// the near and the far plane. Precondition: none; fewer than three vertices select nothing. Exact: the raster
// mask decides only whole cells, points of edge cells are tested against the polygon itself.
std::vector<std::uint32_t> select_lasso(const Scan& scan, const ViewCamera& camera,
                                        const std::vector<Eigen::Vector2d>& contour);

// The exact scalar polygon test that select_lasso is held to.
bool inside_polygon(const std::vector<Eigen::Vector2d>& contour, double x, double y);

// Set algebra on ascending ids.
std::vector<std::uint32_t> combine(const std::vector<std::uint32_t>& before,
                                   const std::vector<std::uint32_t>& selected, SelectMode mode);

}  // namespace patchlab
