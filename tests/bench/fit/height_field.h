// What many would do instead: z = a + b'u + u'H u / 2 by linear least squares, without weights or covariance.
// A lower bound on the work of any fit.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace patchlab::bench {

using HeightField = Eigen::Matrix<double, 6, 1>;
HeightField height_field_fit(const std::vector<Eigen::Vector3d>& points);

}  // namespace patchlab::bench
