#include "engine/scan/pcl.h"

int main() {
  const pcl::PointCloud<pcl::PointXYZ> cloud(4, 1);
  return patchlab::from_pcl(cloud).finite_count == 4 ? 0 : 1;
}
