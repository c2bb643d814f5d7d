#include "viewer/app/journal_file.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>

#include "engine/base/file.h"
#include "engine/export/export.h"
#include "engine/project/measured_points.h"

namespace patchlab::viewer {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view stamp_shape = "-20260102-140211";

std::string written(std::time_t time, const char* format) {
  std::tm local{};
  localtime_r(&time, &local);
  char text[32];
  std::strftime(text, sizeof text, format, &local);
  return text;
}

std::string time_stamp() { return written(std::time(nullptr), "%Y%m%d-%H%M%S"); }

// What new_journal_path() made the name of: "bench" of "bench-20260102-140211-2.patchlab".
std::string scan_of(const fs::path& journal) {
  const std::string stem = journal.stem().string();
  const auto is_stamp = [&stem](std::size_t at) {
    return std::equal(stamp_shape.begin(), stamp_shape.end(), stem.begin() + static_cast<std::ptrdiff_t>(at),
                      [](char shape, char c) { return shape == '-' ? c == '-' : c >= '0' && c <= '9'; });
  };
  for (std::size_t at = 0; at + stamp_shape.size() <= stem.size(); ++at) {
    if (is_stamp(at)) return stem.substr(0, at);
  }
  return stem;
}

struct Written {
  fs::path file;
  fs::file_time_type time;
};

std::vector<Written> newest_journals(const fs::path& folder) {
  std::vector<Written> journals;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code gone;
    const fs::file_time_type time = entry->last_write_time(gone);
    if (!gone && entry->path().extension() == ".patchlab") journals.push_back({entry->path(), time});
  }
  std::sort(journals.begin(), journals.end(),
            [](const Written& a, const Written& b) { return a.time > b.time; });
  return journals;
}

// Lines of commands: what was done in it.
std::size_t steps_in(const fs::path& journal) {
  const Result<Bytes> bytes = read_file(journal);
  if (!bytes) return 0;
  const std::string_view text = as_text(*bytes);
  const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  return lines > 0 ? lines - 1 : 0;
}

Result<std::vector<Command>> commands_of(const fs::path& journal) {
  const Result<Bytes> bytes = read_file(journal);
  if (!bytes) return bytes.error();
  return read_journal(as_text(*bytes), journal.string());
}

}  // namespace

fs::path default_journal_folder() {
  const char* state = std::getenv("XDG_STATE_HOME");
  if (state && *state) return fs::path(state) / "patchlab";
  const char* home = std::getenv("HOME");
  return fs::path(home ? home : ".") / ".local" / "state" / "patchlab";
}

Result<fs::path> new_journal_path(const fs::path& folder, const fs::path& scan) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    return Error{ErrorCode::unwritable, "The folder for journals " + folder.string() +
                                            " cannot be made: " + error.message() +
                                            "; set XDG_STATE_HOME to a folder that can be written."};
  }
  const std::string stem = scan.stem().string() + "-" + time_stamp();
  fs::path journal = folder / (stem + ".patchlab");
  for (int next = 2; fs::exists(journal, error); ++next) {
    journal = folder / (stem + "-" + std::to_string(next) + ".patchlab");
  }
  return journal;
}

std::vector<EarlierWork> earlier_work(const fs::path& folder, std::size_t most) {
  std::vector<EarlierWork> works;
  for (const Written& journal : newest_journals(folder)) {
    if (works.size() == most) break;
    const std::size_t steps = steps_in(journal.file);
    if (steps < 2) continue;  // a scan was opened, and nothing done
    const auto time = std::chrono::file_clock::to_sys(journal.time);
    const std::time_t seconds =
        std::chrono::system_clock::to_time_t(std::chrono::time_point_cast<std::chrono::seconds>(time));
    works.push_back({journal.file, scan_of(journal.file),
                     std::to_string(steps) + " steps, " + written(seconds, "%-d %b %H:%M")});
  }
  return works;
}

bool lies_in(const fs::path& file, const fs::path& folder) {
  std::error_code error;
  const fs::path parent = fs::absolute(file).parent_path();
  return fs::equivalent(parent, folder, error) && !error;
}

std::string path_for_journal(const fs::path& scan, const fs::path& journal) {
  const fs::path absolute = fs::absolute(scan).lexically_normal();
  if (journal.empty()) return absolute.string();
  return absolute.lexically_relative(fs::absolute(journal).lexically_normal().parent_path()).string();
}

Result<void> copy_journal(const fs::path& journal, const fs::path& copy) {
  const Result<std::vector<Command>> commands = commands_of(journal);
  if (!commands) return commands.error();
  std::string text = journal_header() + "\n";
  for (Command command : *commands) {
    for (std::string* file : files_of(command)) *file = path_for_journal(journal.parent_path() / *file, copy);
    text += to_json(command).dump() + "\n";
  }
  return write_file(copy, text);
}

Result<Session> replayed_session(const fs::path& journal, const Progress& progress) {
  const Result<std::vector<Command>> commands = commands_of(journal);
  if (!commands) return commands.error();
  ApplyOptions options;
  options.folder = journal.parent_path();
  options.progress = progress;
  Session session;
  for (const Command& command : *commands) {
    const Result<void> done = session.run(command, options);
    if (!done) return done.error();
  }
  return session;
}

std::optional<ViewCamera> last_lasso_camera(const fs::path& journal) {
  const Result<std::vector<Command>> commands = commands_of(journal);
  if (!commands) return std::nullopt;
  for (auto command = commands->rbegin(); command != commands->rend(); ++command) {
    const Select* select = std::get_if<Select>(&*command);
    if (select && !select->polygon.empty()) return select->camera;
  }
  return std::nullopt;
}

Result<void> export_patches(const Document& document, const fs::path& journal, const ExportRequest& request) {
  const Result<const ExportFormat*> chosen = export_format(request.format);
  if (!chosen) return chosen.error();
  const PatchSet set = set_to_export(document, request.chosen, journal.filename().string());
  const Result<Exported> exported =
      patchlab::export_patches(**chosen, set, {.measured = measured_points(document)});
  if (!exported) return exported.error();
  return write_exported(*exported, request.file);
}

}  // namespace patchlab::viewer
