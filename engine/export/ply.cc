#include <cstdint>

#include "engine/export/formats.h"
#include "engine/export/text.h"
#include "engine/export/triangles.h"
#include "engine/patch/marginals.h"

namespace patchlab {
namespace {

constexpr double no_covariance = -1.0;

struct PlyBody {
  std::string comments, vertices, faces;
  std::uint32_t vertex_count = 0, face_count = 0;
};

void append_patch(PlyBody& body, const PatchRecord& record, std::uint32_t number,
                  const ExportOptions& options) {
  const Patch& patch = record.patch;
  body.comments += "comment patch " + std::to_string(number) + " is " + one_line(record.id) + ": " +
                   std::string(name(patch.type->surface)) + ", " + std::string(name(patch.type->boundary)) +
                   ", in frame " + one_line(record.frame_id) + "\n";
  const Triangles mesh = placed_triangles(patch, options);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    append_bytes(body.vertices, mesh.points[i]);
    append_bytes(body.vertices, mesh.normals[i]);
    append_bytes(body.vertices, patch.covariance_local ? height_sigma(patch, mesh.u[i]) : no_covariance);
    append_bytes(body.vertices, number);
  }
  for (const auto& face : mesh.faces) {
    append_bytes(body.faces, std::uint8_t{3});
    for (const std::uint32_t vertex : face) append_bytes(body.faces, body.vertex_count + vertex);
  }
  body.vertex_count += static_cast<std::uint32_t>(mesh.points.size());
  body.face_count += static_cast<std::uint32_t>(mesh.faces.size());
}

std::string ply_header(const PlyBody& body, const ExportOptions& options) {
  return std::string("ply\nformat binary_little_endian 1.0\n") +
         "comment patchlab: bounded curved patches as " +
         (options.thickness ? "solids " + decimal(*options.thickness) + " m thick" : "open triangle meshes") +
         ", counterclockwise seen from outside; metre\n"
         "comment height_sigma: standard deviation of the height along the normal, from the covariance of curvature "
         "and pose, m; -1: no covariance\n" +
         body.comments + "element vertex " + std::to_string(body.vertex_count) +
         "\nproperty double x\nproperty double y\nproperty double z\n"
         "property double nx\nproperty double ny\nproperty double nz\n"
         "property double height_sigma\nproperty uint patch\n"
         "element face " +
         std::to_string(body.face_count) + "\nproperty list uchar uint vertex_indices\nend_header\n";
}

}  // namespace

Result<Exported> export_ply(const PatchSet& set, const ExportOptions& options) {
  if (const Result<std::string> frame = common_frame(set, "ply"); !frame) return frame.error();
  PlyBody body;
  std::uint32_t number = 0;
  for (const PatchRecord& record : set.patches) append_patch(body, record, number++, options);
  return Exported{{{"", ply_header(body, options) + body.vertices + body.faces}}, {}};
}

}  // namespace patchlab
