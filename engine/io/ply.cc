#include <Eigen/Geometry>
#include <algorithm>

#include "engine/io/ply_elements.h"
#include "engine/io/ply_header.h"
#include "engine/io/read_error.h"
#include "engine/io/read_scan.h"
#include "engine/io/scan_from_columns.h"

namespace patchlab {
namespace {

constexpr double axes_tolerance = 1e-3;
constexpr std::array<std::string_view, 12> camera_names = {"view_px", "view_py", "view_pz", "x_axisx",
                                                           "x_axisy", "x_axisz", "y_axisx", "y_axisy",
                                                           "y_axisz", "z_axisx", "z_axisy", "z_axisz"};
constexpr std::array<std::string_view, 2> viewport_names = {"viewportx", "viewporty"};

const PlyElement* find_element(const PlyHeader& header, std::string_view name) {
  const auto found = std::ranges::find(header.elements, name, &PlyElement::name);
  return found == header.elements.end() ? nullptr : &*found;
}

template <std::size_t N>
std::array<double, N> first_record(const std::array<const Column*, N>& columns) {
  std::array<double, N> numbers{};
  for (std::size_t i = 0; i < N; ++i) gather(*columns[i], 1, 0, &numbers[i], 1);
  return numbers;
}

// The axes of a camera, in the frame of the points, are the columns of its rotation.
void set_viewpoint(const PlyElementData& camera, Scan& scan) {
  const auto columns = find_columns(camera.columns, camera_names);
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
  if (is_complete(columns)) {
    const std::array<double, 12> numbers = first_record(columns);
    position = Eigen::Map<const Eigen::Vector3d>(numbers.data());
    axes = Eigen::Map<const Eigen::Matrix3d>(numbers.data() + 3);
  }
  const bool rotation = (axes.transpose() * axes).isIdentity(axes_tolerance) && axes.determinant() > 0.0;
  if (!rotation || !position.allFinite()) {
    scan.notices.push_back(
        std::string("The camera of the file has no position with three axes at right angles")
            .append(at_the_origin));
  } else if (axes.isIdentity(0.0) && position.isZero(0.0)) {
    scan.notices.push_back(
        std::string("The camera of the file is the identity, which says nothing").append(at_the_origin));
  } else {
    const Eigen::Quaterniond q(axes);
    scan.viewpoint = {position, {q.x(), q.y(), q.z(), q.w()}, true};
  }
}

// Some writers keep the size of a pixel grid as the camera's viewport; others a size that has nothing to do
// with it.
void set_grid(const PlyElementData& camera, std::uint64_t points, Scan& scan) {
  const auto columns = find_columns(camera.columns, viewport_names);
  if (!is_complete(columns)) return;
  const auto [width, height] = first_record(columns);
  if (width < 2.0 || height < 2.0 || width * height != static_cast<double>(points)) return;
  scan.width = static_cast<std::uint32_t>(width);
  scan.height = static_cast<std::uint32_t>(height);
}

// Binary faces that are damaged without exception were never faces: the counts of the header are wrong.
Result<void> leave_out(const PlyElement& element, const PlyElementData& data, Scan& scan) {
  if (element.count == 0) return {};
  if (scan.encoding != "ascii" && element.name == "face" && data.bad_faces == element.count) {
    return unreadable(scan.file, "none of its faces is a face; the counts in its header are wrong.");
  }
  const std::string damaged =
      data.bad_faces == 0 ? "" : ", " + std::to_string(data.bad_faces) + " of them damaged";
  scan.notices.push_back("Only vertices are read as points; element " + shown(element.name) + " (" +
                         std::to_string(element.count) + damaged + ") was left out.");
  return {};
}

Scan scan_of(const PlyHeader& header, const PlyElement& vertex, const std::string& name) {
  Scan scan;
  scan.file = name;
  scan.format = "ply";
  scan.encoding = header.encoding;
  scan.width = static_cast<std::uint32_t>(vertex.count);
  for (const PlyProperty& property : vertex.properties) {
    if (property.list_size) continue;
    scan.fields.push_back({property.name, std::string(patchlab::name(property.type)), 1});
  }
  return scan;
}

}  // namespace

Result<Scan> read_ply(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  const Result<PlyHeader> header = parse_ply_header(bytes, name);
  if (!header) return header.error();
  const PlyElement* const vertex = find_element(*header, "vertex");
  if (vertex == nullptr || vertex->count == 0) return unreadable(name, "the PLY file holds no vertices.");
  const PlyElement* const camera = find_element(*header, "camera");
  Scan scan = scan_of(*header, *vertex, name);

  PlyCursor cursor(bytes, *header, name);
  PlyElementData vertices;
  for (const PlyElement& element : header->elements) {
    Result<PlyElementData> data = read_ply_element(cursor, element, vertex->count, options);
    if (!data) return data.error();
    if (&element == vertex) {
      vertices = std::move(*data);
    } else if (&element == camera && camera->count == 1) {
      set_viewpoint(*data, scan);
      set_grid(*data, vertex->count, scan);
    } else {
      if (const Result<void> left_out = leave_out(element, *data, scan); !left_out) return left_out.error();
    }
  }
  if (camera == nullptr || camera->count != 1) {
    scan.notices.push_back(std::string("The file states no single camera").append(at_the_origin));
  }
  if (!cursor.is_text() || !trimmed(cursor.rest()).empty()) note_rest(cursor.rest(), scan.notices);
  const auto filled = fill_scan(scan, vertices.columns, vertex->count, OriginRule::where_large, options);
  if (!filled) return filled.error();
  return scan;
}

}  // namespace patchlab
