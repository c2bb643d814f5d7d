// Scans to and from clouds of PCL, for who has PCL code: the optional component `pcl` of the installed
// package (target patchlab::pcl). Nothing else of the engine's public headers includes PCL.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/register_point_struct.h>

#include <cmath>

#include "engine/scan/scan.h"

namespace patchlab {

// A point with its covariance, m^2, under the field names that patchlab reads in a PCD.
struct EIGEN_ALIGN16 PclPointCovariance {
  PCL_ADD_POINT4D;
  float cov_xx, cov_xy, cov_xz, cov_yy, cov_yz, cov_zz;
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

// Points in the frame of the file, the viewpoint as sensor_origin_ and sensor_orientation_, the pixel grid as
// width and height. Covariances are nan where the scan has none. Coordinates are of single precision, so a
// scan far from its origin loses digits: keep scan.origin and subtract it where that matters.
inline pcl::PointCloud<PclPointCovariance> to_pcl(const Scan& scan) {
  pcl::PointCloud<PclPointCovariance> cloud;
  cloud.reserve(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    PclPointCovariance& point = cloud.emplace_back();
    point.getVector3fMap() = scan.point(i).cast<float>();
    Covariance6 cov;
    cov.fill(std::nan(""));
    if (!scan.covariances.empty()) cov = scan.covariances[i];
    float* const entries[] = {&point.cov_xx, &point.cov_xy, &point.cov_xz,
                              &point.cov_yy, &point.cov_yz, &point.cov_zz};
    for (std::size_t k = 0; k < 6; ++k) *entries[k] = static_cast<float>(cov[k]);
  }
  if (scan.organized()) cloud.width = scan.width, cloud.height = scan.height;
  cloud.is_dense = scan.finite_count == scan.size();
  const auto& [x, y, z, w] = scan.viewpoint.quaternion_xyzw;
  cloud.sensor_origin_.head<3>() = scan.viewpoint.position.cast<float>();
  cloud.sensor_orientation_ = Eigen::Quaterniond(w, x, y, z).cast<float>();
  return cloud;
}

// Of any cloud with x, y, z; points count as in the frame that its sensor pose is given in. Covariances are
// taken from PclPointCovariance, where all of them are finite.
template <class Point>
Scan from_pcl(const pcl::PointCloud<Point>& cloud) {
  Scan scan;
  scan.format = "pcl";
  scan.width = cloud.width;
  scan.height = cloud.height;
  for (const Point& point : cloud) {
    const Eigen::Vector3f position(point.x, point.y, point.z);
    scan.positions.push_back(position);
    scan.finite.push_back(position.allFinite() ? 1 : 0);
    scan.finite_count += scan.finite.back();
    if constexpr (requires { point.cov_xx; }) {
      scan.covariances.push_back(
          {point.cov_xx, point.cov_xy, point.cov_xz, point.cov_yy, point.cov_yz, point.cov_zz});
    }
  }
  for (const Covariance6& cov : scan.covariances) {
    if (Eigen::Matrix<double, 6, 1>::Map(cov.data()).allFinite()) continue;
    scan.covariances.clear();
    break;
  }
  const Eigen::Quaternionf& q = cloud.sensor_orientation_;
  scan.viewpoint.position = cloud.sensor_origin_.template head<3>().template cast<double>();
  scan.viewpoint.quaternion_xyzw = {q.x(), q.y(), q.z(), q.w()};
  scan.viewpoint.stated = !scan.viewpoint.position.isZero() || q.w() != 1.0f;
  return scan;
}

}  // namespace patchlab

POINT_CLOUD_REGISTER_POINT_STRUCT(
    patchlab::PclPointCovariance,
    (float, x, x)(float, y, y)(float, z, z)(float, cov_xx, cov_xx)(float, cov_xy, cov_xy)(
        float, cov_xz, cov_xz)(float, cov_yy, cov_yy)(float, cov_yz, cov_yz)(float, cov_zz, cov_zz))
