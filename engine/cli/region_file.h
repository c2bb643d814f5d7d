// Region files: point indices (counted from 0), one a line, or JSON {"indices": [...]}.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace patchlab {

// unreadable error with the line or member that is wrong.
Result<std::vector<std::uint32_t>> parse_region(std::string_view text, const std::string& name);

}  // namespace patchlab
