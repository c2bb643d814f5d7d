#include "viewer/app/map_scene.h"

#include <algorithm>
#include <iterator>

#include "engine/mesh/patch_mesh.h"
#include "engine/patch/marginals.h"
#include "viewer/app/shapes.h"
#include "viewer/panel/colours.h"

namespace patchlab::viewer {

namespace {

using Eigen::Vector3d;

constexpr double ellipsoid_share = 0.30;  // of the size of a patch in the middle
constexpr double frame_length = 0.08;     // m, of the axes of a link without shape
constexpr float patch_alpha = 0.92f;

struct ShownPatch {
  PlacedPatch placed;
  Patch patch;  // in the frame of the picture
};

std::vector<ShownPatch> shown_patches(const Document& document) {
  std::vector<ShownPatch> shown;
  for (PlacedPatch& placed : placed_patches(document)) {
    if (placed.of == PatchOf::scan || !is_visible(document, placed)) continue;
    const Result<Patch> patch = as_shown(document, placed);
    if (patch) shown.push_back({std::move(placed), *patch});
  }
  return shown;
}

double middle_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool has_ellipsoid(const Patch& patch) {
  return patch.covariance_local && !patch.covariance_local->bottomRightCorner<3, 3>().isZero(0.0);
}

// All alike exaggerated, so that they can be compared.
void add_ellipsoids(const MapSceneInput& in, const std::vector<ShownPatch>& shown, PatchScene& scene) {
  std::vector<Ellipsoid> shapes;
  std::vector<double> lengths, sizes;
  for (const auto& [placed, patch] : shown) {
    if (placed.id == in.state.selected || !has_ellipsoid(patch)) continue;
    shapes.push_back(centre_ellipsoid(patch, shown_probability));
    lengths.push_back(shapes.back().half_lengths.maxCoeff());
    sizes.push_back(extent(boundary(patch)).maxCoeff());
  }
  if (shapes.empty()) return;
  const int times = exaggeration(middle_of(lengths), ellipsoid_share * middle_of(sizes));
  for (const Ellipsoid& shape : shapes)
    scene.meshes.push_back(ellipsoid_mesh(shape, times, in.origin, in.theme.gaussian));
  scene.notes.push_back("95 % ellipsoids of the centres, " + exaggeration_words(times, "larger"));
}

struct PosedLinks {
  PosedRobot robot;
  UncertainPose world_from_base;
};
std::optional<PosedLinks> posed_links(const Document& document, const RobotEntry& entry) {
  const Result<PosedRobot> robot = posed(entry);
  if (!robot) return std::nullopt;
  return PosedLinks{*robot, standing(document, entry.frame)};
}

Pose world_from_link(const PosedLinks& links, const std::string& link) {
  const Result<UncertainPose> base_from_link = links.robot.pose(links.robot.robot().base, link);
  return base_from_link ? compose(links.world_from_base.pose, base_from_link->pose) : Pose{};
}

void add_link_frames(const MapSceneInput& in, const PosedLinks& links, PatchScene& scene) {
  const Rgba colours[] = {in.theme.axis_x, in.theme.axis_y, in.theme.axis_z};
  for (const std::string& link : links.robot.robot().links) {
    const Pose pose = world_from_link(links, link);
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d tip = apply(pose, frame_length * Vector3d::Unit(axis));
      scene.lines.push_back(
          {about({pose.t, tip}, in.origin), colours[axis], 2.0f * in.scale, false, true, 0.6f});
    }
  }
}

}  // namespace

const MeshItem& MapScene::surface_of(const MapSceneInput& in, const PlacedPatch& placed, const Patch& shown,
                                     const Rgba& colour) {
  KnownSurface& known = surfaces_[placed.id];
  const MapEntry* map = find_map(in.document, placed.owner);
  const Vector6d pose = world_from_patch(shown).vector();
  const bool is_same = map && known.map == map->map && known.pose == pose && known.colour == colour &&
                       known.origin == in.origin;
  if (!is_same) {
    known = {map ? map->map : nullptr, pose, colour, in.origin, surface_item(shown, in.origin, colour).item};
  }
  return known.item;
}

PatchScene MapScene::make(const MapSceneInput& in) {
  PatchScene scene;
  const std::vector<ShownPatch> shown = shown_patches(in.document);
  for (const auto& [placed, patch] : shown) {
    const Rgba colour = placed.of == PatchOf::robot ? in.theme.robot_patch : in.theme.map_patch;
    if (in.state.layers.surface)
      scene.meshes.push_back(surface_of(in, placed, patch, with_alpha(colour, patch_alpha)));
    if (in.state.layers.grid)
      std::ranges::move(grid_items(patch, in.origin, with_alpha(in.theme.text, 0.55f), in.scale),
                        std::back_inserter(scene.lines));
    if (in.state.layers.names) scene.tips.push_back({centre(patch), placed.name, in.theme.text});
    if (placed.id != in.state.selected) {
      const Rgba edge = mix(colour, in.theme.text, 0.35f);
      scene.lines.push_back(outline_item(patch, in.origin, edge, 1.5f * in.scale));
      continue;
    }
    PatchScene chosen = chosen_patch(patch, in.origin, in.state.layers, in.theme, in.theme.accent, in.scale);
    std::ranges::move(chosen.meshes, std::back_inserter(scene.meshes));
    std::ranges::move(chosen.lines, std::back_inserter(scene.lines));
    std::ranges::move(chosen.tips, std::back_inserter(scene.tips));
    std::ranges::move(chosen.notes, std::back_inserter(scene.notes));
  }
  if (in.state.layers.ellipsoid) add_ellipsoids(in, shown, scene);
  for (const RobotEntry& entry : in.document.robots) {
    if (entry.visible) add_robot(in, entry, scene);
  }
  return scene;
}

void MapScene::add_robot(const MapSceneInput& in, const RobotEntry& entry, PatchScene& scene) {
  const std::optional<PosedLinks> links = posed_links(in.document, entry);
  if (!links) return;
  const std::vector<LinkShape>& shapes = entry.model->robot.shapes;
  if (shapes.empty()) return add_link_frames(in, *links, scene);
  std::vector<LinkTriangles>& triangles = links_[entry.model];
  for (std::size_t i = triangles.size(); i < shapes.size(); ++i)
    triangles.push_back(link_triangles(shapes[i], entry.model->meshes[i].get()));
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (triangles[i].points.empty()) continue;
    scene.meshes.push_back(
        link_item(triangles[i], world_from_link(*links, shapes[i].link), in.origin, in.theme.robot_link));
  }
}

std::vector<Vector3d> points_of_robot(const Document& document, const RobotEntry& entry) {
  std::vector<Vector3d> points;
  const std::optional<PosedLinks> links = posed_links(document, entry);
  if (!links) return points;
  for (const std::string& link : entry.model->robot.links) points.push_back(world_from_link(*links, link).t);
  for (std::size_t i = 0; i < entry.model->robot.shapes.size(); ++i) {
    const LinkShape& shape = entry.model->robot.shapes[i];
    const Pose pose = world_from_link(*links, shape.link);
    for (const Vector3d& point : link_triangles(shape, entry.model->meshes[i].get()).points)
      points.push_back(apply(pose, point));
  }
  return points;
}

}  // namespace patchlab::viewer
