// Triangle meshes as files hold them: OBJ, OFF, STL and PLY, read by our own strict readers.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/io/read_scan.h"

namespace patchlab {

struct MeshData {
  std::string format, encoding;
  std::vector<Eigen::Vector3d> vertices;                // in the unit of the file
  std::vector<std::array<std::uint32_t, 3>> triangles;  // faces of more vertices are cut into fans
  std::uint64_t faces = 0, bad_faces = 0;               // bad: fewer than three vertices, or not all there
  std::vector<std::string> notices;
};

// unreadable error with the line at fault, or what the header promises and the file does not hold. A mesh has
// a vertex at least; faces that name vertices which are not there are counted and dropped.
Result<MeshData> parse_obj(std::string_view bytes, const std::string& name, const ReadOptions& options);
Result<MeshData> parse_off(std::string_view bytes, const std::string& name, const ReadOptions& options);
// Equal corners of triangles become one vertex.
Result<MeshData> parse_stl(std::string_view bytes, const std::string& name, const ReadOptions& options);
Result<MeshData> parse_ply(std::string_view bytes, const std::string& name, const ReadOptions& options);

// Whichever of them the bytes are. unreadable error also where they are no mesh, or one without a face.
Result<MeshData> parse_mesh(std::string_view bytes, const std::string& name, const ReadOptions& options);

// Adds a face of these vertices (indices counted from 0) as triangles, or counts it as bad.
void add_face(MeshData& mesh, std::span<const std::int64_t> corners, std::size_t vertices);

}  // namespace patchlab
