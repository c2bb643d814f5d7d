// What lies under the cursor: a point of a scan, or a patch.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>

#include "engine/project/document.h"
#include "engine/region/lasso.h"

namespace patchlab::viewer {

// A point within `window` pixels of the cursor: the one with the least distance to the cursor times depth,
// where all distances below a quarter of the window count the same, so that what is in front wins.
std::optional<std::uint32_t> pick_point(const Scan& scan, const ViewCamera& camera,
                                        const Eigen::Vector2d& pixel, double window);

// The id of the visible patch that the ray through the pixel hits first.
std::optional<std::string> pick_patch(const Document& document, const ViewCamera& camera,
                                      const Eigen::Vector2d& pixel);

}  // namespace patchlab::viewer
