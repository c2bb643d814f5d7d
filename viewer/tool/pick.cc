#include "viewer/tool/pick.h"

#include <cmath>
#include <limits>

#include "engine/project/placed.h"
#include "viewer/camera/orbit_camera.h"

namespace patchlab::viewer {

std::optional<std::uint32_t> pick_point(const Scan& scan, const ViewCamera& camera,
                                        const Eigen::Vector2d& pixel, double window) {
  std::optional<std::uint32_t> best;
  double best_score = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!scan.finite[i]) continue;
    const Projected p = project(camera, scan.point(i));
    if (!in_depth(camera, p.depth)) continue;
    const double away = std::hypot(p.x - pixel.x(), p.y - pixel.y());
    if (away > window) continue;
    const double score = std::max(away, window / 4) * p.depth;
    if (score >= best_score) continue;
    best_score = score;
    best = static_cast<std::uint32_t>(i);
  }
  return best;
}

std::optional<std::string> pick_patch(const Document& document, const ViewCamera& camera,
                                      const Eigen::Vector2d& pixel) {
  const Ray through = ray(camera, pixel);
  std::optional<std::string> hit;
  double nearest = std::numeric_limits<double>::infinity();
  for (const PlacedPatch& placed : placed_patches(document)) {
    if (!is_visible(document, placed)) continue;
    const Result<Patch> patch = as_shown(document, placed);
    if (!patch) continue;
    const std::optional<double> s = ray_hit(*patch, through.origin, through.direction);
    if (!s || *s >= nearest) continue;
    nearest = *s;
    hit = placed.id;
  }
  return hit;
}

}  // namespace patchlab::viewer
