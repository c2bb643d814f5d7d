#include <cmath>
#include <set>

#include "engine/io/json.h"

namespace patchlab {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::size_t line_width = 110;
constexpr int deepest = 64;

// Watches a parse for what nlohmann lets pass: members that stand twice, and nesting that would exhaust the
// stack of whoever walks the value.
class ParseWatch {
 public:
  bool operator()(int depth, json::parse_event_t event, json& parsed) {
    if (depth > deepest) problem_ = "is nested deeper than " + std::to_string(deepest) + " levels";
    switch (event) {
      case json::parse_event_t::object_start:
        members_.emplace_back();
        break;
      case json::parse_event_t::object_end:
        members_.pop_back();
        break;
      case json::parse_event_t::key:
        see(parsed.get<std::string>());
        break;
      default:
        break;
    }
    return problem_.empty();
  }
  const std::string& problem() const { return problem_; }

 private:
  void see(const std::string& key) {
    const bool is_new = members_.back().insert(key).second;
    if (!is_new && problem_.empty()) problem_ = "holds the member \"" + key + "\" twice in one object";
  }

  std::vector<std::set<std::string>> members_;
  std::string problem_;
};

// "[json.exception.parse_error.101] parse error at line 1, column 2: ..." without the bracket.
std::string plain_message(const json::exception& exception) {
  const std::string what = exception.what();
  const std::size_t bracket = what.find("] ");
  return bracket == std::string::npos ? what : what.substr(bracket + 2);
}

std::string joined(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

std::string not_finite_below(const ordered_json& value, const std::string& path) {
  if (value.is_number_float() && !std::isfinite(value.get<double>())) {
    return path + " is " + (std::isnan(value.get<double>()) ? "not a number" : "infinite");
  }
  if (!value.is_structured()) return {};
  std::size_t index = 0;
  for (const auto& [key, element] : value.items()) {
    const std::string place =
        value.is_object() ? joined(path, key) : path + "[" + std::to_string(index++) + "]";
    if (std::string found = not_finite_below(element, place); !found.empty()) return found;
  }
  return {};
}

std::string on_one_line(const ordered_json& value) {
  if (!value.is_structured()) return value.dump();
  std::string text, separator;
  for (const auto& [key, element] : value.items()) {
    text += separator;
    if (value.is_object()) text += ordered_json(key).dump() + ": ";
    text += on_one_line(element);
    separator = ", ";
  }
  return value.is_object() ? "{" + text + "}" : "[" + text + "]";
}

void append(std::string& text, const ordered_json& value, std::size_t indent) {
  const std::string line = on_one_line(value);
  if (!value.is_structured() || value.empty() || line.size() + indent <= line_width) {
    text += line;
    return;
  }
  const std::string margin(indent + 2, ' ');
  std::string separator = "\n";
  text += value.is_object() ? "{" : "[";
  for (const auto& [key, element] : value.items()) {
    text += separator + margin;
    if (value.is_object()) text += ordered_json(key).dump() + ": ";
    append(text, element, indent + 2);
    separator = ",\n";
  }
  text += "\n" + std::string(indent, ' ') + (value.is_object() ? "}" : "]");
}

}  // namespace

Result<json> parse_json(std::string_view text, const std::string& name) {
  ParseWatch watch;
  const auto callback = [&watch](int depth, json::parse_event_t event, json& parsed) {
    return watch(depth, event, parsed);
  };
  try {
    json value = json::parse(text, callback);
    if (!watch.problem().empty()) return Error{ErrorCode::unreadable, name + ": " + watch.problem() + "."};
    return value;
  } catch (const json::exception& exception) {
    return Error{ErrorCode::unreadable, name + ": is not JSON: " + plain_message(exception) + "."};
  }
}

std::string not_finite(const ordered_json& value) { return not_finite_below(value, ""); }

Result<std::string> json_text(const ordered_json& value, const std::string& name) {
  if (const std::string problem = not_finite(value); !problem.empty()) {
    return Error{ErrorCode::refused, name + ": " + problem + "; nothing was written."};
  }
  try {
    std::string text;
    append(text, value, 0);
    return text + "\n";
  } catch (const json::exception&) {
    return Error{ErrorCode::refused, name + ": a name in it is not UTF-8 text; nothing was written."};
  }
}

}  // namespace patchlab
