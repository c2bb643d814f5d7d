#include "engine/io/export.h"

#include "engine/io/export_ply.h"

namespace patchlab {
namespace {

constexpr ExportFormat formats[] = {
    {"patch_set", ".json", "the patch set: every parameter and covariance, to the bit", write_patch_set},
    {"ply", ".ply", "the surfaces as one triangle mesh, with patch number and height sigma a vertex",
     write_ply},
};

}  // namespace

std::span<const ExportFormat> export_formats() { return formats; }

Result<const ExportFormat*> export_format(std::string_view name) {
  std::string known;
  for (const ExportFormat& format : formats) {
    if (format.name == name) return &format;
    known += (known.empty() ? "" : ", ") + std::string(format.name);
  }
  return Error{ErrorCode::usage,
               "There is no export format '" + std::string(name) + "'; the formats are " + known + "."};
}

}  // namespace patchlab
