// A simulated scan for the viewer's tests: a ball of 60 mm radius before a wall, as a small depth camera sees
// it.
#pragma once

#include <stdlib.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "engine/base/file.h"
#include "engine/io/read_scan.h"
#include "engine/sensor/range_camera.h"

namespace patchlab::viewer {

inline constexpr double ball_radius = 0.06;  // m
inline const Eigen::Vector3d ball_centre(0.0, 0.0, 0.8);

// 320 / coarser x 240 / coarser pixels.
inline Scan ball_scan(std::uint32_t coarser = 1) {
  const auto cast = [](const Eigen::Vector3d& origin,
                       const Eigen::Vector3d& direction) -> std::optional<Hit> {
    const Eigen::Vector3d to_ball = ball_centre - origin;
    const double a = direction.squaredNorm(), b = direction.dot(to_ball);
    const double rest = b * b - a * (to_ball.squaredNorm() - ball_radius * ball_radius);
    if (rest > 0) return Hit{(b - std::sqrt(rest)) / a, 0};
    return Hit{(1.0 - origin.z()) / direction.z(), 1};
  };
  const double focal = 262.5 / coarser;
  Camera camera{320 / coarser, 240 / coarser, focal, focal, 160.0 / coarser - 0.5, 120.0 / coarser - 0.5, {}};
  camera.pose.stated = true;
  return simulate_scan(camera, cast, *noise_model("kinect1"), 7);
}

// A folder of its own for each test, taken away at the end.
class TestFolder {
 public:
  TestFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "patchlab_viewer_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no folder " + pattern);
    path_ = pattern;
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;
  ~TestFolder() { std::filesystem::remove_all(path_); }
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path ball(std::uint32_t coarser = 1) const {
    const std::filesystem::path file = path_ / "ball.pcd";
    if (!std::filesystem::exists(file)) (void)write_file(file, write_pcd(ball_scan(coarser))).ok();
    return file;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace patchlab::viewer
