// Files of `patchlab map chain`: a chain of uncertain poses in, the composed pose out (contracts chain.json,
// chain.out.json).
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/pose/chain.h"

namespace patchlab {

// unreadable error with the element and member that is wrong; a covariance must be symmetric positive
// semi-definite.
Result<Chain> parse_chain(std::string_view text, const std::string& name);
// A pose as a chain: such a file, or what `map chain` prints (r, t, covariance; axis_pose follows and is not
// read).
Result<Chain> parse_pose(std::string_view text, const std::string& name);
nlohmann::ordered_json to_json(const UncertainPose& pose);  // with its 5-DoF axis pose

}  // namespace patchlab
