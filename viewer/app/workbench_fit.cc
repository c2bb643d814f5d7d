// The lasso of a workbench, and the fit that follows it.
#include <algorithm>
#include <chrono>
#include <utility>

#include "viewer/app/workbench.h"

namespace patchlab::viewer {

namespace {

const PatchEntry* patch_of(const Document& document, const std::string& region) {
  const auto found = std::find_if(document.patches.begin(), document.patches.end(),
                                  [&region](const PatchEntry& entry) { return entry.region == region; });
  return found == document.patches.end() ? nullptr : &*found;
}

// Of more points than `many`, about `few` are fitted first.
constexpr std::size_t many = 20'000, few = 5'000;

std::size_t one_in(const RegionEntry& region) {
  const std::size_t points = region.points->size();
  return points > many ? (points + few - 1) / few : 1;
}

using Ids = std::vector<std::uint32_t>;
std::shared_ptr<const Ids> thinned(const Ids& ids, std::size_t every) {
  auto some = std::make_shared<Ids>();
  for (std::size_t i = 0; i < ids.size(); i += every) some->push_back(ids[i]);
  return some;
}

RegionEntry& entry_of(Document& document, const std::string& region) {
  return *std::find_if(document.regions.begin(), document.regions.end(),
                       [&region](const RegionEntry& entry) { return entry.id == region; });
}

// What a new region is drawn on: the scan that was pointed at, or the newest one that is shown.
std::string scan_under(const Stroke& stroke, const Document& document) {
  if (!stroke.scan.empty()) return stroke.scan;
  const auto shown = std::find_if(document.scans.rbegin(), document.scans.rend(),
                                  [](const ScanEntry& entry) { return entry.visible; });
  return shown == document.scans.rend() ? std::string() : shown->id;
}

}  // namespace

Select Workbench::select_command(const Stroke& stroke) const {
  const Document& document = session_.document();
  Select select;
  const RegionEntry* focused = find_region(document, region_);
  const bool replaces_kept = stroke.mode == SelectMode::set && focused && patch_of(document, focused->id);
  const bool changes = focused && !replaces_kept;
  select.region = changes ? focused->id : free_id(document, "region");
  select.scan = changes ? focused->scan : scan_under(stroke, document);
  select.mode = stroke.mode;
  select.flood = stroke.surface_at;
  if (select.flood) return select;
  select.polygon = stroke.polygon;
  select.camera = stroke.camera;
  select.visible_only = stroke.visible_only;
  return select;
}

Fit Workbench::fit_command(const std::string& region) const {
  Fit fit;
  fit.region = region;
  const PatchEntry* kept = patch_of(session_.document(), region);
  fit.patch = kept ? kept->id : free_id(session_.document(), "patch");
  fit.options.surface = choice_.surface;
  fit.options.robust = choice_.robust;
  fit.options.boundary = choice_.boundary;
  return fit;
}

// The patch on the screen, where a lasso adds to its region or takes away and it is what is asked for: the
// next one is near it.
std::optional<Patch> Workbench::shown_fit(const Select& select) const {
  const PatchEntry* shown = patch_of(document(), select.region);
  const bool is_asked_for = shown && shown->fit && shown->options.surface == choice_.surface &&
                            shown->options.boundary == choice_.boundary &&
                            shown->options.robust == choice_.robust;
  if (select.mode == SelectMode::set || !is_asked_for) return std::nullopt;
  return shown->fit->patch;
}

ApplyOptions Workbench::applying(const Progress& progress) const {
  ApplyOptions options = with_progress(progress);
  options.visibility = visibility_;
  return options;
}

Workbench::Outcome Workbench::attempt(Document document, const std::optional<Select>& select, Fit fit,
                                      Points points, const ApplyOptions& how) const {
  Outcome outcome;
  outcome.document = std::move(document);
  if (select) {
    Command command = *select;
    Result<Document> selected = apply(outcome.document, command, how);
    if (!selected) return {std::move(outcome.document), std::nullopt, selected.error()};
    outcome.document = std::move(*selected);
  }
  RegionEntry& region = entry_of(outcome.document, fit.region);
  const std::shared_ptr<const Ids> all = region.points;
  if (points == Points::some) outcome.one_in = one_in(region);
  if (outcome.one_in > 1) region.points = thinned(*all, outcome.one_in);
  const auto start = std::chrono::steady_clock::now();
  Command command = std::move(fit);
  Result<Document> fitted = apply(outcome.document, command, how);
  outcome.milliseconds =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  if (fitted) {
    outcome.document = std::move(*fitted);
    outcome.fit = std::get<Fit>(command);
  } else {
    outcome.error = fitted.error();
  }
  entry_of(outcome.document, std::get<Fit>(command).region).points = all;
  return outcome;
}

std::optional<std::string> Workbench::refusal(const Stroke& stroke) const {
  const Document& document = session_.document();
  if (document.scans.empty()) return "There is no scan to select from; open one first.";
  const bool takes_away = stroke.mode == SelectMode::subtract || stroke.mode == SelectMode::intersect;
  if (takes_away && region_.empty()) return "Nothing is selected yet that could be taken away from.";
  const ScanEntry* scan = find_scan(document, select_command(stroke).scan);
  if (!scan || !scan->visible) return "The scan is hidden; show it to select from it.";
  return std::nullopt;
}

void Workbench::preview(const Stroke& stroke) {
  if (refusal(stroke) || order_runs_) return;
  const Select select = select_command(stroke);
  currency_ = Currency::fitting;
  fit_asked_ = std::chrono::steady_clock::now();
  worker_.preview([this, select, fit = fit_command(select.region), from = shown_fit(select),
                   before = session_.document()](const Progress& progress) -> Worker::Finish {
    ApplyOptions how = applying(progress);
    how.fit_from = from;
    auto outcome = std::make_shared<Outcome>(attempt(before, select, fit, Points::some, how));
    return [this, outcome] { accept(std::move(*outcome), false); };
  });
}

void Workbench::drop_preview() {
  if (draft_ && !draft_->keepable) drop_draft();
  refit_open_region();
}

void Workbench::select(const Stroke& stroke) {
  enqueue([this, stroke] {
    if (const std::optional<std::string> why = refusal(stroke)) {
      notices_.push_back(*why);
    } else {
      change({}, select_command(stroke));
    }
  });
}

void Workbench::reshape(Reshaping how) {
  enqueue([this, how] {
    if (region_.empty()) {
      notices_.push_back("No region is chosen that could be changed.");
      return;
    }
    change("changing the region", Reshape{region_, how});
  });
}

void Workbench::set_noise(const std::string& scan, const std::string& specification) {
  enqueue([this, scan, specification] { change("fitting again", SetNoise{scan, specification}); });
}

// Records what the command makes of the document; what is shown stays until the fit of it is there.
void Workbench::change(const std::string& name, Command wanted) {
  worker_.drop_previews();
  currency_ = Currency::fitting;
  order(name,
        [this, command = std::move(wanted),
         before = session_.document()](const Progress& progress) mutable -> Worker::Finish {
          auto after = std::make_shared<Result<Document>>(apply(before, command, applying(progress)));
          return [this, command, after] {
            const bool keep_wanted = keep_when_ready_;
            std::optional<Draft> shown = draft_;
            if (!*after) report(after->error());
            if (!*after || !record(command, std::move(**after))) {
              keep_when_ready_ = false;
              currency_ = draft_ ? Currency::current : Currency::nothing;
              return;
            }
            follow(command, std::move(shown));
            keep_when_ready_ = keep_wanted;
          };
        });
}

void Workbench::follow(const Command& command, std::optional<Draft> shown) {
  if (const Select* select = std::get_if<Select>(&command)) region_ = select->region;
  const bool kept_alone =
      std::holds_alternative<SetNoise>(command) && !shown;  // fitted by the command itself
  if (region_.empty() || kept_alone) return refit_open_region();
  draft_ = std::move(shown);
  refit();
}

void Workbench::focus(const std::string& id) {
  const PatchEntry* patch = find_patch(document(), id);
  const RegionEntry* region = find_region(document(), patch ? patch->region : id);
  const std::string focused = region ? region->id : std::string();
  if (focused == region_) return;
  drop_draft();
  region_ = find_region(session_.document(), focused) ? focused : std::string();
  refit_open_region();
}

void Workbench::choose(const FitChoice& choice) {
  choice_ = choice;
  if (!region_.empty()) refit();
}

// A region in focus that has no patch yet always shows its fit.
void Workbench::refit_open_region() {
  if (!region_.empty() && !patch_of(session_.document(), region_)) refit();
}

void Workbench::refit() {
  currency_ = Currency::fitting;
  keep_when_ready_ = false;
  fit_asked_ = std::chrono::steady_clock::now();
  worker_.drop_previews();
  const RegionEntry* region = find_region(session_.document(), region_);
  fit(region && one_in(*region) > 1 ? Points::some : Points::all);
}

void Workbench::fit(Points points) {
  worker_.preview([this, points, fit = fit_command(region_),
                   before = session_.document()](const Progress& progress) -> Worker::Finish {
    auto outcome = std::make_shared<Outcome>(attempt(before, std::nullopt, fit, points, applying(progress)));
    return [this, points, outcome] {
      accept(std::move(*outcome), points == Points::all);
      if (points == Points::some) this->fit(Points::all);
    };
  });
}

void Workbench::accept(Outcome outcome, bool keepable) {
  if (outcome.error && outcome.error->code == ErrorCode::cancelled) return;
  draft_ = Draft{std::move(outcome.document), std::move(outcome.fit), keepable};
  fit_milliseconds_ = outcome.milliseconds;
  fitted_one_in_ = outcome.one_in;
  currency_ = outcome.error ? Currency::failed : outcome.one_in > 1 ? Currency::preview : Currency::current;
  fit_message_ = outcome.error ? outcome.error->message : std::string();
  selection_ = draft_->fit ? draft_->fit->patch : region_;
  ++changes_;
  if (keepable && std::exchange(keep_when_ready_, false)) keep();
}

void Workbench::keep() {
  const bool not_yet = currency_ == Currency::fitting || currency_ == Currency::preview;
  if (not_yet || !steps_.empty() || order_runs_) {
    if (not_yet && !region_.empty() && worker_.idle()) refit();
    keep_when_ready_ = true;
    return;
  }
  if (!draft_ || !draft_->fit || !draft_->keepable) return;
  const Draft draft = *draft_;
  if (!record(*draft.fit, draft.document)) return;
  currency_ = Currency::current;
  selection_ = draft.fit->patch;
}

void Workbench::discard() { drop_draft(); }

}  // namespace patchlab::viewer
