#include "engine/project/journal.h"

#include <nlohmann/json.hpp>

#include "engine/io/json.h"
#include "engine/project/session.h"

namespace patchlab {
namespace {

using nlohmann::json;

constexpr std::string_view format = "patchlab.journal";
constexpr int version = 1;
constexpr std::string_view beginning = R"({"format":"patchlab.journal")";

json parse(std::string_view line) { return json::parse(line, nullptr, false); }

Error not_a_journal(const std::string& name) {
  return {ErrorCode::unreadable, name +
                                     ": is not a patchlab journal; its first line must be a header such as " +
                                     journal_header() + "."};
}

Result<void> check_header(std::string_view line, const std::string& name) {
  const json header = parse(line);
  if (!header.is_object() || !header.contains("format") || header["format"] != format)
    return not_a_journal(name);
  const bool numbered = header.contains("version") && header["version"].is_number_integer();
  if (!numbered || header["version"] < 1) return not_a_journal(name);
  if (header["version"] == version) return {};
  return Error{ErrorCode::unreadable, name + ": is a journal of version " + header["version"].dump() +
                                          ", and this program reads version " + std::to_string(version) +
                                          "; a newer patchlab wrote it."};
}

// What a program left that stopped while it wrote the header.
bool is_torn_header(std::string_view text) {
  const std::string_view head = text.substr(0, beginning.size());
  return text.find('\n') == std::string_view::npos && beginning.starts_with(head) &&
         parse(text).is_discarded();
}

}  // namespace

std::string program() { return "patchlab " PATCHLAB_VERSION; }

std::string journal_header() {
  return nlohmann::ordered_json{{"format", format}, {"version", version}, {"program", program()}}.dump();
}

Result<std::string> journal_line(const Command& command) {
  const nlohmann::ordered_json object = to_json(command);
  if (const std::string wrong = not_finite(object); !wrong.empty()) {
    return Error{ErrorCode::usage, "The command cannot be kept: " + wrong + "."};
  }
  try {
    return object.dump() + "\n";
  } catch (const json::exception&) {
    return Error{ErrorCode::usage, "The command cannot be kept: a name in it is not UTF-8 text."};
  }
}

std::string line_of(const std::string& name, std::size_t command) {
  return name + ": line " + std::to_string(command + 2);
}

Result<Journal> parse_journal(std::string_view text, const std::string& name) {
  Journal journal;
  if (is_torn_header(text)) return journal;
  for (bool header = true; journal.length < text.size(); header = false) {
    const std::string_view rest = text.substr(journal.length);
    const std::size_t end = rest.find('\n');
    const std::string_view line = rest.substr(0, end);
    journal.open_line = end == std::string_view::npos;
    if (header) {
      const Result<void> checked = check_header(line, name);
      if (!checked) return checked.error();
    } else {
      if (journal.open_line && parse(line).is_discarded()) {
        journal.open_line = false;
        break;
      }
      const std::string where = line_of(name, journal.commands.size());
      const Result<json> object = parse_json(line, where);
      if (!object) return object.error();
      Result<Command> command = command_from_json(*object, where);
      if (!command) return command.error();
      journal.commands.push_back(std::move(*command));
    }
    journal.length += line.size() + (journal.open_line ? 0 : 1);
  }
  return journal;
}

Result<std::vector<Command>> read_journal(std::string_view text, const std::string& name) {
  Result<Journal> journal = parse_journal(text, name);
  if (!journal) return journal.error();
  if (journal->length == 0) return not_a_journal(name);
  return std::move(journal->commands);
}

}  // namespace patchlab
