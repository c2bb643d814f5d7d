// One patch of each of the ten types with a covariance as a fit gives it, in one frame, and one without.
#pragma once

#include "tests/engine/io/sample_set.h"

namespace patchlab::test {

inline PatchSet ten_types() {
  PatchSet set = sample_set();
  std::vector<const PatchTypeRow*> seen;
  std::erase_if(set.patches, [&](const PatchRecord& record) {
    const bool again = std::ranges::count(seen, record.patch.type) > 0;
    seen.push_back(record.patch.type);
    return again;
  });
  return set;
}

}  // namespace patchlab::test
