#include "engine/io/scene.h"

#include <Eigen/Geometry>
#include <limits>
#include <memory>
#include <set>

#include "engine/io/patch_json.h"
#include "engine/io/scene_mesh.h"
#include "engine/mesh/ray_mesh.h"

namespace patchlab {
namespace {

using nlohmann::json;

constexpr std::uint64_t largest_side = 1 << 13;  // px

Camera camera_from_json(const JsonPlace& place) {
  Camera camera;
  camera.width = static_cast<std::uint32_t>(place["width"].whole_number(largest_side));
  camera.height = static_cast<std::uint32_t>(place["height"].whole_number(largest_side));
  camera.fx = place["fx"].number();
  camera.fy = place["fy"].number();
  camera.cx = place["cx"].number();
  camera.cy = place["cy"].number();
  camera.pose = viewpoint_from_json(place["pose"]);
  if (const auto step = place.find("depth_step")) camera.depth_step = step->number();
  if (const auto share = place.find("missing")) camera.missing = share->number();
  if (camera.depth_step < 0.0) place.fail("has a depth_step below zero");
  if (camera.missing < 0.0 || camera.missing >= 1.0)
    place.fail("has a share of missing returns outside [0, 1)");
  if (camera.width == 0 || camera.height == 0) place.fail("has no pixels");
  if (camera.fx <= 0.0 || camera.fy <= 0.0) place.fail("has a focal length (fx, fy) that is not positive");
  return camera;
}

SceneObject object_from_json(const JsonPlace& unnamed, const std::filesystem::path& folder) {
  SceneObject object;
  object.name = unnamed["name"].text();
  if (object.name.empty()) unnamed["name"].fail("is empty");
  const JsonPlace place = unnamed.called("object \"" + object.name + "\"");
  const bool is_mesh = place.find("mesh").has_value();
  if (is_mesh == place.find("patch").has_value() && place.ok())
    place.fail("lacks the member \"patch\" or \"mesh\", or has both");
  if (is_mesh) {
    object.mesh = mesh_from_json(place, folder);
  } else {
    object.patch = patch_from_json(place["patch"]);
  }
  return object;
}

void check_scene_heading(const JsonPlace& root) {
  const JsonPlace format = root["format"], version = root["version"];
  if (format.text() != "patchlab.scene") format.fail("is not \"patchlab.scene\"");
  if (const double number = version.number(); root.ok() && !(number >= 1.0 && number < 2.0)) {
    version.fail(version.value().dump() + " is not one that this program reads, which is 1");
  }
}

// A patch with a ball around it, which most rays miss. Away from the centre c both the distance in the plane
// and the height grow, so the corner of the box around the boundary bounds the distance of every point.
struct Target {
  Patch patch;
  Vector3d centre;
  double squared_radius;
  std::shared_ptr<const RayMesh> mesh;  // in place of the patch; it knows its own boxes
};

Target target(const SceneObject& object) {
  if (object.mesh) return {{}, {}, std::numeric_limits<double>::infinity(), object.mesh};
  const Patch& patch = object.patch;
  const Vector2d half = extent(boundary(patch));
  const Vector3d k = k3(patch).cwiseAbs();
  const double highest =
      k.x() * half.x() * half.x() + k.y() * half.y() * half.y();  // at least |z|: k rho^2/(1 + w), w >= 0
  return {patch, centre(patch), half.squaredNorm() + highest * highest, nullptr};
}

bool passes(const Target& target, const Vector3d& origin, const Vector3d& direction) {
  const Vector3d to_centre = target.centre - origin;
  const double length2 = direction.squaredNorm();
  return to_centre.cross(direction).squaredNorm() <= target.squared_radius * length2;
}

std::optional<double> hit(const Target& target, const Vector3d& origin, const Vector3d& direction) {
  if (target.mesh) return target.mesh->hit(origin, direction);
  return passes(target, origin, direction) ? ray_hit(target.patch, origin, direction) : std::nullopt;
}

}  // namespace

Result<SceneDescription> read_scene(std::string_view text, const std::string& name,
                                    const std::filesystem::path& folder) {
  const Result<json> parsed = parse_json(text, name);
  if (!parsed) return parsed.error();
  std::optional<Error> error;
  const JsonPlace root(*parsed, name, error);
  check_scene_heading(root);
  SceneDescription scene;
  scene.camera = camera_from_json(root["camera"]);
  if (const auto noise = root.find("noise")) scene.noise = noise->text();
  std::set<std::string> names;
  for (const JsonPlace& place : root["objects"].items()) {
    scene.objects.push_back(object_from_json(place, folder));
    if (!names.insert(scene.objects.back().name).second) place["name"].fail("is taken by an earlier object");
  }
  if (error) return *error;
  return scene;
}

CastRay cast_ray(const SceneDescription& scene) {
  auto targets = std::make_shared<std::vector<Target>>();
  for (const SceneObject& object : scene.objects) targets->push_back(target(object));
  return [targets](const Vector3d& origin, const Vector3d& direction) -> std::optional<Hit> {
    std::optional<Hit> nearest;
    for (std::uint32_t i = 0; i < targets->size(); ++i) {
      const std::optional<double> s = hit((*targets)[i], origin, direction);
      if (s && (!nearest || *s < nearest->s)) nearest = Hit{*s, i};
    }
    return nearest;
  };
}

PatchSet truth(const SceneDescription& scene) {
  PatchSet set;
  for (const SceneObject& object : scene.objects) {
    if (object.mesh) continue;
    PatchRecord record;
    record.id = record.name = object.name;
    record.frame_id = "world";
    record.patch = object.patch;
    set.patches.push_back(std::move(record));
  }
  return set;
}

Result<SimulatedScene> simulate(const SceneDescription& scene, std::string_view noise, std::uint64_t seed) {
  const Result<NoiseModel> model = noise_model(noise.empty() ? std::string_view(scene.noise) : noise);
  if (!model) return model.error();
  if (model->from_file()) {
    return Error{ErrorCode::usage,
                 "The noise model from_file needs a scan with covariances; a simulation needs another "
                 "one (patchlab help noise lists them)."};
  }
  return SimulatedScene{simulate_scan(scene.camera, cast_ray(scene), *model, seed), truth(scene)};
}

}  // namespace patchlab
