#include "viewer/render/disk_stamp.h"

#include <algorithm>
#include <cmath>

namespace patchlab::viewer {

namespace {

// Of a pixel, by the way from its middle to that of the disk; 0..255.
std::uint32_t coverage(float radius, float dx, float dy) {
  return static_cast<std::uint32_t>(255.0f * std::clamp(radius - std::hypot(dx, dy) + 0.5f, 0.0f, 1.0f) +
                                    0.5f);
}

// From the first pixel of a row that is covered to the last.
void add_row(std::vector<StampRun>& runs, int dy, int reach, const std::vector<std::uint32_t>& covered) {
  const auto is_covered = [](std::uint32_t c) { return c > 0; };
  const auto last = std::find_if(covered.rbegin(), covered.rend(), is_covered).base();
  for (auto at = std::find_if(covered.begin(), last, is_covered); at < last;) {
    StampRun run{static_cast<std::int16_t>(at - covered.begin() - reach), static_cast<std::int16_t>(dy), {}};
    for (std::uint32_t& c : run.coverage)
      if (at < last) c = 0x01010101u * *at++;
    runs.push_back(run);
  }
}

}  // namespace

DiskStamp::DiskStamp(float diameter) : diameter_(diameter) {
  const float radius = 0.5f * diameter;
  reach_ = static_cast<int>(std::ceil(radius + 0.5f));
  for (int part = 0; part < kParts * kParts; ++part) {
    starts_.push_back(runs_.size());
    const auto offset = [](int eighths) { return (static_cast<float>(eighths) + 0.5f) / kParts - 0.5f; };
    const float x = offset(part % kParts), y = offset(part / kParts);
    for (int dy = -reach_; dy <= reach_; ++dy) {
      std::vector<std::uint32_t> row;
      for (int dx = -reach_; dx <= reach_; ++dx)
        row.push_back(coverage(radius, static_cast<float>(dx) - x, static_cast<float>(dy) - y));
      add_row(runs_, dy, reach_, row);
    }
  }
  starts_.push_back(runs_.size());
}

}  // namespace patchlab::viewer
