// The files of a workbench: scans and journals in, patches and journals out.
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

}  // namespace

void Workbench::open(const std::filesystem::path& file, const ScanWishes& wishes) {
  enqueue([this, file, wishes] {
    file.extension() == ".patchlab" ? open_journal(file) : open_scan(file, wishes);
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

void Workbench::open_scan(const std::filesystem::path& file, const ScanWishes& wishes) {
  OpenScan command;
  command.id = free_id(session_.document(), "scan");
  command.file = std::filesystem::absolute(file).lexically_normal().string();
  command.unit = wishes.unit;
  command.intrinsics = wishes.intrinsics;
  command.depth_scale = wishes.depth_scale;
  const std::string words = opening(file);
  order(words, [this, command, words](const Progress& progress) -> Worker::Finish {
    auto first = std::make_shared<std::optional<Scan>>(glimpse_scan(command.file, {.unit = command.unit}));
    if (!keep_going(progress, 0.0)) return {};
    return [this, command, words, first] {
      if (*first) show_glimpse(command, std::move(**first));
      read_whole(words, command);
    };
  });
}

void Workbench::read_whole(const std::string& words, const OpenScan& command) {
  order(words, [this, command, before = session_.document()](const Progress& progress) -> Worker::Finish {
    Command wanted = command;
    auto after = std::make_shared<Result<Document>>(apply(before, wanted, with_progress(progress)));
    return [this, wanted, after] {
      if (*after) return record_scan(std::get<OpenScan>(wanted), std::move(**after));
      report(after->error());
      if (!shows_glimpse()) return;
      drop_draft();
      refit_open_region();
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

void Workbench::record_scan(OpenScan command, Document after) {
  if (options_.keep_journals && session_.journal().empty()) {
    if (const Result<void> begun = begin_journal(command.file); !begun) {
      report(begun.error());
      notices_.push_back("Nothing is being saved: the journal cannot be written.");
    }
    tell_of_earlier_work(command.file);
  }
  command.file = session_.scan_file(command.file);
  const std::string id = command.id;
  for (const ScanEntry& entry : after.scans) {
    if (entry.id != id || !entry.scan) continue;
    notices_.insert(notices_.end(), entry.scan->notices.begin(), entry.scan->notices.end());
  }
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
            const Result<void> written = export_patches(document, journal, request.format, request.file);
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
