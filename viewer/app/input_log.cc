#include "viewer/app/input_log.h"

#include <optional>
#include <sstream>

#include "viewer/panel/actions.h"
#include "viewer/platform/key.h"

namespace patchlab::viewer {

namespace {

std::optional<int> modifier_key(const std::string& word) {
  if (word == "Shift") return key::left_shift;
  if (word == "Ctrl") return key::left_control;
  if (word == "Alt") return key::left_alt;
  return std::nullopt;
}

std::optional<int> plain_key(const std::string& word) {
  for (const ActionRow& action : action_table())
    if (action.key != 0 && key_name(action.key) == word) return action.key;
  if (word == "Up") return key::up;
  if (word == "Down") return key::down;
  if (word.size() == 1) return word[0];
  return std::nullopt;
}

// "Shift+Ctrl+Z" or "Shift": true where every part is known.
bool parse_keys(const std::string& text, LogEvent& event) {
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, '+');) {
    const std::optional<int> modifier = modifier_key(part);
    const std::optional<int> key = modifier ? modifier : plain_key(part);
    if (!key) return false;
    event.keys.push_back(*key);
  }
  return !event.keys.empty();
}

bool parse_button(const std::string& text, LogEvent& event) {
  const char* names[] = {"left", "right", "middle"};
  for (int i = 0; i < 3; ++i) {
    if (text != names[i]) continue;
    event.button = i;
    return true;
  }
  return false;
}

bool parse_places(const std::string& text, std::size_t least, LogEvent& event) {
  std::istringstream numbers(text);
  for (float x, y; numbers >> x >> y;) event.places.emplace_back(x, y);
  return numbers.eof() && event.places.size() >= least;
}

bool parse_event(const std::string& verb, const std::string& rest, LogEvent& event) {
  using Kind = LogEvent::Kind;
  const auto is = [&](const char* word, Kind kind) {
    event.kind = kind;
    return verb == word;
  };
  if (is("wait", Kind::wait)) return rest.empty();
  if (is("move", Kind::move)) return parse_places(rest, 1, event);
  if (is("drag", Kind::drag)) return parse_places(rest, 2, event);
  if (is("press", Kind::press) || is("release", Kind::release)) return parse_button(rest, event);
  if (is("key", Kind::key)) return parse_keys(rest, event);
  if (is("hold", Kind::hold)) return rest == "nothing" || parse_keys(rest, event);
  if (is("wheel", Kind::wheel)) return static_cast<bool>(std::istringstream(rest) >> event.notches);
  event.text = rest;
  if (is("type", Kind::type)) return !rest.empty();
  if (is("click", Kind::click) && parse_places(rest, 1, event)) return true;
  event.places.clear();
  return is("click", Kind::click_widget) && !rest.empty();
}

}  // namespace

Result<std::vector<LogEvent>> parse_input_log(std::string_view text, const std::string& name) {
  std::vector<LogEvent> events;
  std::istringstream lines{std::string(text)};
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.empty() || line[0] == '#') continue;
    const std::size_t space = line.find(' ');
    const std::string verb = line.substr(0, space);
    LogEvent event{};
    event.line = number;
    if (!parse_event(verb, space == std::string::npos ? "" : line.substr(space + 1), event)) {
      return Error{ErrorCode::unreadable, name + ", line " + std::to_string(number) + ": \"" + line +
                                              "\" is no event of an input log."};
    }
    events.push_back(std::move(event));
  }
  return events;
}

}  // namespace patchlab::viewer
