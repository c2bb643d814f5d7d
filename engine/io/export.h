// Exports of a patch set, each a table row: a name, a one-line description and a function to bytes.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/io/patch_set.h"

namespace patchlab {

struct ExportFormat {
  std::string_view name;       // "patch_set", "ply"
  std::string_view extension;  // ".json"
  std::string_view description;
  Result<std::string> (*write)(const PatchSet& set);
};

std::span<const ExportFormat> export_formats();
// usage error that lists the formats for an unknown name.
Result<const ExportFormat*> export_format(std::string_view name);

}  // namespace patchlab
