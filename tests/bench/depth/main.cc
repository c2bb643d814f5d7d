// depth_bench [--page FILE]: from a depth image to points and their covariances, beside the same written with
// Eigen, point by point, and copies of the bytes that are written.
#include <cmath>
#include <cstdio>
#include <cstring>

#include "engine/io/depth_points.h"
#include "engine/sensor/point_covariances.h"
#include "tests/bench/round_robin/round_robin.h"

namespace patchlab::bench {
namespace {

constexpr std::size_t width = 640, height = 480, pixels = width * height;
constexpr double focal = 525.0, cx = 319.5, cy = 239.5, scale = 5000.0;

std::vector<std::uint16_t> wavy_depths() {
  std::vector<std::uint16_t> depths(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const auto u = static_cast<double>(i % width), v = static_cast<double>(i / width);
    const bool hole = i % 37 == 0;
    depths[i] = hole ? 0 : static_cast<std::uint16_t>(scale * (1.5 + 0.2 * std::sin(0.02 * u) + 1e-3 * v));
  }
  return depths;
}

struct Measured {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Matrix3d> covariances;
};

// As Section IV.B of the paper writes them.
Measured by_eigen(const std::vector<std::uint16_t>& depths, const StereoNoise& noise) {
  Measured measured;
  const Eigen::Vector3d variances(noise.pointing * noise.pointing, noise.pointing * noise.pointing,
                                  noise.disparity * noise.disparity);
  for (std::size_t i = 0; i < pixels; ++i) {
    if (depths[i] == 0) continue;
    const double z = depths[i] / scale, d = noise.f * noise.baseline / z;
    const double u = static_cast<double>(i % width) - cx, v = static_cast<double>(i / width) - cy;
    Eigen::Matrix3d J;
    J << noise.baseline / d, 0, -noise.baseline * u / (d * d),  //
        0, noise.baseline / d, -noise.baseline * v / (d * d),   //
        0, 0, -noise.f * noise.baseline / (d * d);
    measured.points.emplace_back(u * z / focal, v * z / focal, z);
    measured.covariances.emplace_back(J * variances.asDiagonal() * J.transpose());
  }
  return measured;
}

struct Image {
  std::vector<Eigen::Vector3f> positions = std::vector<Eigen::Vector3f>(pixels);
  std::vector<std::uint8_t> finite = std::vector<std::uint8_t>(pixels);
};

// The finite ones in double, as a fit takes them.
std::vector<Eigen::Vector3d> points_of(const Image& image) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    if (image.finite[i] != 0) points.push_back(image.positions[i].cast<double>());
  }
  return points;
}

double largest_difference(const std::vector<Eigen::Matrix3d>& a, const std::vector<Eigen::Matrix3d>& b) {
  double largest = a.size() == b.size() ? 0.0 : std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
    largest = std::max(largest, (a[i] - b[i]).norm() / b[i].norm());
  return largest;
}

std::string row(const RoundRobin& times, const std::string& words, const std::string& name,
                const std::string& copy) {
  return "| " + words + " | " + time_of(times, name) + " | " + ratio_of(times, name, copy) + " | " +
         ratio_of(times, "Eigen", name) + " |\n";
}

std::string table() {
  const std::vector<std::uint16_t> depths = wavy_depths();
  const NoiseModel kinect = *noise_model("kinect1");
  const Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  const DepthPixels input = {depths, width, {focal, focal, cx, cy, 0, 0, false}, scale};
  Image image;
  unproject(input, image.positions.data(), image.finite.data());
  const std::vector<Eigen::Vector3d> points = points_of(image);
  std::vector<char> from(13 * pixels + 96 * points.size(), 1), to(from.size());
  Measured eigen, ours;
  RoundRobin times(21);
  const auto copy = [&](const std::string& name, std::size_t bytes) {
    times.add(name, [&, bytes] { std::memcpy(to.data(), from.data(), bytes); });
  };
  copy("copy of positions", 13 * pixels);
  copy("copy of covariances", 72 * points.size());
  copy("copy of all", from.size());
  times.add("Eigen", [&] { eigen = by_eigen(depths, std::get<StereoNoise>(kinect.kind)); });
  times.add("positions", [&] { unproject(input, image.positions.data(), image.finite.data()); });
  times.add("covariances", [&] { ours.covariances = covariances(kinect, turn, origin, points); });
  times.add("plain", [&] { ours.covariances = covariances_plain(kinect, turn, origin, points); });
  times.add("all", [&] {
    unproject(input, image.positions.data(), image.finite.data());
    ours.points = points_of(image);
    ours.covariances = covariances(kinect, turn, origin, ours.points);
  });
  times.run();
  return "| 640 x 480 pixels, " + std::to_string(points.size()) +
         " with a depth | time | times a copy of what is written | Eigen, times this |\n|---|---|---|---|\n" +
         row(times, "depths to positions, 13 bytes a pixel", "positions", "copy of positions") +
         row(times, "covariances of points, 72 bytes each", "covariances", "copy of covariances") +
         row(times, "the same without AVX2", "plain", "copy of covariances") +
         row(times, "depths to positions, points in double and covariances", "all", "copy of all") +
         row(times, "depths to points and covariances, J Σ J' by Eigen", "Eigen", "copy of all") +
         bench::text("\nThe covariances differ from Eigen's by %.0e of their size at most.\n",
                     largest_difference(ours.covariances, eigen.covariances));
}

}  // namespace
}  // namespace patchlab::bench

int main(int argc, char** argv) {
  using namespace patchlab::bench;
  const std::string text =
      date_and_machine() +
      ". Medians of processor time, half of the middle half as ±. Points in float, as a scan keeps them; "
      "covariances in double, as fits take them.\n\n" +
      table();
  return report(argc, argv, "depth", text);
}
