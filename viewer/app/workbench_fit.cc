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

}  // namespace

Select Workbench::select_command(const Stroke& stroke) const {
  const Document& document = session_.document();
  Select select;
  const RegionEntry* focused = find_region(document, region_);
  const bool replaces_kept = stroke.mode == SelectMode::set && focused && patch_of(document, focused->id);
  select.region = focused && !replaces_kept ? focused->id : free_id(document, "region");
  select.scan = focused && !replaces_kept ? focused->scan
                : document.scans.empty()  ? std::string()
                                          : document.scans.back().id;
  select.mode = stroke.mode;
  select.polygon = stroke.polygon;
  select.camera = stroke.camera;
  return select;
}

Fit Workbench::fit_command(const std::string& region) const {
  Fit fit;
  fit.region = region;
  const PatchEntry* kept = patch_of(session_.document(), region);
  fit.patch = kept ? kept->id : free_id(session_.document(), "patch");
  fit.options.surface = choice_.surface;
  fit.options.robust = choice_.robust;
  return fit;
}

Workbench::Outcome Workbench::attempt(Document document, const std::optional<Select>& select, Fit fit,
                                      const Progress& progress) {
  Outcome outcome;
  outcome.document = std::move(document);
  if (select) {
    Command command = *select;
    Result<Document> selected = apply(outcome.document, command, with_progress(progress));
    if (!selected) return {std::move(outcome.document), std::nullopt, selected.error()};
    outcome.document = std::move(*selected);
  }
  const auto start = std::chrono::steady_clock::now();
  Command command = std::move(fit);
  Result<Document> fitted = apply(outcome.document, command, with_progress(progress));
  outcome.milliseconds =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  if (!fitted) {
    outcome.error = fitted.error();
    return outcome;
  }
  outcome.document = std::move(*fitted);
  outcome.fit = std::get<Fit>(command);
  return outcome;
}

// Taking away needs something to take from.
bool Workbench::can_select(const Stroke& stroke) const {
  const bool takes_away = stroke.mode == SelectMode::subtract || stroke.mode == SelectMode::intersect;
  return !session_.document().scans.empty() && (!takes_away || !region_.empty());
}

void Workbench::preview(const Stroke& stroke) {
  if (!can_select(stroke) || order_runs_) return;
  const Select select = select_command(stroke);
  currency_ = Currency::fitting;
  worker_.preview([this, select, fit = fit_command(select.region),
                   before = session_.document()](const Progress& progress) -> Worker::Finish {
    auto outcome = std::make_shared<Outcome>(attempt(before, select, fit, progress));
    return [this, outcome] { accept(std::move(*outcome), false); };
  });
}

void Workbench::drop_preview() {
  if (draft_ && !draft_->keepable) drop_draft();
  refit_open_region();
}

void Workbench::select(const Stroke& stroke) {
  enqueue([this, stroke] {
    if (!can_select(stroke)) {
      notices_.push_back(session_.document().scans.empty()
                             ? "There is no scan to select from; open one first."
                             : "Nothing is selected yet that could be taken away from.");
      return;
    }
    worker_.drop_previews();
    currency_ = Currency::fitting;
    order({},
          [this, command = Command(select_command(stroke)),
           before = session_.document()](const Progress& progress) mutable -> Worker::Finish {
            auto after = std::make_shared<Result<Document>>(apply(before, command, with_progress(progress)));
            return [this, command, after] {
              if (!*after) return report(after->error());
              const bool keep_wanted = keep_when_ready_;
              std::optional<Draft> shown = draft_;
              if (!record(command, std::move(**after))) return;
              draft_ = std::move(shown);  // until the fit of the recorded selection is there
              region_ = std::get<Select>(command).region;
              refit();
              keep_when_ready_ = keep_wanted;
            };
          });
  });
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
  worker_.preview_now([this, fit = fit_command(region_),
                       before = session_.document()](const Progress& progress) -> Worker::Finish {
    auto outcome = std::make_shared<Outcome>(attempt(before, std::nullopt, fit, progress));
    return [this, outcome] { accept(std::move(*outcome), true); };
  });
}

void Workbench::accept(Outcome outcome, bool keepable) {
  if (outcome.error && outcome.error->code == ErrorCode::cancelled) return;
  draft_ = Draft{std::move(outcome.document), std::move(outcome.fit), keepable};
  fit_milliseconds_ = outcome.milliseconds;
  currency_ = outcome.error ? Currency::failed : Currency::current;
  fit_message_ = outcome.error ? outcome.error->message : std::string();
  selection_ = draft_->fit ? draft_->fit->patch : region_;
  ++changes_;
  if (std::exchange(keep_when_ready_, false) && keepable) keep();
}

void Workbench::keep() {
  if (currency_ == Currency::fitting || !steps_.empty() || order_runs_) {
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
