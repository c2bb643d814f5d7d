// A patch as things to draw: its surface coloured by the standard deviation of its height, its outline with a
// band, its axes, the ellipsoid of its centre and the cone of its normal; and the words that say with what
// probability and how much larger than true.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/patch/patch.h"
#include "engine/project/document.h"
#include "viewer/panel/view_state.h"
#include "viewer/render/scene.h"

namespace patchlab::viewer {

inline constexpr double shown_probability = 0.95;

// The largest of 1, 2, 5, 10, 20, 50 ... with which `size` times it is at most `room`; at least 1.
int exaggeration(double size, double room);
// "drawn 10 times larger", or "at true size".
std::string exaggeration_words(int times, const char* larger);

// The patch with that part of its covariance alone.
Patch with_part(const Patch& patch, SigmaOf part);

// The surface with one colour a vertex, made once a fit.
struct SurfaceMesh {
  MeshItem item;
  std::optional<Eigen::Vector2d> height_sigma;  // least and largest, m; none for a patch without covariance
};
// By height sigma, or all in `flat`.
SurfaceMesh surface_item(const Patch& patch, const Eigen::Vector3d& origin, const std::optional<Rgba>& flat,
                         ColourMap map = ColourMap::viridis);

// Anchors of text: the tips of the axes.
struct AxisTip {
  Eigen::Vector3d position;  // m, world
  std::string text;
  Rgba colour;
};

struct PatchScene {
  std::vector<MeshItem> meshes;
  std::vector<LineItem> lines;
  std::vector<AxisTip> tips;
  std::vector<std::string> notes;
};
LineItem outline_item(const Patch& patch, const Eigen::Vector3d& origin, const Rgba& colour, float width);
// Lines of equal x and of equal y of its local axes.
std::vector<LineItem> grid_items(const Patch& patch, const Eigen::Vector3d& origin, const Rgba& colour,
                                 float width);
// 95 % ellipsoids of some points of a region, `apart` (m) from each other in the middle.
PatchScene point_ellipsoids(const ScanEntry& scan, const RegionEntry& region, double apart,
                            const Eigen::Vector3d& origin, const Theme& theme);
// Everything of the chosen patch but its surface. Line widths are in pixels at `scale`.
PatchScene chosen_patch(const Patch& patch, const Eigen::Vector3d& origin, const Layers& layers,
                        const Theme& theme, const Rgba& colour, float scale);

}  // namespace patchlab::viewer
