#include "viewer/app/patch_scene.h"

#include <algorithm>
#include <cmath>

#include "engine/base/chi_square.h"
#include "engine/mesh/patch_mesh.h"
#include "engine/patch/marginals.h"
#include "viewer/app/point_scale.h"
#include "viewer/app/shapes.h"
#include "viewer/panel/colours.h"

namespace patchlab::viewer {

namespace {

using Eigen::Vector3d;

// How much of a patch's size the exaggerated shapes may take.
constexpr double ellipsoid_room = 0.22, band_room = 0.08, cone_room = 0.30 /* rad */, offset_room = 0.15;
constexpr double axis_length = 0.62;
constexpr int band_points = 128;
constexpr int grid_half = 4, grid_samples = 24;  // lines each side of the middle, points each side on a line
constexpr std::size_t most_point_ellipsoids = 500;
constexpr double point_room = 0.7;  // of the distance from one shown point to the next
constexpr float surface_alpha = 0.80f;

double size_of(const Patch& patch) { return extent(boundary(patch)).maxCoeff(); }

void add_axes(const Patch& patch, const Vector3d& origin, const Theme& theme, float scale,
              PatchScene& scene) {
  const Vector3d c = centre(patch);
  const Eigen::Matrix3d R = axes(patch);
  const double length = axis_length * size_of(patch);
  const struct {
    const char* text;
    Rgba colour;
  } axis[] = {{"x", theme.axis_x}, {"y", theme.axis_y}, {"z", theme.axis_z}};
  for (int k = 0; k < 3; ++k) {
    const Vector3d tip = c + length * R.col(k);
    scene.lines.push_back({about({c, tip}, origin), axis[k].colour, 2.5f * scale, false, true, 0.55f});
    scene.tips.push_back({c + 1.08 * length * R.col(k), axis[k].text, axis[k].colour});
  }
}

void add_ellipsoid(const Patch& patch, const Vector3d& origin, const Theme& theme, float scale,
                   PatchScene& scene) {
  const Ellipsoid shape = centre_ellipsoid(patch, shown_probability);
  const int times = exaggeration(shape.half_lengths.maxCoeff(), ellipsoid_room * size_of(patch));
  scene.meshes.push_back(ellipsoid_mesh(shape, times, origin, theme.ellipsoid));
  for (LineItem& rim : ellipsoid_rims(shape, times, origin, theme.ellipsoid_rim, 1.25f * scale)) {
    scene.lines.push_back(std::move(rim));
  }
  scene.notes.push_back("95 % ellipsoid of the centre, " + exaggeration_words(times, "larger"));
}

std::string add_cone(const Patch& patch, const Vector3d& origin, const Theme& theme, float scale,
                     PatchScene& scene) {
  const NormalCone cone = normal_cone(patch, shown_probability);
  const int times = exaggeration(cone.half_angles.maxCoeff(), cone_room);
  const std::vector<Vector3d> rim = cone_rim(cone, times, axis_length * size_of(patch));
  scene.meshes.push_back(cone_mesh(cone, rim, origin, with_alpha(theme.axis_z, 0.22f)));
  scene.lines.push_back(
      {about(rim, origin), with_alpha(theme.axis_z, 0.9f), 1.25f * scale, true, true, 0.5f});
  return "95 % cone of the normal, " + exaggeration_words(times, "wider");
}

std::string add_band(const Patch& patch, const Vector3d& origin, const Rgba& colour, PatchScene& scene) {
  const std::vector<BandPoint> band = outline_band(patch, band_points);
  double widest = 0;
  for (const BandPoint& point : band) widest = std::max(widest, point.sigma);
  const double k = two_sided_normal_quantile(shown_probability);
  const int times = exaggeration(k * widest, band_room * size_of(patch));
  std::vector<double> outwards, inwards;
  for (const BandPoint& point : band) {
    outwards.push_back(times * k * point.sigma);
    inwards.push_back(-times * k * point.sigma);
  }
  scene.meshes.push_back(strip_mesh(offset_curve(patch, outwards), offset_curve(patch, inwards), origin,
                                    with_alpha(colour, 0.38f)));
  return "95 % band of the outline, " + exaggeration_words(times, "wider");
}

std::vector<std::uint32_t> triangles_of(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> triangles;
  for (const auto face : mesh.faces()) {
    for (const auto vertex : face.vertices()) triangles.push_back(static_cast<std::uint32_t>(vertex.idx()));
  }
  return triangles;
}

// The surface moved along its normals to both ends of where it lies with that probability.
std::string add_offsets(const Patch& patch, const Vector3d& origin, const Rgba& colour, PatchScene& scene) {
  const TriangleMesh mesh = surface_mesh(patch);
  const std::vector<Vector2d> u = surface_coordinates(patch);
  const double k = two_sided_normal_quantile(shown_probability);
  std::vector<double> reach(u.size());
  std::transform(u.begin(), u.end(), reach.begin(),
                 [&](const Vector2d& at) { return k * height_sigma(patch, at); });
  const int times = exaggeration(*std::max_element(reach.begin(), reach.end()), offset_room * size_of(patch));
  const auto triangles = std::make_shared<const std::vector<std::uint32_t>>(triangles_of(mesh));
  for (const double side : {1.0, -1.0}) {
    std::vector<MeshVertex> vertices;
    for (const auto vertex : mesh.vertices()) {
      const auto& p = mesh.point(vertex);
      const auto& n = mesh.normal(vertex);
      const Vector3d normal(n[0], n[1], n[2]);
      const Vector3d moved =
          Vector3d(p[0], p[1], p[2]) + side * times * reach[static_cast<std::size_t>(vertex.idx())] * normal;
      vertices.push_back({(moved - origin).cast<float>(), normal.cast<float>(), to_bytes(colour)});
    }
    scene.meshes.push_back(
        {std::make_shared<const std::vector<MeshVertex>>(std::move(vertices)), triangles, true});
  }
  return "95 % of the height, " + exaggeration_words(times, "further off");
}

}  // namespace

Patch with_part(const Patch& patch, SigmaOf part) {
  if (part == SigmaOf::both || !patch.covariance_local) return patch;
  Patch alone = patch;
  PatchMatrix& cov = *alone.covariance_local;
  const int shape = patch.type->rotation_at(), pose = patch.type->size() - shape;
  if (part == SigmaOf::shape) {
    cov.rightCols(pose).setZero();
    cov.bottomRows(pose).setZero();
  } else {
    cov.leftCols(shape).setZero();
    cov.topRows(shape).setZero();
  }
  return alone;
}

int exaggeration(double size, double room) {
  if (!(size > 0)) return 1;
  int chosen = 1;
  for (int decade = 1; decade <= 10'000; decade *= 10) {
    for (const int step : {1, 2, 5}) {
      if (size * step * decade <= room) chosen = step * decade;
    }
  }
  return chosen;
}

std::string exaggeration_words(int times, const char* larger) {
  return times == 1 ? "at true size" : "drawn " + std::to_string(times) + " times " + larger;
}

SurfaceMesh surface_item(const Patch& patch, const Vector3d& origin, const std::optional<Rgba>& flat,
                         ColourMap map) {
  const TriangleMesh mesh = surface_mesh(patch);
  SurfaceMesh surface;
  std::vector<double> sigma(mesh.n_vertices(), 0.0);
  if (!flat && patch.covariance_local) {
    const std::vector<Vector2d> u = surface_coordinates(patch);
    std::transform(u.begin(), u.end(), sigma.begin(),
                   [&patch](const Vector2d& at) { return height_sigma(patch, at); });
    const auto [least, largest] = std::minmax_element(sigma.begin(), sigma.end());
    surface.height_sigma = Eigen::Vector2d(*least, *largest);
  }
  const double least = surface.height_sigma ? surface.height_sigma->x() : 0.0;
  const double range = surface.height_sigma ? std::max(surface.height_sigma->y() - least, 1e-12) : 1.0;
  std::vector<MeshVertex> vertices;
  vertices.reserve(mesh.n_vertices());
  for (const auto vertex : mesh.vertices()) {
    const auto& p = mesh.point(vertex);
    const auto& n = mesh.normal(vertex);
    const double part = (sigma[static_cast<std::size_t>(vertex.idx())] - least) / range;
    const Rgba colour = flat ? *flat : with_alpha(sequential(part, map), surface_alpha);
    vertices.push_back({(Vector3d(p[0], p[1], p[2]) - origin).cast<float>(),
                        Vector3d(n[0], n[1], n[2]).cast<float>(), to_bytes(colour)});
  }
  surface.item = {std::make_shared<const std::vector<MeshVertex>>(std::move(vertices)),
                  std::make_shared<const std::vector<std::uint32_t>>(triangles_of(mesh)), true};
  return surface;
}

LineItem outline_item(const Patch& patch, const Vector3d& origin, const Rgba& colour, float width) {
  return {about(outline_curve(patch), origin), colour, width, true, true, 0.45f};
}

std::vector<LineItem> grid_items(const Patch& patch, const Vector3d& origin, const Rgba& colour,
                                 float width) {
  const Boundary outline = boundary(patch);
  const Eigen::Vector2d half = extent(outline);
  const Pose world = world_from_patch(patch);
  const Vector3d k = k3(patch);
  std::vector<LineItem> lines;
  const auto end = [&](std::vector<Vector3d>& run) {
    if (run.size() > 1) lines.push_back({about(run, origin), colour, width, false, true, 0.4f});
    run.clear();
  };
  for (const int along : {0, 1}) {
    for (int i = 1 - grid_half; i < grid_half; ++i) {
      std::vector<Vector3d> run;
      for (int j = -grid_samples; j <= grid_samples; ++j) {
        Vector2d u;
        u[along] = half[along] * j / grid_samples;
        u[1 - along] = half[1 - along] * i / grid_half;
        if (contains(outline, u))
          run.push_back(apply(world, surface_point(u, k)));
        else
          end(run);
      }
      end(run);
    }
  }
  return lines;
}

PatchScene point_ellipsoids(const ScanEntry& entry, const RegionEntry& region, double apart,
                            const Vector3d& origin, const Theme& theme) {
  PatchScene scene;
  const std::size_t step = 1 + region.points->size() / most_point_ellipsoids;
  std::vector<Ellipsoid> shapes;
  std::vector<double> lengths;
  for (std::size_t i = 0; i < region.points->size(); i += step) {
    const std::uint32_t id = (*region.points)[i];
    if (!entry.scan->finite[id]) continue;
    shapes.push_back(ellipsoid(entry.scan->point(id), point_covariance(entry, id), shown_probability));
    lengths.push_back(shapes.back().half_lengths[0]);
  }
  if (shapes.empty()) return scene;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  const int times = exaggeration(*middle, point_room * apart * std::sqrt(static_cast<double>(step)));
  scene.meshes.push_back(ellipsoids_mesh(shapes, times, origin, with_alpha(theme.point_selected, 1.0f)));
  scene.notes.push_back("95 % ellipsoids of " + std::to_string(shapes.size()) + " points, " +
                        exaggeration_words(times, "larger"));
  return scene;
}

PatchScene chosen_patch(const Patch& patch, const Vector3d& origin, const Layers& layers, const Theme& theme,
                        const Rgba& colour, float scale) {
  PatchScene scene;
  scene.lines.push_back(outline_item(patch, origin, colour, 3.0f * scale));
  if (layers.axes) add_axes(patch, origin, theme, scale, scene);
  if (!patch.covariance_local) return scene;
  const bool pose_is_known = patch.covariance_local->bottomRightCorner<3, 3>().isZero(0);
  if (layers.ellipsoid && !pose_is_known) add_ellipsoid(patch, origin, theme, scale, scene);
  if (layers.cone && !pose_is_known) scene.notes.push_back(add_cone(patch, origin, theme, scale, scene));
  if (layers.offsets)
    scene.notes.push_back(add_offsets(patch, origin, with_alpha(theme.accent, 0.30f), scene));
  if (layers.band) scene.notes.push_back(add_band(patch, origin, colour, scene));
  return scene;
}

}  // namespace patchlab::viewer
