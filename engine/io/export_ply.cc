#include "engine/io/export_ply.h"

#include <bit>
#include <cstdint>

#include "engine/mesh/patch_mesh.h"
#include "engine/patch/marginals.h"

namespace patchlab {
namespace {

static_assert(std::endian::native == std::endian::little,
              "the bytes below are written as they lie in memory");

constexpr double no_covariance = -1.0;

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Ids and names are the user's: a comment keeps to its line.
std::string one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  return text;
}

struct PlyBody {
  std::string comments, vertices, faces;
  std::uint32_t vertex_count = 0, face_count = 0;
};

void append_patch(PlyBody& body, const PatchRecord& record, std::uint32_t number) {
  const Patch& patch = record.patch;
  body.comments += "comment patch " + std::to_string(number) + " is " + one_line(record.id) + ": " +
                   std::string(name(patch.type->surface)) + ", " + std::string(name(patch.type->boundary)) +
                   ", in frame " + one_line(record.frame_id) + "\n";
  const TriangleMesh mesh = surface_mesh(patch);
  const std::vector<Vector2d> coordinates = surface_coordinates(patch);
  for (const auto vertex : mesh.vertices()) {
    append(body.vertices, mesh.point(vertex));
    append(body.vertices, mesh.normal(vertex));
    const Vector2d& u = coordinates[static_cast<std::size_t>(vertex.idx())];
    append(body.vertices, patch.covariance_local ? height_sigma(patch, u) : no_covariance);
    append(body.vertices, number);
  }
  for (const auto face : mesh.faces()) {
    append(body.faces, std::uint8_t{3});
    for (const auto vertex : mesh.fv_range(face)) {
      append(body.faces, body.vertex_count + static_cast<std::uint32_t>(vertex.idx()));
    }
  }
  body.vertex_count += static_cast<std::uint32_t>(mesh.n_vertices());
  body.face_count += static_cast<std::uint32_t>(mesh.n_faces());
}

std::string header(const PlyBody& body) {
  return "ply\nformat binary_little_endian 1.0\n"
         "comment patchlab: bounded curved patches as triangles, counterclockwise seen from outside; metre\n"
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

Result<std::string> write_ply(const PatchSet& set) {
  PlyBody body;
  for (std::size_t i = 0; i < set.patches.size(); ++i) {
    const PatchRecord& record = set.patches[i];
    if (const Result<void> valid = validate(record.patch); !valid) {
      return Error{ErrorCode::refused,
                   "patch \"" + record.id + "\": " + valid.error().message + " Nothing was written."};
    }
    append_patch(body, record, static_cast<std::uint32_t>(i));
  }
  return header(body) + body.vertices + body.faces;
}

}  // namespace patchlab
