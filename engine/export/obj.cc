#include "engine/export/formats.h"
#include "engine/export/text.h"
#include "engine/export/triangles.h"

namespace patchlab {
namespace {

void append_lines(std::string& text, std::string_view keyword, const std::vector<Vector3d>& vectors) {
  for (const Vector3d& vector : vectors) text += std::string(keyword) + " " + decimals(vector) + "\n";
}

}  // namespace

Result<Exported> export_obj(const PatchSet& set, const ExportOptions& options) {
  const Result<std::string> frame = common_frame(set, "obj");
  if (!frame) return frame.error();
  std::string text = "# patchlab: bounded curved patches, one object each; metre, in frame " +
                     one_line(*frame) + "; no covariance\n";
  std::size_t vertices = 0;
  for (const PatchRecord& record : set.patches) {
    const Triangles mesh = placed_triangles(record.patch, options);
    text += "o " + one_line(record.id) + "\n";
    append_lines(text, "v", mesh.points);
    append_lines(text, "vn", mesh.normals);
    for (const auto& face : mesh.faces) {
      text += "f";
      for (const std::uint32_t vertex : face) {
        const std::string index = std::to_string(vertices + vertex + 1);
        text += " " + index + "//" + index;
      }
      text += "\n";
    }
    vertices += mesh.points.size();
  }
  return Exported{{{"", std::move(text)}}, {}};
}

}  // namespace patchlab
