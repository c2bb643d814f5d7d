// Antialiased disks of one size, ready to be laid on a raster.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace patchlab::viewer {

// Four pixels of a row of a disk, the first `dx` to the right of the pixel that its centre lies in and `dy`
// above.
struct StampRun {
  static constexpr int kPixels = 4;
  std::int16_t dx, dy;
  std::array<std::uint32_t, kPixels> coverage;  // 0..255, once for each channel of a colour
};

// The disks of one diameter for each eighth of a pixel that their centre may lie at.
class DiskStamp {
 public:
  static constexpr int kParts = 8;  // of a pixel, each way

  explicit DiskStamp(float diameter);  // px, at least 1

  float diameter() const { return diameter_; }
  // How far its pixels lie from the one of the centre, at most; runs end up to three further to the right.
  int reach() const { return reach_; }
  // `x_part`, `y_part`: 0..kParts - 1, in eighths of a pixel from its lower left corner.
  std::span<const StampRun> runs(int x_part, int y_part) const {
    const auto at = static_cast<std::size_t>(y_part * kParts + x_part);
    return std::span(runs_).subspan(starts_[at], starts_[at + 1] - starts_[at]);
  }

 private:
  float diameter_;
  int reach_ = 0;
  std::vector<StampRun> runs_;
  std::vector<std::size_t> starts_;
};

}  // namespace patchlab::viewer
