#include <memory>
#include <nlohmann/json.hpp>

#include "engine/cli/options.h"
#include "engine/cli/output.h"
#include "engine/cli/verb.h"
#include "engine/io/read_scan.h"
#include "engine/io/scan_size.h"
#include "engine/scan/survey.h"

namespace patchlab {
namespace {

using nlohmann::ordered_json;

constexpr std::uint64_t worth_saying = std::uint64_t{64} << 20;  // bytes, before they are taken

struct InfoRequest {
  std::string scan;
  ScanFlags flags;
  bool json = false;
};

ordered_json list(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

using Size = std::optional<ScanSize>;

std::string memory_of(const ScanSize& size) {
  return (size.exact ? "" : "about ") + std::to_string((size.bytes + (1 << 20) - 1) >> 20) + " MB";
}

ordered_json to_json(const Scan& scan, const Size& size) {
  ordered_json fields = ordered_json::array();
  for (const FieldInfo& field : scan.fields) {
    fields.push_back({{"name", field.name}, {"type", field.type}, {"count", field.count}});
  }
  const Survey found = survey(scan);
  ordered_json box = nullptr;
  if (const std::optional<Bounds> around = bounds(scan))
    box = {{"min", list(around->min)}, {"max", list(around->max)}};
  return {{"file", scan.file},
          {"format", scan.format},
          {"encoding", scan.encoding},
          {"points", scan.size()},
          {"finite_points", scan.finite_count},
          {"width", scan.width},
          {"height", scan.height},
          {"organized", scan.organized()},
          {"fields", fields},
          {"viewpoint",
           {{"position", list(scan.viewpoint.position)},
            {"quaternion_xyzw", scan.viewpoint.quaternion_xyzw},
            {"stated", scan.viewpoint.stated},
            {"per_point", !scan.viewpoints.empty()}}},
          {"bounds", box},
          {"unit", "m"},
          {"covariance", !scan.covariances.empty()},
          {"labels", !scan.labels.empty()},
          {"duplicates", found.duplicates},
          {"far_outliers", found.far_outliers},
          {"memory_bytes", size ? ordered_json(size->bytes) : ordered_json(nullptr)},
          {"notices", scan.notices}};
}

// A file name need not be UTF-8, JSON must be: what is not becomes U+FFFD.
std::string json_text_of(const Scan& scan, const Size& size) {
  return to_json(scan, size).dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string spaced(const ordered_json& numbers) {
  std::string text;
  for (const ordered_json& number : numbers) text += (text.empty() ? "" : " ") + number.dump();
  return text;
}

std::string fields_of(const Scan& scan) {
  std::string text;
  for (const FieldInfo& field : scan.fields) {
    text += (text.empty() ? "" : ", ") + field.name + " " + field.type;
    if (field.count != 1) text += "[" + std::to_string(field.count) + "]";
  }
  return text;
}

std::string to_text(const Scan& scan, const Size& size) {
  const ordered_json json = to_json(scan, size);
  const auto line = [](const char* what, const std::string& value) {
    return std::string(what) + value + "\n";
  };
  const std::string grid = std::to_string(scan.width) + " x " + std::to_string(scan.height);
  std::string text = line("file        ", scan.file + " (" + scan.format + ", " + scan.encoding + ")");
  text += line("points      ", std::to_string(scan.size()) + ", " + std::to_string(scan.finite_count) +
                                   " finite" + (scan.organized() ? ", grid of " + grid : ""));
  text += line("fields      ", fields_of(scan));
  const std::string one_viewpoint = spaced(json["viewpoint"]["position"]) + " m, quaternion xyzw " +
                                    spaced(json["viewpoint"]["quaternion_xyzw"]) +
                                    (scan.viewpoint.stated ? "" : " (assumed)");
  text += line("viewpoint   ", scan.viewpoints.empty() ? one_viewpoint : "one a point");
  if (const ordered_json& box = json["bounds"]; !box.is_null()) {
    text += line("bounds      ", spaced(box["min"]) + " to " + spaced(box["max"]) + " m");
  }
  text += line("covariance  ", scan.covariances.empty() ? "no" : "yes");
  text += line("labels      ", scan.labels.empty() ? "no" : "yes");
  if (json["duplicates"] != 0) text += line("duplicates  ", json["duplicates"].dump());
  if (json["far_outliers"] != 0) {
    text += line("outliers    ", json["far_outliers"].dump() +
                                     " points are ten times farther from the middle than nine tenths of all");
  }
  if (size && size->bytes >= 1 << 20) text += line("memory      ", memory_of(*size) + " to open it");
  for (const std::string& notice : scan.notices) text += line("notice      ", notice);
  return text;
}

Result<int> info(const InfoRequest& request) {
  ProgressLine line("reading");
  ReadOptions options;
  options.progress = line.progress();
  if (const Result<void> told = tell(request.flags, options); !told) return told.error();
  const std::optional<ScanSize> size = foresee_scan(request.scan);
  if (size && size->bytes >= worth_saying)
    say(request.scan + ": opening it takes " + memory_of(*size) + " of memory.");
  const Result<Scan> scan = read_scan(request.scan, options);
  if (!scan) return scan.error();
  Outputs outputs;
  outputs.add("-", request.json ? json_text_of(*scan, size) : to_text(*scan, size));
  return outputs.write();
}

}  // namespace

Action set_up_info(CLI::App& app) {
  const auto request = std::make_shared<InfoRequest>();
  app.add_option("scan", request->scan, "a scan; - is standard input")->required();
  add_scan_flags(app, request->flags);
  app.add_flag("--json", request->json, "print JSON");
  return [request] { return info(*request); };
}

}  // namespace patchlab
