// A folder of files, written whole or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/result.h"

namespace patchlab {

// Names are relative to the folder and may lie in folders of their own ("meshes/a.stl"). The files are
// written beside it first, and the folder appears by one rename. unwritable error where it is there already
// and not empty.
Result<void> write_folder(const std::filesystem::path& folder,
                          const std::vector<std::pair<std::string, std::string_view>>& files);

}  // namespace patchlab
