// Scenes for the simulated range camera (JSON; schema: assets/schema/scene.schema.json): a camera, a noise
// model, and bounded patches and meshes in a world frame. Synthetic truth for tests, samples and `patchlab
// simulate`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/io/patch_set.h"
#include "engine/patch/patch.h"
#include "engine/sensor/range_camera.h"

namespace patchlab {

class RayMesh;

// A patch or a mesh, opaque from both sides.
struct SceneObject {
  std::string name;                          // unique in its scene
  Patch patch = {};                          // in the world frame; not used where there is a mesh
  std::shared_ptr<const RayMesh> mesh = {};  // in the world frame
};

struct SceneDescription {
  Camera camera;
  std::string noise = "kinect1";  // specification (engine/sensor/noise_model.h)
  std::vector<SceneObject> objects;
};

// unreadable error: names the file, the object and the member that is wrong. Mesh files are looked for from
// `folder`.
Result<SceneDescription> read_scene(std::string_view text, const std::string& name,
                                    const std::filesystem::path& folder = {});

// The nearest object along a ray; it keeps its own copy of the patches and shares the meshes.
CastRay cast_ray(const SceneDescription& scene);

// The patches among the objects as designed ones without covariance: `frame_id` world, id and name those of
// the object.
PatchSet truth(const SceneDescription& scene);

struct SimulatedScene {
  Scan scan;  // labels: index of the object + 1
  PatchSet truth;
};
// `noise` is a specification that replaces the scene's own; empty: the scene's own. usage error for one that
// is wrong or needs a file. The same scene, noise and seed give the same bytes.
Result<SimulatedScene> simulate(const SceneDescription& scene, std::string_view noise, std::uint64_t seed);

}  // namespace patchlab
