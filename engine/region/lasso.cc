#include "engine/region/lasso.h"

#include <algorithm>
#include <iterator>

#include "engine/region/polygon_mask.h"
#include "engine/region/projector.h"

namespace patchlab {

Projected project(const ViewCamera& camera, const Eigen::Vector3d& point) { return Projector(camera)(point); }

bool inside_polygon(const std::vector<Eigen::Vector2d>& contour, double x, double y) {
  return inside_polygon(polygon_edges(contour), x, y);
}

std::vector<std::uint32_t> select_lasso(const Scan& scan, const ViewCamera& camera,
                                        const std::vector<Eigen::Vector2d>& contour) {
  std::vector<std::uint32_t> selected;
  if (contour.size() < 3) return selected;
  const PolygonMask mask(contour);
  const Projector project_point(camera);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!scan.finite[i]) continue;
    const Projected pixel = project_point(scan.point(i));
    const bool in = pixel.depth > camera.near_plane && mask.contains(pixel.x, pixel.y);
    if (in) selected.push_back(static_cast<std::uint32_t>(i));
  }
  return selected;
}

std::vector<std::uint32_t> combine(const std::vector<std::uint32_t>& before,
                                   const std::vector<std::uint32_t>& selected, SelectMode mode) {
  std::vector<std::uint32_t> after;
  const auto out = std::back_inserter(after);
  switch (mode) {
    case SelectMode::set:
      return selected;
    case SelectMode::add:
      std::set_union(before.begin(), before.end(), selected.begin(), selected.end(), out);
      break;
    case SelectMode::subtract:
      std::set_difference(before.begin(), before.end(), selected.begin(), selected.end(), out);
      break;
    case SelectMode::intersect:
      std::set_intersection(before.begin(), before.end(), selected.begin(), selected.end(), out);
      break;
  }
  return after;
}

}  // namespace patchlab
