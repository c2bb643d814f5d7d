#include <algorithm>
#include <bit>
#include <cstring>
#include <numeric>
#include <tuple>

#include "engine/io/mesh_data.h"
#include "engine/io/read_error.h"
#include "engine/io/scan_from_columns.h"
#include "engine/io/text_numbers.h"

namespace patchlab {
namespace {

constexpr std::size_t header_bytes = 84, triangle_bytes = 50;
constexpr std::size_t stl_lines_between_progress = 1 << 16;

using Corner = std::array<float, 3>;
using Corners = std::vector<Corner>;  // three a triangle

std::array<std::uint32_t, 3> bits(const Corner& corner) {
  return std::bit_cast<std::array<std::uint32_t, 3>>(corner);
}

std::uint64_t promised_triangles(std::string_view bytes) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < 4; ++i)
    count |= std::uint64_t{static_cast<unsigned char>(bytes[header_bytes - 4 + i])} << (8 * i);
  return count;
}

bool is_binary(std::string_view bytes) {
  return bytes.size() >= header_bytes &&
         bytes.size() == header_bytes + promised_triangles(bytes) * triangle_bytes;
}

Corners binary_corners(std::string_view bytes) {
  constexpr std::size_t normal_bytes = 12;
  Corners corners;
  const std::uint64_t triangles = promised_triangles(bytes);
  corners.reserve(3 * triangles);
  for (std::uint64_t i = 0; i < triangles; ++i) {
    std::array<Corner, 3> triangle;
    std::memcpy(&triangle, bytes.data() + header_bytes + i * triangle_bytes + normal_bytes, sizeof triangle);
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  return corners;
}

Result<Corner> corner_of(std::string_view rest, std::size_t line, const std::string& name) {
  Corner corner{};
  for (float& value : corner) {
    const std::string_view word = next_word(rest);
    const auto number = parse_number<double>(word);
    if (!number) return unreadable_line(name, line, shown(word) + " in a vertex is not a number.");
    value = static_cast<float>(*number);
  }
  if (trimmed(rest).empty()) return corner;
  return unreadable_line(name, line, "a vertex has more than three values.");
}

// "solid", then facets of "facet normal", "outer loop", three times "vertex x y z", "endloop", "endfacet".
Result<Corners> text_corners(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  constexpr std::string_view silent[] = {"solid", "outer", "endloop", "endsolid"};
  Corners corners;
  LineReader lines(bytes);
  const auto all = static_cast<double>(bytes.size() + 1);
  bool open = false;
  std::size_t begin = 0;
  while (const auto line = lines.next()) {
    std::string_view rest = trimmed(*line);
    const std::string entry = lower_case(next_word(rest));
    if (entry == "vertex" && open) {
      const Result<Corner> corner = corner_of(rest, lines.number(), name);
      if (!corner) return corner.error();
      corners.push_back(*corner);
    } else if (entry == "facet" && !open) {
      open = true;
      begin = corners.size();
    } else if (entry == "endfacet" && open) {
      if (corners.size() != begin + 3)
        return unreadable_line(name, lines.number(),
                               "the facet that ends here has " + std::to_string(corners.size() - begin) +
                                   " vertices, not three.");
      open = false;
    } else if (!entry.empty() && std::ranges::find(silent, entry) == std::end(silent)) {
      return unreadable_line(name, lines.number(), shown(entry) + " does not belong here in an STL file.");
    }
    if (lines.number() % stl_lines_between_progress == 0 &&
        !keep_going(options.progress, 1.0 - static_cast<double>(lines.rest().size()) / all))
      return Error{ErrorCode::cancelled, name + ": reading was cancelled."};
  }
  if (open) return unreadable(name, "it ends within a facet; the file is cut off.");
  return corners;
}

// Each different corner once, in the order of their first appearance.
void merge(const Corners& corners, MeshData& mesh) {
  std::vector<std::uint32_t> order(corners.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, {}, [&](std::uint32_t i) { return std::tuple(bits(corners[i]), i); });
  std::vector<std::uint32_t> first(corners.size()), vertex(corners.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool repeated = k > 0 && bits(corners[order[k]]) == bits(corners[order[k - 1]]);
    first[order[k]] = repeated ? first[order[k - 1]] : order[k];
  }
  std::vector<std::int64_t> triangle;
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    if (first[i] == i) {
      vertex[i] = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.emplace_back(corners[i][0], corners[i][1], corners[i][2]);
    }
    vertex[i] = vertex[first[i]];
    triangle.push_back(vertex[i]);
    if (triangle.size() < 3) continue;
    const bool line = triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
    add_face(mesh, line ? std::span<const std::int64_t>{} : triangle, corners.size());
    triangle.clear();
  }
}

}  // namespace

Result<MeshData> parse_stl(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  MeshData mesh;
  mesh.format = "stl";
  mesh.encoding = is_binary(bytes) ? "binary" : "ascii";
  if (mesh.encoding == "ascii" && !lower_case(trimmed(bytes.substr(0, header_bytes))).starts_with("solid")) {
    if (bytes.size() < header_bytes) return unreadable(name, "is too short for an STL file.");
    return unreadable(name, "its header promises " + std::to_string(promised_triangles(bytes)) +
                                " triangles of 50 bytes, but " + std::to_string(bytes.size() - header_bytes) +
                                " bytes follow; the file is cut off or no STL file.");
  }
  if (const auto fits = check_memory(name, bytes.size() / triangle_bytes * 3, 0, options); !fits)
    return fits.error();
  Result<Corners> corners =
      mesh.encoding == "binary" ? Result<Corners>(binary_corners(bytes)) : text_corners(bytes, name, options);
  if (!corners) return corners.error();
  if (corners->empty()) return unreadable(name, "the STL file holds no triangles.");
  merge(*corners, mesh);
  return mesh;
}

}  // namespace patchlab
