#include "tests/bench/readers/pcl_readers.h"

#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

namespace patchlab::bench {

bool has_pcl_readers() { return true; }

std::size_t read_by_pcl(const std::string& file) {
  pcl::PointCloud<pcl::PointXYZRGB> cloud;
  if (file.ends_with(".ply")) {
    pcl::io::loadPLYFile(file, cloud);
  } else {
    pcl::io::loadPCDFile(file, cloud);
  }
  return cloud.size();
}

}  // namespace patchlab::bench
