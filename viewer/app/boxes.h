// Where things are, for the camera: boxes around what is shown, and what the sensor had before it.
#pragma once

#include <optional>
#include <string>

#include "engine/project/document.h"
#include "viewer/camera/orbit_camera.h"

namespace patchlab::viewer {

// Around everything that is visible; around one entry, or one patch of a map or robot. Nothing where there is
// nothing finite.
std::optional<Bounds> box_of(const Document& document);
std::optional<Bounds> box_of(const Document& document, const std::string& id);

// Median depth of the points before the sensor, m; nothing where fewer than 95 % of them are before it: the
// scan is not what one sensor saw from its viewpoint.
std::optional<double> depth_seen_by_sensor(const Scan& scan);

// Median distance between neighbours of the pixel grid, or what it would be if the points covered their box
// evenly, m.
double point_spacing(const Scan& scan);

// Turns the camera about its pivot until the eye is in direction `outwards`.
void turn_towards(OrbitCamera& camera, const Eigen::Vector3d& outwards);

}  // namespace patchlab::viewer
