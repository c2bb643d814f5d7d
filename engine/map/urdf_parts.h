// Parts of urdfdom's model as ours.
#pragma once

#include <optional>
#include <vector>

#include "engine/map/robot.h"

namespace urdf {
class Pose;
class Joint;
class Link;
}  // namespace urdf

namespace patchlab {

Pose pose_of(const urdf::Pose& pose);
// Nothing where there are none, or they are not finite or the wrong way round.
std::optional<JointLimits> limits_of(const urdf::Joint& joint);
// Those that have finite positive sizes.
std::vector<LinkShape> shapes_of(const urdf::Link& link);

}  // namespace patchlab
