// Progress of long work, and its cancellation.
#pragma once

#include <functional>

namespace patchlab {

// Called now and then with the fraction done in [0, 1]; returning false asks the work to stop, which then
// gives ErrorCode::cancelled. May be empty. Called on the thread that does the work.
using Progress = std::function<bool(double fraction)>;

inline bool keep_going(const Progress& progress, double fraction) { return !progress || progress(fraction); }

}  // namespace patchlab
