// The files of a workbench: scans and journals in, patches and journals out.
#include <algorithm>
#include <iterator>

#include "engine/io/glimpse.h"
#include "engine/io/scan_size.h"
#include "viewer/app/journal_file.h"
#include "viewer/app/workbench.h"
#include "viewer/panel/numbers.h"

namespace patchlab::viewer {
namespace {

// With what it will take, where the head of the file tells.
std::string opening(const std::filesystem::path& file) {
  const std::string words = "opening " + file.filename().string();
  const std::optional<ScanSize> size = foresee_scan(file);
  return size ? words + ": " + count(size->points) + " points, " + size_words(size->bytes) + " of memory"
              : words;
}

std::string whole(const std::filesystem::path& file) {
  return std::filesystem::absolute(file).lexically_normal().string();
}

OpenScan scan_command(const std::filesystem::path& file, const ScanWishes& wishes) {
  OpenScan command;
  command.file = whole(file);
  command.unit = wishes.unit;
  command.intrinsics = wishes.intrinsics;
  command.depth_scale = wishes.depth_scale;
  return command;
}

// walker.urdf, with walker.joints.json or .csv and walker.patches.json where they lie beside it.
OpenRobot robot_command(const std::filesystem::path& file) {
  OpenRobot command;
  command.file = whole(file);
  const auto beside = [&](const char* ending) {
    const std::filesystem::path other = std::filesystem::path(command.file).replace_extension(ending);
    std::error_code ignored;
    return std::filesystem::exists(other, ignored) ? other.string() : std::string();
  };
  command.joints = beside(".joints.json");
  if (command.joints.empty()) command.joints = beside(".joints.csv");
  command.patches = beside(".patches.json");
  return command;
}

std::vector<std::string> notices_of(const Document& document, const std::string& id) {
  const ScanEntry* scan = find_scan(document, id);
  if (scan && scan->scan) return scan->scan->notices;
  const RobotEntry* robot = find_robot(document, id);
  return robot ? robot->model->notices : std::vector<std::string>();
}

}  // namespace

void Workbench::open(const std::filesystem::path& file, const ScanWishes& wishes) {
  enqueue([this, file, wishes] {
    const std::string kind = file.extension().string();
    const Document& document = session_.document();
    if (kind == ".patchlab") return open_journal(file);
    if (kind == ".urdf") {
      OpenRobot command = robot_command(file);
      command.id = free_id(document, "robot");
      return open_with(command, file, command.id);
    }
    if (kind == ".json") {
      const std::string id = free_id(document, "map");
      return open_with(OpenMap{.id = id, .file = whole(file)}, file, id);
    }
    OpenScan command = scan_command(file, wishes);
    command.id = free_id(document, "scan");
    open_scan(command, file);
  });
}

// A journal is gone on with in the program's own folder: one from elsewhere is another's work, or a file
// under version control, and is copied there first.
Result<Session> Workbench::begin_session(const std::filesystem::path& file, const Progress& progress) const {
  if (!options_.keep_journals) return replayed_session(file, progress);
  if (lies_in(file, options_.journals)) return Session::open(file, with_progress(progress));
  const Result<std::filesystem::path> copy = new_journal_path(options_.journals, file);
  if (!copy) return copy.error();
  if (const Result<void> copied = copy_journal(file, *copy); !copied) return copied.error();
  Result<Session> session = Session::open(*copy, with_progress(progress));
  std::error_code ignored;
  if (!session) std::filesystem::remove(*copy, ignored);
  return session;
}

void Workbench::open_journal(const std::filesystem::path& file) {
  order("opening " + file.filename().string(), [this, file](const Progress& progress) -> Worker::Finish {
    auto opened = std::make_shared<Result<Session>>(begin_session(file, progress));
    return [this, file, opened] {
      if (!*opened) return report(opened->error());
      session_ = std::move(**opened);
      if (options_.keep_journals && session_.journal() != file) {
        notices_.push_back(file.filename().string() + " stays as it is; what you do is saved in " +
                           session_.journal().string() + ".");
      }
      if (const auto notice = notice_of_other_results(session_.document())) notices_.push_back(*notice);
      region_.clear();
      shown_journal_ = options_.keep_journals ? std::filesystem::path() : file;
      after_change();
      const Document& document = session_.document();
      if (!document.patches.empty()) focus(document.patches.back().id);
      selection_ = !document.patches.empty() ? document.patches.back().id
                   : !document.scans.empty() ? document.scans.back().id
                                             : std::string();
    };
  });
}

void Workbench::open_with(Command command, const std::filesystem::path& file, const std::string& id) {
  order(opening(file),
        [this, command, file, id, before = session_.document()](const Progress& progress) -> Worker::Finish {
          Command wanted = command;
          auto after = std::make_shared<Result<Document>>(apply(before, wanted, with_progress(progress)));
          return [this, wanted, after, file, id] {
            if (*after) return record_opened(wanted, std::move(**after), file, id);
            report(after->error());
            if (!shows_glimpse()) return;
            drop_draft();
            refit_open_region();
          };
        });
}

void Workbench::open_scan(const OpenScan& command, const std::filesystem::path& file) {
  order(opening(file), [this, command, file](const Progress& progress) -> Worker::Finish {
    auto first = std::make_shared<std::optional<Scan>>(glimpse_scan(command.file, {.unit = command.unit}));
    if (!keep_going(progress, 0.0)) return {};
    return [this, command, file, first] {
      if (*first) show_glimpse(command, std::move(**first));
      open_with(command, file, command.id);
    };
  });
}

// Of the scan that is being read, under the id that it will have; gone when all of it is there.
void Workbench::show_glimpse(const OpenScan& command, Scan scan) {
  drop_draft();
  const std::string name = std::filesystem::path(command.file).filename().string() + ", opening";
  const NoiseModel noise = default_noise_model(scan);
  draft_ = Draft{session_.document(), std::nullopt, false, true};
  draft_->document.scans.push_back(
      {command.id, name, {}, std::make_shared<const Scan>(std::move(scan)), noise, true});
}

void Workbench::record_opened(Command command, Document after, const std::filesystem::path& file,
                              const std::string& id) {
  if (options_.keep_journals && session_.journal().empty()) {
    if (const Result<void> begun = begin_journal(file); !begun) {
      report(begun.error());
      notices_.push_back("Nothing is being saved: the journal cannot be written.");
    }
    tell_of_earlier_work(file);
  }
  for (std::string* named : files_of(command)) *named = session_.scan_file(*named);
  std::ranges::copy(notices_of(after, id), std::back_inserter(notices_));
  if (record(command, std::move(after))) selection_ = id;
}

void Workbench::tell_of_earlier_work(const std::filesystem::path& scan) {
  for (const EarlierWork& work : earlier_work(options_.journals, 20)) {
    if (work.scan != scan.stem()) continue;
    notices_.push_back("There is earlier work on " + work.scan + " (" + work.remark + "): File, Go on with " +
                       work.scan + ".");
    return;
  }
}

Result<void> Workbench::begin_journal(const std::filesystem::path& scan) {
  const Result<std::filesystem::path> journal = new_journal_path(options_.journals, scan);
  if (!journal) return journal.error();
  Result<Session> session = Session::open(*journal);
  if (!session) return session.error();
  session_ = std::move(*session);
  return {};
}

void Workbench::write_patches(const ExportRequest& request) {
  enqueue([this, request] {
    order("exporting",
          [this, request, document = session_.document(),
           journal = journal()](const Progress&) -> Worker::Finish {
            const Result<void> written = export_patches(document, journal, request);
            return [this, written, request] {
              if (!written) return report(written.error());
              notices_.push_back("The patches are in " + request.file.string() + ".");
            };
          });
  });
}

void Workbench::save_journal(const std::filesystem::path& file) {
  enqueue([this, file] {
    if (const Result<void> copied = copy_journal(session_.journal(), file); !copied)
      return report(copied.error());
    notices_.push_back("A copy of the journal is in " + file.string() + ".");
  });
}

}  // namespace patchlab::viewer
