#include "viewer/app/app.h"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <utility>

#include "viewer/app/boxes.h"
#include "viewer/app/journal_file.h"
#include "viewer/app/point_shades.h"
#include "viewer/panel/numbers.h"

namespace patchlab::viewer {

namespace {

constexpr double notice_seconds = 5.0, error_seconds = 12.0;
constexpr std::size_t most_earlier_work = 8;
constexpr double idle_patience = 30.0, caret_patience = 0.3, work_patience = 0.1;  // s

std::string time_of_day() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char text[16];
  std::strftime(text, sizeof text, "%H:%M:%S", &local);
  return text;
}

// With the home folder as "~".
std::string short_path(const std::filesystem::path& path) {
  const char* home = std::getenv("HOME");
  const std::string text = path.string(), start = std::string(home ? home : "") + "/";
  return start.size() > 1 && text.starts_with(start) ? "~/" + text.substr(start.size()) : text;
}

bool exists(const Document& document, const std::string& id) {
  return is_taken(document, id) || find_placed(document, id);
}

std::string newest(const Document& document) {
  if (!document.patches.empty()) return document.patches.back().id;
  if (!document.regions.empty()) return document.regions.back().id;
  if (!document.scans.empty()) return document.scans.back().id;
  if (!document.robots.empty()) return document.robots.back().id;
  return document.maps.empty() ? std::string() : document.maps.back().id;
}

std::string title_of(const Document& document) {
  if (!document.scans.empty()) return document.scans.back().name + " - patchlab";
  if (!document.robots.empty()) return document.robots.back().name + " - patchlab";
  return document.maps.empty() ? "patchlab" : document.maps.back().name + " - patchlab";
}

}  // namespace

App::App(Platform& platform, Renderer renderer, AppOptions options)
    : platform_(platform),
      renderer_(std::move(renderer)),
      options_(std::move(options)),
      workbench_({options_.journals, options_.keep_journals}, [&platform] { platform.wake(); }) {
  const Settings& settings = options_.settings;
  state_.theme = settings.theme;
  state_.point_size = settings.point_size;
  state_.visible_only = settings.visible_only;
  state_.robust = settings.robust;
  state_.layers = settings.layers;
  state_.map = settings.map;
  state_.widths = settings.widths;
  stage_.camera.perspective = state_.perspective = settings.perspective;
  chosen_scale_ = settings.scale;
  workbench_.choose({state_.surface, state_.robust, state_.boundary});
  find_earlier_work();
  platform_.on_drop([this](const std::vector<std::string>& files) {
    for (const std::string& file : files) open(file);
  });
}

Settings App::settings() const {
  return {state_.theme,       chosen_scale_, state_.point_size, state_.visible_only, state_.robust,
          state_.perspective, state_.layers, state_.map,        state_.widths};
}

void App::open(const std::filesystem::path& file, const ScanWishes& wishes) {
  journal_to_show_ = file.extension() == ".patchlab" ? std::optional(file) : std::nullopt;
  asked_for_ = file;
  workbench_.open(file, wishes);
}

// A reader that needs more than the file says names the flag of the command line; here the user is asked.
bool App::ask_what_is_missing(const Error& error) {
  const bool asks = options_.asks && !memory_.scan_form.is_open() &&
                    error.message.find("--intrinsics") != std::string::npos;
  if (asks)
    memory_.scan_form.ask_camera(asked_for_, error.message.substr(0, error.message.find("; give")) + ".");
  return asks;
}

// All but what is open.
void App::find_earlier_work() {
  if (!options_.keep_journals) return;
  state_.earlier = earlier_work(options_.journals, most_earlier_work);
  std::erase_if(state_.earlier,
                [this](const EarlierWork& work) { return work.journal == workbench_.session().journal(); });
}

double App::aspect() const { return layout_.view.width / std::max(1.0f, layout_.view.height); }

ViewCamera App::view() const {
  return view_camera(stage_.camera, std::max(1, static_cast<int>(layout_.view.width)),
                     std::max(1, static_cast<int>(layout_.view.height)), state_.slab);
}

void App::toast(const std::string& text, bool is_error) {
  state_.toasts.push_back({text, is_error, ImGui::GetTime() + (is_error ? error_seconds : notice_seconds)});
  state_.messages.push_back(state_.toasts.back());
}

void App::collect() {
  workbench_.deliver();
  for (const Error& error : workbench_.take_errors()) {
    errors_.push_back(error);
    if (!ask_what_is_missing(error)) toast(error.message, true);
  }
  for (const std::string& notice : workbench_.take_notices()) toast(notice, false);
  std::erase_if(state_.toasts, [](const Toast& shown) { return shown.until < ImGui::GetTime(); });
  if (const std::optional<std::string> selection = workbench_.take_selection()) state_.selected = *selection;
  state_.draft = workbench_.draft_patch();
  state_.currency = workbench_.currency();
  state_.fit_message = workbench_.fit_message();
  state_.fit_milliseconds = workbench_.fit_milliseconds();
  state_.fitted_one_in = workbench_.fitted_one_in();
  state_.fit_runs = workbench_.fit_runs();
  state_.busy = workbench_.busy();
  if (workbench_.changes() != seen_changes_) show_new_document();
  answer_questions();
  propose();
}

void App::show_new_document() {
  seen_changes_ = workbench_.changes();
  const Session& session = workbench_.session();
  if (session.history() != state_.history || session.position() != state_.position) {
    state_.history = session.history();
    state_.position = session.position();
    if (!session.journal().empty()) state_.saved = "saved " + time_of_day();
  }
  state_.can_undo = session.can_undo();
  state_.can_redo = session.can_redo();
  const std::string journal = short_path(session.journal());
  if (std::exchange(state_.journal, journal) != journal) find_earlier_work();
  const Document& document = workbench_.document();
  if (!exists(document, state_.selected)) state_.selected = newest(document);
  platform_.set_title(title_of(document));
  if (!workbench_.shows_glimpse()) {
    make_shades();
    ask_for_unit();
  }
  if (!document.scans.empty() && camera_of_ != document.scans.back().scan) set_up_camera();
  const bool has_no_scan = document.scans.empty() && box_of(document);
  if (has_no_scan && !looks_at_all_) {
    stage_.oblique_view(document, aspect());
    stage_.settle();
  }
  looks_at_all_ = has_no_scan;
}

void App::set_up_camera() {
  const Document& document = workbench_.document();
  camera_of_ = document.scans.back().scan;
  const std::optional<OrbitCamera> glimpsed_from = std::exchange(glimpsed_from_, std::nullopt);
  if (glimpsed_from && stage_.camera != *glimpsed_from) return;  // turned by the user since
  view_of_sensor();
  stage_.settle();
  if (workbench_.shows_glimpse()) glimpsed_from_ = stage_.camera;
  if (!journal_to_show_) return;
  if (const std::optional<ViewCamera> camera = last_lasso_camera(*journal_to_show_);
      camera && !document.patches.empty()) {
    stage_.look_along(*camera, document, document.patches.back().id, aspect());
  }
  journal_to_show_.reset();
}

void App::make_shades() {
  for (const ScanEntry& entry : workbench_.document().scans) {
    if (!entry.scan || stage_.has_shades(entry.scan)) continue;
    stage_.set_shades(entry.scan, nullptr);
    workbench_.in_background([this, scan = entry.scan] {
      auto shades = std::make_shared<const std::vector<std::uint8_t>>(point_shades(*scan));
      return [this, scan, shades] { stage_.set_shades(scan, shades); };
    });
  }
}

// Once, of a scan that has just been opened.
void App::ask_for_unit() {
  if (!options_.asks || asked_for_.empty() || workbench_.document().scans.empty()) return;
  const ScanEntry& entry = workbench_.document().scans.back();
  if (!entry.scan || entry.scan->file != asked_for_) return;
  for (const std::string& notice : entry.scan->notices) {
    const std::size_t flag = notice.find(" Then say --unit");
    if (flag != std::string::npos) memory_.scan_form.ask_unit(asked_for_, notice.substr(0, flag), entry.id);
  }
  asked_for_.clear();
}

void App::make_sigmas() {
  if (state_.colours != PointColours::noise || workbench_.shows_glimpse()) return;
  for (const ScanEntry& entry : workbench_.document().scans) {
    if (!entry.scan || stage_.has_sigmas(entry)) continue;
    stage_.set_sigmas(entry, nullptr);
    workbench_.in_background([this, entry] {
      return [this, entry, sigmas = noise_sigmas(*entry.scan, entry.noise)] {
        stage_.set_sigmas(entry, sigmas);
      };
    });
  }
}

void App::show_measured() {
  state_.measured.reset();
  if (measured_.empty()) return;
  MeasuredLine line;
  for (const MeasuredPoint& point : measured_) {
    const Projected seen = project(view(), point.position);
    if (seen.depth > view().near_plane) line.ends.emplace_back(seen.x, seen.y);
  }
  if (measured_.size() == 2) {
    const MeasuredDistance length = distance(measured_[0], measured_[1]);
    const Measured words = measured(length.metres, length.sigma, Dimension::length);
    line.text = words.value + "  " + words.sigma;
  }
  state_.measured = line;
}

bool App::settled() const { return workbench_.idle() && !stage_.flying() && budget_.one_in == 1; }

double App::patience() const {
  if (stage_.flying() || budget_.one_in > 1) return 0.0;
  if (!state_.toasts.empty() || !workbench_.idle()) return work_patience;
  return ImGui::GetIO().WantTextInput ? caret_patience : idle_patience;
}

void App::frame() {
  if (wanted_scale_) platform_.set_scale(*std::exchange(wanted_scale_, std::nullopt));
  platform_.begin_frame();
  const float scale = platform_.scale();
  const Theme colours = theme(state_.theme);
  const std::string style = std::to_string(static_cast<int>(state_.theme)) + " " + std::to_string(scale);
  if (style != styled_for_) apply_style(colours, scale);
  styled_for_ = style;
  const bool alone = picture_ && picture_->view_alone;
  layout_ = make_layout(static_cast<float>(platform_.width()), static_cast<float>(platform_.height()), scale,
                        {state_.widths.tree, state_.widths.inspector, state_.side_panels && !alone, !alone});
  if (!picture_) {
    collect();
    handle_keys();
    handle_pointer();
    stage_.fly(ImGui::GetIO().DeltaTime);
  }
  draw();
}

void App::draw() {
  const float scale = platform_.scale();
  stage_.update(workbench_.document(), state_, workbench_.changes(), scale);
  stage_.size_points(layout_.view.height, state_.point_size * scale, points_one_in());
  make_sigmas();
  const ViewCamera camera = view();
  state_.notes = stage_.notes(camera);
  state_.drawing = lasso_.drawing();
  state_.contour = lasso_.contour(camera);
  show_measured();
  draw_scene(camera);
  WidgetMap widgets;
  const Gui gui{theme(state_.theme), platform_.fonts(), scale, &widgets};
  Requests requests;
  const PanelInput in{gui, workbench_.document(), state_, layout_};
  if (picture_ && picture_->view_alone)
    draw_overlay(in);
  else
    draw_panels(in, memory_, requests);
  platform_.end_frame();
  if (picture_) return;
  widgets_ = std::move(widgets);
  answer(requests);
}

}  // namespace patchlab::viewer
