#include <charconv>
#include <cstring>

#include "engine/io/read_scan.h"

namespace patchlab {
namespace {

constexpr const char* covariance_fields[] = {"cov_xx", "cov_xy", "cov_xz", "cov_yy", "cov_yz", "cov_zz"};

// The lines of the header that describe the fields, in their order.
struct FieldLines {
  std::string names = "FIELDS", sizes = "SIZE", types = "TYPE", counts = "COUNT";
  std::size_t bytes = 0;

  void add(const std::string& name, std::size_t size, char type) {
    names += ' ' + name;
    sizes += ' ' + std::to_string(size);
    types += std::string(" ") + type;
    counts += " 1";
    bytes += size;
  }
  std::string text() const { return names + '\n' + sizes + '\n' + types + '\n' + counts + '\n'; }
};

std::string shortest(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

std::string viewpoint_line(const Viewpoint& viewpoint) {
  const auto& [x, y, z, w] = viewpoint.quaternion_xyzw;
  std::string line = "VIEWPOINT";
  for (const double number :
       {viewpoint.position.x(), viewpoint.position.y(), viewpoint.position.z(), w, x, y, z}) {
    line += ' ' + shortest(number);
  }
  return line + '\n';
}

template <class T>
void put(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// About an origin, float32 would lose what the origin is there to keep.
void append_point(std::string& bytes, const Scan& scan, const Eigen::Vector3f& position) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (scan.origin.isZero(0.0)) {
      put(bytes, position(axis));
    } else {
      put(bytes, scan.origin(axis) + static_cast<double>(position(axis)));
    }
  }
}

}  // namespace

std::string write_pcd(const Scan& scan) {
  const std::size_t coordinate_bytes = scan.origin.isZero(0.0) ? sizeof(float) : sizeof(double);
  FieldLines fields;
  for (const char* name : {"x", "y", "z"}) fields.add(name, coordinate_bytes, 'F');
  if (!scan.colours.empty()) fields.add("rgb", 4, 'U');
  if (!scan.labels.empty()) fields.add("label", 4, 'U');
  if (!scan.covariances.empty()) {
    for (const char* name : covariance_fields) fields.add(name, sizeof(double), 'F');
  }
  if (!scan.viewpoints.empty()) {
    for (const char* name : {"vp_x", "vp_y", "vp_z"}) fields.add(name, coordinate_bytes, 'F');
  }

  std::string bytes = "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n" + fields.text() + "WIDTH " +
                      std::to_string(scan.width) + "\nHEIGHT " + std::to_string(scan.height) + '\n' +
                      viewpoint_line(scan.viewpoint) + "POINTS " + std::to_string(scan.size()) +
                      "\nDATA binary\n";
  bytes.reserve(bytes.size() + scan.size() * fields.bytes);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    append_point(bytes, scan, scan.positions[i]);
    if (!scan.colours.empty()) {
      const auto& [red, green, blue] = scan.colours[i];
      put(bytes, static_cast<std::uint32_t>(red << 16 | green << 8 | blue));
    }
    if (!scan.labels.empty()) put(bytes, scan.labels[i]);
    if (!scan.covariances.empty()) put(bytes, scan.covariances[i]);
    if (!scan.viewpoints.empty()) append_point(bytes, scan, scan.viewpoints[i]);
  }
  return bytes;
}

}  // namespace patchlab
