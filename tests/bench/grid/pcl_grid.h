// The same by PCL.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "engine/scan/scan.h"

namespace patchlab::bench {

// Its own copy of a scan, and its results.
class PclGrid {
 public:
  explicit PclGrid(const Scan& scan);
  ~PclGrid();
  void integral_covariance();  // IntegralImageNormalEstimation, COVARIANCE_MATRIX, smoothing over 11 pixels
  void integral_gradient();    // the same, AVERAGE_3D_GRADIENT
  void nearest_twenty();       // NormalEstimation over the 20 nearest
  std::vector<Eigen::Vector3f> normals() const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace patchlab::bench
