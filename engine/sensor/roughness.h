// How rough a scan is locally: what its noise looks like where nobody says.
#pragma once

#include <optional>

#include "engine/scan/scan.h"

namespace patchlab {

// The standard deviation of the points about small planes through their neighbours, m: the median over at
// most `samples` neighbourhoods, each just large enough to be flat. An upper estimate of the noise along the
// normal on curved or textured surfaces. Nothing when no neighbourhood is flat (too few points, or a thin or
// scattered cloud). Of scans of more than a million points half a million are looked at.
std::optional<double> local_roughness(const Scan& scan, std::size_t samples = 2000);

}  // namespace patchlab
