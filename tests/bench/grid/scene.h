// What the pixel-grid benchmarks look at: boulders on the ground, as a Kinect would see them that looks down.
#pragma once

#include "engine/sensor/range_camera.h"

namespace patchlab::bench {

struct SeenScene {
  Scan scan;                             // 640 x 480, 3 % of the pixels missing, in spots
  std::vector<Eigen::Vector3f> normals;  // the true ones, towards the sensor
  std::vector<std::uint8_t> near_edge;   // 1 within 11 pixels of another object
};
SeenScene ground_and_boulders(const NoiseModel& noise);

}  // namespace patchlab::bench
