// Progress of one part of longer work.
#pragma once

#include "engine/base/progress.h"

namespace patchlab {

// What a part reports from 0 to 1 is reported as from `begin` to `end` of the whole. Empty where the whole
// has none.
inline Progress share_of(const Progress& whole, double begin, double end) {
  if (!whole) return {};
  return [whole, begin, end](double fraction) { return whole(begin + (end - begin) * fraction); };
}

}  // namespace patchlab
