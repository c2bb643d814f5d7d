// The calibration report in Markdown.
#pragma once

#include <string>

#include "tests/bench/calibration/study.h"

namespace patchlab::calibration {

// Refers to the plots of plots.h by their file names.
std::string report(const Study& study);

}  // namespace patchlab::calibration
