#include "engine/project/measured_points.h"

#include "engine/region/observe.h"

namespace patchlab {

std::map<std::string, Observations> measured_points(const Document& document) {
  std::map<std::string, Observations> out;
  for (const PatchEntry& patch : document.patches) {
    const ScanEntry* scan = find_scan(document, patch.scan);
    if (!scan || !scan->scan || !patch.points) continue;
    if (Result<Observations> seen = observe(*scan->scan, scan->noise, *patch.points))
      out[patch.id] = *std::move(seen);
  }
  return out;
}

}  // namespace patchlab
