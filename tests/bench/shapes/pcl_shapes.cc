#include "tests/bench/shapes/pcl_shapes.h"

#include <pcl/point_types.h>
#include <pcl/sample_consensus/ransac.h>
#include <pcl/sample_consensus/sac_model_cylinder.h>
#include <pcl/sample_consensus/sac_model_plane.h>
#include <pcl/sample_consensus/sac_model_sphere.h>

namespace patchlab::bench {
namespace {

constexpr double threshold = 0.015;  // m: three standard deviations of a depth and more

Eigen::VectorXf consensus(const pcl::SampleConsensusModel<pcl::PointXYZ>::Ptr& model) {
  pcl::RandomSampleConsensus<pcl::PointXYZ> ransac(model, threshold);
  ransac.computeModel();
  pcl::Indices inliers;
  ransac.getInliers(inliers);
  Eigen::VectorXf found, best;
  ransac.getModelCoefficients(found);
  model->optimizeModelCoefficients(inliers, found, best);
  return best;
}

}  // namespace

struct PclPoints::Clouds {
  pcl::PointCloud<pcl::PointXYZ>::Ptr points{new pcl::PointCloud<pcl::PointXYZ>};
  pcl::PointCloud<pcl::Normal>::Ptr normals{new pcl::PointCloud<pcl::Normal>};
};

PclPoints::PclPoints(const std::vector<Eigen::Vector3d>& points, const std::vector<Eigen::Vector3d>& normals)
    : clouds_(new Clouds) {
  for (const Eigen::Vector3d& q : points) {
    const Eigen::Vector3f p = q.cast<float>();
    clouds_->points->push_back({p.x(), p.y(), p.z()});
  }
  for (const Eigen::Vector3d& normal : normals) {
    const Eigen::Vector3f n = normal.cast<float>();
    clouds_->normals->push_back({n.x(), n.y(), n.z()});
  }
}
PclPoints::~PclPoints() = default;
PclPoints::PclPoints(PclPoints&&) noexcept = default;

double PclPoints::fit(Shape shape) const {
  if (shape == Shape::plane) {
    const Eigen::VectorXf plane =
        consensus(std::make_shared<pcl::SampleConsensusModelPlane<pcl::PointXYZ>>(clouds_->points));
    return plane.size() == 4 ? 0.0 : -1.0;
  }
  if (shape == Shape::sphere) {
    const auto model = std::make_shared<pcl::SampleConsensusModelSphere<pcl::PointXYZ>>(clouds_->points);
    model->setRadiusLimits(0.0, 10.0);
    const Eigen::VectorXf sphere = consensus(model);
    return sphere.size() == 4 ? static_cast<double>(sphere[3]) : -1.0;
  }
  const auto model =
      std::make_shared<pcl::SampleConsensusModelCylinder<pcl::PointXYZ, pcl::Normal>>(clouds_->points);
  model->setInputNormals(clouds_->normals);
  model->setRadiusLimits(0.0, 10.0);
  const Eigen::VectorXf cylinder = consensus(model);
  return cylinder.size() == 7 ? static_cast<double>(cylinder[6]) : -1.0;
}

}  // namespace patchlab::bench
