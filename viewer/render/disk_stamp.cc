#include "viewer/render/disk_stamp.h"

#include <algorithm>
#include <cmath>

namespace patchlab::viewer {

DiskStamp::DiskStamp(float diameter) : diameter_(diameter) {
  const float radius = 0.5f * diameter;
  reach_ = static_cast<int>(std::ceil(radius + 0.5f));
  for (int part = 0; part < kParts * kParts; ++part) {
    starts_.push_back(pixels_.size());
    const auto offset = [](int eighths) { return (static_cast<float>(eighths) + 0.5f) / kParts - 0.5f; };
    const float x = offset(part % kParts), y = offset(part / kParts);
    for (int dy = -reach_; dy <= reach_; ++dy)
      for (int dx = -reach_; dx <= reach_; ++dx) {
        const float from_edge = radius - std::hypot(static_cast<float>(dx) - x, static_cast<float>(dy) - y);
        const auto coverage = static_cast<int>(255.0f * std::clamp(from_edge + 0.5f, 0.0f, 1.0f) + 0.5f);
        if (coverage > 0)
          pixels_.push_back({static_cast<std::int16_t>(dx), static_cast<std::int16_t>(dy),
                             static_cast<std::uint8_t>(coverage)});
      }
  }
  starts_.push_back(pixels_.size());
}

}  // namespace patchlab::viewer
