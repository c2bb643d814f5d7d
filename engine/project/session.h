// A document with its past and its journal: apply, undo, redo, save as it happens.
//
// The journal is one header line and one command a line of JSON. A command is acknowledged when its line is
// appended and fsynced; only then does the document change for the viewer. A torn last line is dropped when a
// journal is read.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/project/command.h"
#include "engine/project/document.h"

namespace patchlab {

class Session {
 public:
  Session();  // without a file: nothing is kept
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;
  ~Session();

  // Continues a journal: replays it, cuts off a torn last line, then appends. Creates it where it does not
  // exist. A second program that opens it is told (refused error). Nothing is changed in a file that is no
  // journal or cannot be replayed.
  static Result<Session> open(const std::filesystem::path& journal, const ApplyOptions& options = {});

  // Runs a command (Undo and Redo too), appends it to the journal, then shows it. On an error nothing has
  // changed.
  Result<void> run(Command command, const ApplyOptions& options = {});
  // The second half of run(), for work off the UI thread: apply() of engine/project/command.h is the first
  // and gives `after` from document(), with in_folder() options. For Undo and Redo `after` is not looked at.
  Result<void> record(const Command& command, Document after);

  const Document& document() const;
  bool can_undo() const;
  bool can_redo() const;
  // What was done, oldest first, and how much of it stands (the rest can be redone).
  const std::vector<std::string>& history() const;
  std::size_t position() const;
  const std::filesystem::path& journal() const;  // empty where there is none

  // The options with the journal's folder filled in where none is given.
  ApplyOptions in_folder(ApplyOptions options = {}) const;
  // How a scan file that the user named is written in this journal: relative to its folder.
  std::string scan_file(const std::filesystem::path& file) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// The commands of a journal file. A bad line before the last is an error with its number.
Result<std::vector<Command>> read_journal(std::string_view text, const std::string& name);
std::string journal_header();

// Replays a journal without writing anything. Of a fit whose hash differs from the recorded one the new
// result stands, and the patch says so (differs_from_record).
Result<Document> replay(const std::filesystem::path& journal, const ApplyOptions& options = {});

}  // namespace patchlab
