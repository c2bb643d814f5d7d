#include <algorithm>
#include <limits>

#include "engine/export/formats.h"
#include "engine/export/text.h"
#include "engine/io/patch_json.h"
#include "engine/patch/marginals.h"

namespace patchlab {
namespace {

constexpr int largest_size = 11;
constexpr double absent = std::numeric_limits<double>::quiet_NaN();

// Every name that a parameter of some type has, in the order of Table I.
std::vector<std::string> all_parameter_names() {
  std::vector<std::string> names;
  for (const char* name : {"d_x", "d_y", "d", "d_1", "d_2", "d_3", "d_4", "gamma", "kappa_x", "kappa_y",
                           "kappa", "r_x", "r_y", "r_z", "c_x", "c_y", "c_z"})
    names.emplace_back(name);
  return names;
}

// A text as one field (RFC 4180).
std::string field(const std::string& text) {
  if (text.find_first_of(",\"") == std::string::npos) return one_line(text);
  std::string quoted = "\"";
  for (const char c : one_line(text)) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string heading() {
  std::string line = "id,frame_id,source,surface,boundary,size";
  for (const std::string& name : all_parameter_names()) line += "," + name;
  for (const std::string& name : all_parameter_names()) line += ",sigma_" + name;
  line += ",q_x,q_y,q_z,q_w";
  for (int i = 1; i <= largest_size; ++i) {
    for (int j = i; j <= largest_size; ++j) line += ",cov_" + std::to_string(i) + "_" + std::to_string(j);
  }
  return line + "\n";
}

// The values in the columns of their names; NaN where the type has no such parameter.
std::string by_name(const PatchTypeRow& type, const PatchVector& values) {
  const std::vector<std::string> names = parameter_names(type);
  std::string text;
  for (const std::string& name : all_parameter_names()) {
    const auto at = std::ranges::find(names, name);
    text += "," + decimal(at == names.end() ? absent : values[at - names.begin()]);
  }
  return text;
}

std::string upper_triangle(const std::optional<PatchMatrix>& covariance) {
  std::string text;
  for (int i = 0; i < largest_size; ++i) {
    for (int j = i; j < largest_size; ++j)
      text += "," + decimal(covariance && j < covariance->rows() ? (*covariance)(i, j) : absent);
  }
  return text;
}

std::string row(const PatchRecord& record) {
  const Patch& patch = record.patch;
  const PatchTypeRow& type = *patch.type;
  const PatchVector unknown = PatchVector::Constant(type.size(), absent);
  const std::array<double, 4> q = quaternion_xyzw(world_from_patch(patch).r);
  return field(record.id) + "," + field(record.frame_id) + "," + field(record.source) + "," +
         std::string(name(type.surface)) + "," + std::string(name(type.boundary)) + "," +
         std::to_string(type.size()) + by_name(type, patch.parameters) +
         by_name(type, patch.covariance ? sigmas(*patch.covariance) : unknown) + "," +
         decimals(Eigen::Vector4d::Map(q.data()), ",") + upper_triangle(patch.covariance) + "\n";
}

}  // namespace

Result<Exported> export_csv(const PatchSet& set, const ExportOptions&) {
  std::string text = heading();
  for (const PatchRecord& record : set.patches) text += row(record);
  return Exported{{{"", std::move(text)}}, {}};
}

}  // namespace patchlab
