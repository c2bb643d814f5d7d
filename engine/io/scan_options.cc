#include "engine/io/scan_options.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/io/json.h"
#include "engine/io/read_error.h"
#include "engine/io/text_numbers.h"

namespace patchlab {
namespace {

using Numbers = std::vector<double>;

constexpr std::size_t largest_file = 64 << 10;
constexpr std::uint64_t largest_picture_side = 1 << 16;  // px

struct UnitRow {
  LengthUnit unit;
  std::string_view name;
  double metres;
};
constexpr UnitRow units[] = {{LengthUnit::m, "m", 1.0},
                             {LengthUnit::mm, "mm", 0.001},
                             {LengthUnit::cm, "cm", 0.01},
                             {LengthUnit::in, "in", 0.0254}};

const UnitRow& row_of(LengthUnit unit) { return *std::ranges::find(units, unit, &UnitRow::unit); }

// Numbers between blanks, commas, semicolons and brackets; nothing where a word is none.
std::optional<Numbers> list_of_numbers(std::string_view text) {
  constexpr std::string_view between = " \t\r\n,;[]";
  Numbers numbers;
  for (std::size_t begin = text.find_first_not_of(between); begin != std::string_view::npos;
       begin = text.find_first_not_of(between)) {
    text.remove_prefix(begin);
    const std::size_t end = std::min(text.find_first_of(between), text.size());
    const auto number = parse_number<double>(text.substr(0, end));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    text.remove_prefix(end);
  }
  return numbers;
}

// Of a matrix of `width` columns, row by row: [fx 0 cx; 0 fy cy; 0 0 1].
std::optional<Intrinsics> from_matrix(const Numbers& m, std::size_t width) {
  const bool pinhole = m[1] == 0.0 && m[width] == 0.0 && m[2 * width] == 0.0 && m[2 * width + 1] == 0.0 &&
                       m[2 * width + 2] == 1.0;
  if (!pinhole) return std::nullopt;
  return Intrinsics{.fx = m[0], .fy = m[width + 1], .cx = m[2], .cy = m[width + 2]};
}

std::optional<Intrinsics> from_numbers(const Numbers& n) {
  if (n.size() == 4) return Intrinsics{.fx = n[0], .fy = n[1], .cx = n[2], .cy = n[3]};
  if (n.size() == 9) return from_matrix(n, 3);
  if (n.size() == 16) return from_matrix(n, 4);
  return std::nullopt;
}

Numbers transposed(const Numbers& m) { return {m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]}; }

Result<std::optional<Intrinsics>> from_json(std::string_view text, const std::string& name) {
  const Result<nlohmann::json> parsed = parse_json(text, name);
  if (!parsed) return parsed.error();
  std::optional<Error> error;
  const JsonPlace top(*parsed, name, error);
  const JsonPlace root = top.find("intrinsic").value_or(top);
  const Eigen::VectorXd matrix = root["intrinsic_matrix"].numbers(9);
  std::uint64_t width = 0, height = 0;
  if (const auto place = root.find("width")) width = place->whole_number(largest_picture_side);
  if (const auto place = root.find("height")) height = place->whole_number(largest_picture_side);
  if (error) return *error;
  // Open3D writes the matrix column by column.
  auto found = from_numbers(transposed(Numbers(matrix.begin(), matrix.end())));
  if (found) {
    found->width = static_cast<std::uint32_t>(width);
    found->height = static_cast<std::uint32_t>(height);
  }
  return found;
}

// The first of these keys that is there; a matrix may stand below it as `data`.
YAML::Node first_of(const YAML::Node& root, std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    const YAML::Node node = root[key];
    if (!node) continue;
    return node.IsMap() ? node["data"] : node;
  }
  return YAML::Node(YAML::NodeType::Undefined);
}

Numbers numbers_of(const YAML::Node& list) {
  return list && list.IsSequence() ? list.as<Numbers>() : Numbers{};
}

std::uint32_t side(const YAML::Node& node) { return node && node.IsScalar() ? node.as<std::uint32_t>() : 0; }

std::optional<Intrinsics> from_yaml(std::string_view text) try {
  const YAML::Node root = YAML::Load(std::string(text));
  if (!root.IsMap()) return std::nullopt;
  const Numbers matrix = numbers_of(first_of(root, {"camera_matrix", "K", "k"}));
  if (matrix.size() != 9) return std::nullopt;
  std::optional<Intrinsics> found = from_matrix(matrix, 3);
  if (!found) return std::nullopt;
  const Numbers distortion = numbers_of(first_of(root, {"distortion_coefficients", "D", "d"}));
  found->distorted = std::ranges::any_of(distortion, [](double k) { return k != 0.0; });
  found->width = side(first_of(root, {"image_width", "width"}));
  found->height = side(first_of(root, {"image_height", "height"}));
  return found;
} catch (const YAML::Exception&) {
  return std::nullopt;
}

}  // namespace

std::string_view name(LengthUnit unit) { return row_of(unit).name; }

std::optional<LengthUnit> length_unit_from_name(std::string_view name) {
  const auto* row = std::ranges::find(units, name, &UnitRow::name);
  return row == std::end(units) ? std::nullopt : std::optional(row->unit);
}

double metres(LengthUnit unit) { return row_of(unit).metres; }

Result<Intrinsics> parse_intrinsics(std::string_view text, const std::string& name) {
  if (text.size() > largest_file) return unreadable(name, "is too large to hold the intrinsics of a camera.");
  std::optional<Intrinsics> found;
  if (trimmed(text).starts_with('{')) {
    const Result<std::optional<Intrinsics>> read = from_json(text, name);
    if (!read) return read.error();
    found = *read;
  } else if (const std::optional<Numbers> numbers = list_of_numbers(text)) {
    found = from_numbers(*numbers);
  } else {
    found = from_yaml(text);
  }
  const auto finite = [](const Intrinsics& i) { return std::isfinite(i.fx + i.fy + i.cx + i.cy); };
  if (found && finite(*found) && found->fx > 0.0 && found->fy > 0.0) return *found;
  return unreadable(
      name,
      "holds no intrinsics of a pinhole camera; write fx,fy,cx,cy in pixels, a 3x3 matrix, a ROS "
      "camera_info in YAML or Open3D's JSON.");
}

}  // namespace patchlab
