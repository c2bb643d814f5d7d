#include "engine/scan/normals.h"

#include <pcl/features/normal_3d.h>
#include <pcl/point_types.h>

#include <limits>

namespace patchlab {
namespace {

pcl::PointCloud<pcl::PointXYZ>::Ptr finite_cloud(const Scan& scan) {
  const auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  cloud->reserve(scan.finite_count);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3f& position = scan.positions[i];
    if (scan.finite[i]) cloud->push_back({position.x(), position.y(), position.z()});
  }
  return cloud;
}

}  // namespace

std::vector<Eigen::Vector3f> estimate_normals(const Scan& scan, int k) {
  const Eigen::Vector3f unknown = Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  std::vector<Eigen::Vector3f> normals(scan.size(), unknown);
  if (scan.finite_count < 3) return normals;

  pcl::PointCloud<pcl::Normal> estimated;
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud(finite_cloud(scan));
  estimation.setKSearch(k);
  estimation.compute(estimated);

  const Eigen::Vector3f sensor = (scan.viewpoint.position - scan.origin).cast<float>();
  std::size_t row = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!scan.finite[i]) continue;
    const Eigen::Vector3f normal = estimated[row++].getNormalVector3fMap();
    const Eigen::Vector3f towards =
        (scan.viewpoints.empty() ? sensor : scan.viewpoints[i]) - scan.positions[i];
    normals[i] = normal.dot(towards) < 0.0F ? -normal : normal;
  }
  return normals;
}

}  // namespace patchlab
