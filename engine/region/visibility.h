// Which points of a scan a camera sees: those that no surface of other points hides.
//
// Points have no size, so a surface of them is closed by a grid of depths whose cells are as large as its
// gaps: the finest power of two of pixels at which hardly a cell amid points is empty. A point is hidden
// where a nearer point lies in its cell or beside it, nearer by more than a slanted surface and the noise
// explain. Depends on the scan, the camera and the thickness alone.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "engine/region/lasso.h"
#include "engine/scan/scan.h"

namespace patchlab {

// 1 for each point that is seen, 0 for what is hidden, not finite, before the near plane or outside the
// viewport. `thickness` (m): how far behind another a point may lie and still be of the same surface, as the
// noise spreads it.
std::vector<std::uint8_t> visible_points(const Scan& scan, const ViewCamera& camera, double thickness);

// The answer to the last question, for lassos that change while the camera stands still. Holds its scan, so
// that no other can be taken for it; may be asked from many threads.
class VisibilityCache {
 public:
  std::shared_ptr<const std::vector<std::uint8_t>> get(const std::shared_ptr<const Scan>& scan,
                                                       const ViewCamera& camera, double thickness);

 private:
  std::mutex mutex_;
  std::shared_ptr<const Scan> scan_;
  ViewCamera camera_;
  double thickness_ = 0.0;
  std::shared_ptr<const std::vector<std::uint8_t>> seen_;
};

}  // namespace patchlab
