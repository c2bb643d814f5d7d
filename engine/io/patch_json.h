// A patch as a member of a JSON object: "surface", "boundary", "parameters", "covariance" and what follows
// from them. Patch sets, scenes and the patches of robots share it.
#pragma once

#include <nlohmann/json.hpp>

#include "engine/io/json.h"
#include "engine/patch/patch.h"
#include "engine/scan/scan.h"

namespace patchlab {

// Variance that stands for "spin about z_l unknown" where a covariance is demanded: an angle uniform in (-pi,
// pi).
inline constexpr double spin_variance = 3.2898681336964528729;  // pi^2/3, rad^2

// The patch at `place`. "covariance" and "covariance_local" may be missing or null; the local one follows
// from the other. "pose" and the flags are derived and not read. Anything wrong is told through `place`.
Patch patch_from_json(const JsonPlace& place);

// The members surface ... pose, in the order of the contract, appended to `object`.
void append_patch(nlohmann::ordered_json& object, const Patch& patch);

nlohmann::ordered_json viewpoint_to_json(const Viewpoint& viewpoint);
// "position" and "quaternion_xyzw" (of norm 1 to 1e-3); "stated", true where it is missing.
Viewpoint viewpoint_from_json(const JsonPlace& place);

// Covariance of (position, rotation about fixed parent axes), the order of ROS PoseWithCovariance, from the
// local covariance: an exact linear map that is never singular. The spin of a 5-DoF patch gets
// `spin_variance` about z_l. Precondition: patch.covariance_local is present.
Matrix6d ros_fixed_axes_covariance(const Patch& patch);

}  // namespace patchlab
