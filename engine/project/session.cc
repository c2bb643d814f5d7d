#include "engine/project/session.h"

#include <optional>

#include "engine/base/file.h"
#include "engine/project/history.h"
#include "engine/project/journal.h"
#include "engine/project/journal_file.h"

namespace patchlab {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& journal) { return journal == "-" ? fs::path() : journal.parent_path(); }

Result<void> replay_into(History& history, std::vector<Command>& commands, const std::string& name,
                         const ApplyOptions& options) {
  for (std::size_t i = 0; i < commands.size(); ++i) {
    Result<Document> after = history.after(commands[i], options);
    if (!after) {
      const ErrorCode code =
          after.error().code == ErrorCode::usage ? ErrorCode::unreadable : after.error().code;
      return Error{code, line_of(name, i) + ": " + after.error().message};
    }
    history.keep(commands[i], std::move(*after));
  }
  return {};
}

// Cuts off what is torn, and completes the header or the last line.
Result<void> mend(JournalFile& file, const Journal& journal) {
  const Result<void> cut = file.truncate(journal.length);
  if (!cut) return cut;
  if (journal.length == 0) return file.append(journal_header() + "\n");
  return journal.open_line ? file.append("\n") : Result<void>{};
}

}  // namespace

struct Session::State {
  History history;
  std::optional<JournalFile> file;
  fs::path journal;
};

Session::Session() : state_(std::make_unique<State>()) {}
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

Result<Session> Session::open(const fs::path& journal, const ApplyOptions& options) {
  Result<JournalFile> file = JournalFile::open(journal);
  if (!file) return file.error();
  const Result<std::string> text = file->read();
  if (!text) return text.error();
  Result<Journal> parsed = parse_journal(*text, journal.string());
  if (!parsed) return parsed.error();
  Session session;
  session.state_->journal = journal;
  const Result<void> replayed =
      replay_into(session.state_->history, parsed->commands, journal.string(), session.in_folder(options));
  if (!replayed) return replayed.error();
  const Result<void> mended = mend(*file, *parsed);
  if (!mended) return mended.error();
  session.state_->file = std::move(*file);
  return session;
}

Result<void> Session::run(Command command, const ApplyOptions& options) {
  Result<Document> after = state_->history.after(command, in_folder(options));
  if (!after) return after.error();
  return record(command, std::move(*after));
}

Result<void> Session::record(const Command& command, Document after) {
  if (state_->file) {
    const Result<std::string> line = journal_line(command);
    if (!line) return line.error();
    const Result<void> appended = state_->file->append(*line);
    if (!appended) return appended;
  }
  state_->history.keep(command, std::move(after));
  return {};
}

const Document& Session::document() const { return state_->history.document(); }
bool Session::can_undo() const { return state_->history.can_undo(); }
bool Session::can_redo() const { return state_->history.can_redo(); }
const std::vector<std::string>& Session::history() const { return state_->history.labels(); }
std::size_t Session::position() const { return state_->history.position(); }
const fs::path& Session::journal() const { return state_->journal; }

ApplyOptions Session::in_folder(ApplyOptions options) const {
  if (options.folder.empty()) options.folder = folder_of(state_->journal);
  return options;
}

std::string Session::scan_file(const fs::path& file) const {
  if (state_->journal.empty() || file == "-") return file.string();
  std::error_code failed;
  const fs::path folder = fs::weakly_canonical(fs::absolute(state_->journal), failed).parent_path();
  const fs::path relative = fs::proximate(fs::weakly_canonical(fs::absolute(file), failed), folder, failed);
  return failed ? file.string() : relative.string();
}

Result<Document> replay(const fs::path& journal, const ApplyOptions& options) {
  const std::string name = journal == "-" ? "standard input" : journal.string();
  const Result<Bytes> text = read_file(journal);
  if (!text) return text.error();
  Result<std::vector<Command>> commands = read_journal(as_text(*text), name);
  if (!commands) return commands.error();
  ApplyOptions here = options;
  if (here.folder.empty()) here.folder = folder_of(journal);
  History history;
  const Result<void> replayed = replay_into(history, *commands, name, here);
  if (!replayed) return replayed.error();
  return history.document();
}

}  // namespace patchlab
