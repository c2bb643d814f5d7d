// A patch as a member of a JSON object: "surface", "boundary", "parameters", "covariance" and what follows
// from them. Patch sets, scenes and the patches of robots share it.
#pragma once

#include <array>
#include <nlohmann/json.hpp>

#include "engine/io/json.h"
#include "engine/patch/patch.h"
#include "engine/scan/scan.h"

namespace patchlab {

// The patch at `place`. "covariance" and "covariance_local" may be missing or null; the local one follows
// from the other. "pose" and the flags are derived and not read. Anything wrong is told through `place`.
Patch patch_from_json(const JsonPlace& place);

// The members surface ... pose, in the order of the contract, appended to `object`.
void append_patch(nlohmann::ordered_json& object, const Patch& patch);

// The unit quaternion of the orientation vector, in the order x y z w.
std::array<double, 4> quaternion_xyzw(const Vector3d& r);

nlohmann::ordered_json viewpoint_to_json(const Viewpoint& viewpoint);
// "position" and "quaternion_xyzw" (of norm 1 to 1e-3); "stated", true where it is missing.
Viewpoint viewpoint_from_json(const JsonPlace& place);

}  // namespace patchlab
