// A journal as text: a header line, then one command a line of JSON.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/project/command.h"

namespace patchlab {

// Name and version of this program, as headers state them: "patchlab 0.1.0".
std::string program();

struct Journal {
  std::vector<Command> commands;  // command i stands on line i + 2
  std::size_t length = 0;         // bytes up to the end of the last whole line: what follows is torn
  bool open_line = false;         // the last whole line lacks its newline
};

// unreadable error with the number of the line that is wrong. A last line without its newline that is no
// whole JSON is torn and left out; a header so torn makes the journal empty (length 0).
Result<Journal> parse_journal(std::string_view text, const std::string& name);

// A command as its line. usage error for what JSON cannot hold: numbers that are not finite, names that are
// not UTF-8.
Result<std::string> journal_line(const Command& command);

// "mug.patchlab: line 4".
std::string line_of(const std::string& name, std::size_t command);

}  // namespace patchlab
