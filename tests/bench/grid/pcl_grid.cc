#include "tests/bench/grid/pcl_grid.h"

#include <pcl/features/integral_image_normal.h>
#include <pcl/features/normal_3d.h>
#include <pcl/point_types.h>

namespace patchlab::bench {

using Integral = pcl::IntegralImageNormalEstimation<pcl::PointXYZ, pcl::Normal>;

struct PclGrid::Data {
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud{new pcl::PointCloud<pcl::PointXYZ>};
  pcl::PointCloud<pcl::Normal> normals;

  void integral(Integral::NormalEstimationMethod method) {
    Integral estimation;
    estimation.setNormalEstimationMethod(method);
    estimation.setNormalSmoothingSize(11.0F);
    estimation.setInputCloud(cloud);
    estimation.compute(normals);
  }
};

PclGrid::PclGrid(const Scan& scan) : data_(new Data) {
  for (const Eigen::Vector3f& p : scan.positions) data_->cloud->push_back({p.x(), p.y(), p.z()});
  data_->cloud->width = scan.width;
  data_->cloud->height = scan.height;
  data_->cloud->is_dense = false;
}
PclGrid::~PclGrid() = default;

void PclGrid::integral_covariance() { data_->integral(Integral::COVARIANCE_MATRIX); }
void PclGrid::integral_gradient() { data_->integral(Integral::AVERAGE_3D_GRADIENT); }
void PclGrid::nearest_twenty() {
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud(data_->cloud);
  estimation.setKSearch(20);
  estimation.compute(data_->normals);
}

std::vector<Eigen::Vector3f> PclGrid::normals() const {
  std::vector<Eigen::Vector3f> normals;
  for (const pcl::Normal& normal : data_->normals) normals.push_back(normal.getNormalVector3fMap());
  return normals;
}

}  // namespace patchlab::bench
