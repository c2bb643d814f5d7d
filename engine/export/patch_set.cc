#include <algorithm>

#include "engine/export/formats.h"
#include "engine/io/pose_covariance.h"

namespace patchlab {
namespace {

using nlohmann::json;

json rows(const Matrix6d& matrix) {
  json array = json::array();
  for (const auto& row : matrix.rowwise()) array.push_back(std::vector<double>(row.begin(), row.end()));
  return array;
}

Result<std::vector<const PoseCovariance*>> conventions_named(const std::vector<std::string>& names) {
  std::vector<const PoseCovariance*> found;
  for (const std::string& name : names) {
    found.push_back(find_pose_covariance(name));
    if (found.back()) continue;
    std::string known;
    for (const PoseCovariance& convention : pose_covariances())
      known += (known.empty() ? "" : ", ") + std::string(convention.name);
    return Error{ErrorCode::usage,
                 "There is no covariance '" + name + "'; those of a pose are " + known + "."};
  }
  return found;
}

}  // namespace

Result<Exported> export_patch_set(const PatchSet& set, const ExportOptions& options) {
  const auto conventions = conventions_named(options.covariances);
  if (!conventions) return conventions.error();
  PatchSet written = set;
  Exported out;
  for (PatchRecord& record : written.patches) {
    if (!conventions->empty() && !record.patch.covariance_local)
      out.notices.push_back("patch \"" + record.id +
                            "\": has no covariance, so none of its pose was written.");
    if (!record.patch.covariance_local) continue;
    for (const PoseCovariance* convention : *conventions)
      record.unknown["pose"]["covariance_" + std::string(convention->name)] =
          rows(convention->of(record.patch));
  }
  Result<std::string> text = write_patch_set(written);
  if (!text) return text.error();
  out.files.push_back({"", std::move(*text)});
  return out;
}

}  // namespace patchlab
