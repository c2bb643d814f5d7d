// Maps and robots as things to draw, as in Fig. 4 of the paper: patches of the environment green, those of
// robots brown, the ellipsoids of their centres blue; robots by the shapes of their links.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "engine/project/placed.h"
#include "viewer/app/link_mesh.h"
#include "viewer/app/patch_scene.h"

namespace patchlab::viewer {

struct MapSceneInput {
  const Document& document;
  const ViewState& state;
  const Theme& theme;
  Eigen::Vector3d origin;
  float scale;
};

class MapScene {
 public:
  // Everything of the visible maps and robots.
  PatchScene make(const MapSceneInput& in);

 private:
  struct KnownSurface {
    std::shared_ptr<const PatchMap> map;  // held: its address is a part of the key
    Vector6d pose;
    Rgba colour{};
    Eigen::Vector3d origin;
    MeshItem item;
  };
  const MeshItem& surface_of(const MapSceneInput& in, const PlacedPatch& placed, const Patch& shown,
                             const Rgba& colour);
  void add_robot(const MapSceneInput& in, const RobotEntry& entry, PatchScene& scene);

  std::map<std::string, KnownSurface> surfaces_;                                   // by patch
  std::map<std::shared_ptr<const RobotModel>, std::vector<LinkTriangles>> links_;  // one a shape
};

// The points of a robot's links as it stands, and where its links are if they have no shapes.
std::vector<Eigen::Vector3d> points_of_robot(const Document& document, const RobotEntry& robot);

}  // namespace patchlab::viewer
