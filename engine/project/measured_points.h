// What a patch set leaves out of a document: the points that its patches were fitted to.
#pragma once

#include <map>
#include <string>

#include "engine/fit/observation.h"
#include "engine/project/document.h"

namespace patchlab {

// By the id of the patch: the points behind its fit with their covariances, in the frame of the patch.
// Patches whose scan is not open are left out.
std::map<std::string, Observations> measured_points(const Document& document);

}  // namespace patchlab
