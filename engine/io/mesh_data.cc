#include "engine/io/mesh_data.h"

#include <algorithm>

namespace patchlab {

void add_face(MeshData& mesh, std::span<const std::int64_t> corners, std::size_t vertices) {
  const auto there = [&](std::int64_t index) {
    return index >= 0 && index < static_cast<std::int64_t>(vertices);
  };
  ++mesh.faces;
  if (corners.size() < 3 || !std::ranges::all_of(corners, there)) {
    ++mesh.bad_faces;
    return;
  }
  const auto id = [&](std::size_t i) { return static_cast<std::uint32_t>(corners[i]); };
  for (std::size_t i = 2; i < corners.size(); ++i) mesh.triangles.push_back({id(0), id(i - 1), id(i)});
}

}  // namespace patchlab
