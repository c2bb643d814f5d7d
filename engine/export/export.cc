#include "engine/export/export.h"

#include <algorithm>
#include <cmath>

#include "engine/base/file.h"
#include "engine/base/folder.h"
#include "engine/export/formats.h"

namespace patchlab {
namespace {

constexpr ExportFormat formats[] = {
    {"patch_set", ".json", "the patch set: every parameter and covariance, to the bit",
     "full, of the parameters in their order, and local; of the pose as ROS has it, and as --covariance asks",
     export_patch_set},
    {"csv", ".csv", "a table, one row a patch: every parameter with its sigma, to the bit",
     "full, of the parameters in their order: the upper triangle", export_csv},
    {"footholds", ".json", "for footstep planners: a convex polygon a patch that keeps away from its outline",
     "in the inset of the polygons, the sigma of the tilt and its probability", export_footholds},
    {"planar_regions", ".json",
     "the same polygons in the fields of PlanarTerrain, of patches that are nearly flat",
     "in the inset of the polygons", export_planar_regions},
    {"ply", ".ply", "one triangle mesh in doubles, with patch number and height sigma a vertex",
     "the standard deviation of the height at each vertex, along the normal", export_ply},
    {"obj", ".obj", "a triangle mesh a patch, in decimals that lose nothing", "none", export_obj},
    {"stl", ".stl", "triangles in single precision, without names", "none", export_stl},
    {"urdf", "", "a collision world: world.urdf, one fixed link a patch, and thick meshes", "none",
     export_urdf},
    {"mjcf", "", "a collision world for MuJoCo: world.xml, thick meshes, height fields of concave patches",
     "none", export_mjcf},
    {"ros1-bag", ".bag",
     "for ROS 1 and RViz: markers, a pose with covariance a patch, points with covariances",
     "of position, then rotation about fixed parent axes; an unknown spin has variance pi^2/3",
     export_ros1_bag},
    {"ros2-yaml", "", "the same messages for ros2 topic pub, one YAML file each",
     "of position, then rotation about fixed parent axes; an unknown spin has variance pi^2/3",
     export_ros2_yaml},
};

Result<void> check_options(const ExportOptions& options) {
  const auto wrong = [](const std::string& what) { return Error{ErrorCode::usage, what}; };
  const auto sensible = [](double value) { return std::isfinite(value) && value >= 0.0; };
  if (options.thickness && !(sensible(*options.thickness) && *options.thickness > 0.0))
    return wrong("The thickness of solids is a length above 0, in metre.");
  if (!sensible(options.inset_sigmas)) return wrong("The inset in standard deviations is a number from 0.");
  if (!sensible(options.foot_radius)) return wrong("The radius of the foot is a length from 0, in metre.");
  if (!options.up.allFinite() || options.up.norm() == 0.0)
    return wrong("Up is a direction, not of length 0.");
  if (!(options.tilt_limit > 0.0 && options.tilt_limit < 3.14159))
    return wrong("The limit of the tilt lies between 0 and 180 degrees.");
  return {};
}

Result<void> check_ids(const PatchSet& set, const std::vector<std::string>& ids) {
  for (const std::string& id : ids) {
    if (std::ranges::count(set.patches, id, &PatchRecord::id) > 0) continue;
    std::string known;
    for (const PatchRecord& record : set.patches) known += (known.empty() ? "" : ", ") + record.id;
    return Error{ErrorCode::usage, "There is no patch '" + id + "'; the set holds " + known + "."};
  }
  return {};
}

PatchSet chosen(const PatchSet& set, const std::vector<std::string>& ids) {
  PatchSet out = set;
  if (!ids.empty()) {
    std::erase_if(out.patches,
                  [&](const PatchRecord& record) { return std::ranges::count(ids, record.id) == 0; });
  }
  return out;
}

std::string size_words(std::size_t bytes) {
  if (bytes < 10'000) return std::to_string(bytes) + " bytes";
  if (bytes < 10'000'000) return std::to_string(bytes / 1000) + " kB";
  return std::to_string(bytes / 1'000'000) + " MB";
}

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

Result<Exported> export_patches(const ExportFormat& format, const PatchSet& set,
                                const ExportOptions& options) {
  if (const Result<void> checked = check_options(options); !checked) return checked.error();
  if (const Result<void> checked = check_ids(set, options.patches); !checked) return checked.error();
  const PatchSet wanted = chosen(set, options.patches);
  for (const PatchRecord& record : wanted.patches) {
    if (const Result<void> valid = validate(record.patch); !valid) {
      return Error{ErrorCode::refused,
                   "patch \"" + record.id + "\": " + valid.error().message + " Nothing was written."};
    }
  }
  return format.write(wanted, options);
}

ExportPreview preview_export(const ExportFormat& format, const PatchSet& set, const ExportOptions& options) {
  ExportPreview preview;
  const Result<Exported> exported = export_patches(format, set, options);
  if (!exported) {
    preview.refusal = exported.error().message;
    return preview;
  }
  for (const PatchRecord& record : chosen(set, options.patches).patches) preview.patches.push_back(record.id);
  preview.lines.emplace_back(format.description);
  for (const ExportedFile& file : exported->files) {
    preview.lines.push_back((file.name.empty() ? "one file" : file.name) + ", " +
                            size_words(file.bytes.size()));
  }
  preview.lines.push_back("covariance: " + std::string(format.covariance));
  preview.lines.insert(preview.lines.end(), exported->notices.begin(), exported->notices.end());
  return preview;
}

Result<void> write_exported(const Exported& exported, const std::filesystem::path& place) {
  const bool is_file = exported.files.size() == 1 && exported.files.front().name.empty();
  if (is_file) return write_file(place, exported.files.front().bytes);
  if (place == "-")
    return Error{ErrorCode::usage, "This format is a folder of several files; name it with --output."};
  std::vector<std::pair<std::string, std::string_view>> files;
  for (const ExportedFile& file : exported.files) files.emplace_back(file.name, file.bytes);
  return write_folder(place, files);
}

}  // namespace patchlab
