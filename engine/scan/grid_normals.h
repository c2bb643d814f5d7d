// Normals of an organised scan of a depth camera, from its pixel grid.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "engine/scan/scan.h"

namespace patchlab {

// fx, fy, cx, cy in pixels of the pinhole camera whose pixel grid the scan is: its own intrinsics where it
// has them, else those that its points tell. Nothing where the scan is not organised, has sensor positions of
// its own for each point, or its points do not lie on the pixels of such a camera at its viewpoint.
std::optional<std::array<double, 4>> pinhole_of(const Scan& scan);

// One unit normal a point, turned towards the sensor: of the plane through the 11 x 11 pixels around it, by
// least squares of their inverse depth, which is where the noise of such cameras is even. Pixels of another
// surface do not count: those whose inverse depth differs from the point's own by more than 1/16 of it and by
// more than six standard deviations of the noise, as the scan shows it. NaN where the point is missing, lies
// behind the camera or within 1/64 of the median depth, or where all those pixels lie on one line. Nothing
// where pinhole_of is nothing.
std::vector<Eigen::Vector3f> grid_normals(const Scan& scan);

}  // namespace patchlab
