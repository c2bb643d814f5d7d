#include "tests/bench/lasso/open3d.h"

namespace patchlab::bench {

std::string open3d_crop(std::size_t, const std::vector<Eigen::Vector2d>&) { return ""; }

}  // namespace patchlab::bench
