// Scans of KITTI and nuScenes: float32 records without a header.
#pragma once

#include <string_view>

namespace patchlab {

// Do all the bytes look like points of such a file?
bool is_kitti(std::string_view bytes);

}  // namespace patchlab
