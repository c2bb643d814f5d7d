#include <cmath>
#include <set>

#include "engine/base/printable.h"
#include "engine/io/json.h"

namespace patchlab {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::size_t line_width = 110;
constexpr int deepest = 64;

// Walks over a text ahead of its parse for what nlohmann lets pass: members that stand twice, and nesting
// that would exhaust the stack of whoever walks the value. (Its callback for such checks costs the square of
// the length of an array.)
class ParseWatch final : public nlohmann::json_sax<json> {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override {
    members_.emplace_back();
    return enter();
  }
  bool key(string_t& key) override {
    if (!members_.back().insert(key).second)
      problem_ = "holds the member \"" + key + "\" twice in one object";
    return problem_.empty();
  }
  bool end_object() override {
    members_.pop_back();
    return leave();
  }
  bool start_array(std::size_t) override { return enter(); }
  bool end_array() override { return leave(); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
    return false;  // the parse itself says what
  }

  const std::string& problem() const { return problem_; }

 private:
  bool enter() {
    if (++depth_ > deepest) problem_ = "is nested deeper than " + std::to_string(deepest) + " levels";
    return problem_.empty();
  }
  bool leave() {
    --depth_;
    return true;
  }

  int depth_ = 0;
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
  json::sax_parse(text, &watch);
  if (!watch.problem().empty())
    return Error{ErrorCode::unreadable, name + ": " + printable(watch.problem()) + "."};
  try {
    return json::parse(text);
  } catch (const json::exception& exception) {
    return Error{ErrorCode::unreadable, name + ": is not JSON: " + printable(plain_message(exception)) + "."};
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
