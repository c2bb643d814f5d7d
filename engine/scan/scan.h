// A scan: what a range sensor left, as patchlab uses it. Units: metre.
//
// Points are kept as float about a double origin, so that map coordinates lose nothing: the coordinates of
// point i in the frame of the file are origin + position[i]. Every array is either empty or has one entry a
// point.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace patchlab {

// Pose of the sensor in the frame of the points: z forward, x right, y down (an optical frame).
struct Viewpoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::array<double, 4> quaternion_xyzw = {0, 0, 0, 1};
  bool stated = false;  // false: the file says nothing (or only the identity), so this is an assumption
};

Eigen::Matrix3d rotation(const Viewpoint& viewpoint);  // world_from_sensor

// Six entries of a symmetric 3x3 covariance, m^2: xx xy xz yy yz zz.
using Covariance6 = std::array<double, 6>;

struct FieldInfo {
  std::string name;
  std::string type;  // int8 uint8 int16 uint16 int32 uint32 int64 uint64 float32 float64
  std::uint32_t count = 1;
};

struct Scan {
  std::string file;      // as it was named by the user
  std::string format;    // pcd, ply, csv, ...
  std::string encoding;  // ascii, binary, binary_compressed, ...
  std::vector<FieldInfo> fields;

  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // m
  std::vector<Eigen::Vector3f> positions;            // m, about origin; NaN where the sensor gave nothing
  std::vector<std::uint8_t> finite;  // 1 where all three coordinates are finite; always filled
  std::size_t finite_count = 0;
  std::vector<std::array<std::uint8_t, 3>> colours;  // red, green, blue
  std::vector<Covariance6> covariances;              // m^2, in the frame of the points
  std::vector<std::uint32_t> labels;
  std::vector<float> intensities;           // how much came back, in the sensor's own unit
  std::vector<Eigen::Vector3f> viewpoints;  // one sensor position a point (merged clouds), about origin

  std::uint32_t width = 0;  // pixel grid, row by row; height 1: not organised
  std::uint32_t height = 1;
  Viewpoint viewpoint;
  // Of a depth camera's pixel grid where known: fx, fy, cx, cy in pixels.
  std::optional<std::array<double, 4>> intrinsics;
  std::vector<std::string> notices;  // whole sentences for the user: what was assumed or dropped

  std::size_t size() const { return positions.size(); }
  bool organized() const { return height > 1 && width > 1; }
  // Coordinates in the frame of the file, m.
  Eigen::Vector3d point(std::size_t i) const { return origin + positions[i].cast<double>(); }
};

// The box around the finite points; nothing when there is none.
struct Bounds {
  Eigen::Vector3d min, max;
};
std::optional<Bounds> bounds(const Scan& scan);

}  // namespace patchlab
