#include <algorithm>
#include <ctime>
#include <variant>

#include "viewer/app/app.h"

namespace patchlab::viewer {

namespace {

// The folder that a file dialog starts in.
std::filesystem::path folder_for(const Document& document, const FileDialog& files) {
  if (!files.folder().empty()) return files.folder();
  if (!document.scans.empty() && document.scans.back().scan) {
    return std::filesystem::absolute(document.scans.back().scan->file).parent_path();
  }
  std::error_code error;
  return std::filesystem::current_path(error);
}

std::string stem_of(const Document& document) {
  return document.scans.empty() ? "patches"
                                : std::filesystem::path(document.scans.back().name).stem().string();
}

// A merge says when it was made.
Command dated(Command command) {
  auto* const merge = std::get_if<Merge>(&command);
  if (merge == nullptr || !merge->when.empty()) return command;
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  merge->when = text;
  return command;
}

}  // namespace

void App::answer(const Requests& requests) {
  for (const Action action : requests.actions) act(action);
  for (const Command& command : requests.commands) workbench_.run(dated(command));
  if (requests.select) select(*requests.select);
  if (requests.surface) choose_surface(*requests.surface);
  if (requests.noise) workbench_.set_noise(requests.noise->scan, requests.noise->noise);
  if (requests.history_position) workbench_.go_to(*requests.history_position);
  if (requests.open) {
    if (!requests.open->instead_of.empty()) workbench_.run(Delete{requests.open->instead_of});
    open(requests.open->file, requests.open->wishes);
  }
  if (requests.picture) save_picture(*requests.picture);
  if (requests.widths) state_.widths = *requests.widths;
  if (requests.save_journal) workbench_.save_journal(*requests.save_journal);
  if (requests.export_to) {
    ExportRequest request = *requests.export_to;
    request.chosen = state_.selected;
    workbench_.write_patches(request);
  }
  if (requests.slab) state_.slab = requests.slab;
  answer_about_maps(requests);
  if (requests.cancel_work) workbench_.cancel_work();
}

void App::answer_about_maps(const Requests& requests) {
  if (requests.drag_joint) workbench_.preview_joint(*requests.drag_joint);
  if (requests.ask_about) state_.questions.other = *requests.ask_about;
  if (requests.tilt_limit) state_.questions.limit = *requests.tilt_limit;
  if (!requests.propose) return;
  state_.proposed = {requests.propose->map, requests.propose->view, nullptr, {}};
  proposed_at_ = 0;
}

void App::act(Action action) {
  if (choose(action) || act_on_contour_and_fit(action) || act_on_view(action) || turn_view(action) ||
      open_sheet(action))
    return;
  act_on_document(action);
}

bool App::choose(Action action) {
  if (const auto tool = tool_of(action))
    state_.tool = *tool;
  else if (const auto mode = mode_of(action))
    state_.mode = *mode;
  else if (const auto surface = surface_of(action))
    choose_surface(*surface);
  else if (const auto boundary = boundary_of(action)) {
    state_.boundary = *boundary;
    choose_surface(state_.surface);
  } else if (const auto how = reshaping_of(action))
    workbench_.reshape(*how);
  else if (const auto part = sigma_of(action))
    state_.sigma_of = *part;
  else if (const auto layer = layer_of(action))
    state_.layers.*layer = !(state_.layers.*layer);
  else if (const auto colours = colours_of(action)) {
    const bool off = *colours == PointColours::residual && state_.colours == PointColours::residual;
    state_.colours = off ? PointColours::shading : *colours;
  } else {
    return false;
  }
  return true;
}

bool App::act_on_contour_and_fit(Action action) {
  switch (action) {
    case Action::last_vertex:
      lasso(lasso_.backspace());
      return true;
    case Action::cancel:
      cancel();
      return true;
    case Action::keep:
      keep();
      return true;
    case Action::depth_slab:
      toggle_slab();
      return true;
    case Action::visible_only:
      state_.visible_only = !state_.visible_only;
      return true;
    case Action::robust:
      state_.robust = !state_.robust;
      choose_surface(state_.surface);
      return true;
    default:
      return false;
  }
}

void App::toggle_slab() {
  constexpr double share = 0.15;  // of the distance of the eye, to either side at first
  const double thickness = share * stage_.camera.distance;
  if (state_.slab)
    state_.slab.reset();
  else
    state_.slab = DepthSlab{thickness, thickness};
}

bool App::open_sheet(Action action) {
  constexpr struct {
    Action action;
    bool PanelMemory::*open;
  } sheets[] = {{Action::noise, &PanelMemory::choose_noise},
                {Action::help, &PanelMemory::help},
                {Action::palette, &PanelMemory::palette},
                {Action::messages, &PanelMemory::messages}};
  for (const auto& sheet : sheets) {
    if (sheet.action != action) continue;
    memory_.*sheet.open = true;
    return true;
  }
  return false;
}

void App::act_on_document(Action action) {
  const Document& document = workbench_.document();
  switch (action) {
    case Action::open_file:
      memory_.files.show(FilePurpose::open, folder_for(document, memory_.files));
      break;
    case Action::save_journal_as:
      memory_.files.show(FilePurpose::save_journal, folder_for(document, memory_.files),
                         stem_of(document) + ".patchlab");
      break;
    case Action::export_patches:
      memory_.files.show(FilePurpose::export_patches, folder_for(document, memory_.files),
                         stem_of(document) + ".json");
      break;
    case Action::save_picture:
      memory_.files.show(FilePurpose::save_picture, folder_for(document, memory_.files),
                         stem_of(document) + ".png");
      break;
    case Action::quit:
      close_ = true;
      break;
    case Action::undo:
      workbench_.undo();
      break;
    case Action::redo:
      workbench_.redo();
      break;
    case Action::remove:
      remove_selected();
      break;
    case Action::hide:
      hide_selected();
      break;
    case Action::show_all:
      show_all();
      break;
    case Action::rename:
      rename_selected();
      break;
    default:
      break;
  }
}

// The contour first, then the fit that is not kept, then the tool.
void App::cancel() {
  if (lasso_.drawing()) return lasso(lasso_.escape());
  if (!state_.draft.empty()) {
    const RegionEntry* region = lit_region(workbench_.document(), state_.selected);
    const std::string shown = region ? region->id : std::string();
    workbench_.discard();
    state_.selected = shown;
    return;
  }
  if (!measured_.empty()) return measured_.clear();
  state_.tool = Tool::orbit;
}

void App::keep() {
  if (lasso_.drawing()) return lasso(lasso_.enter());
  workbench_.keep();
}

void App::remove_selected() {
  if (state_.selected == state_.draft) return cancel();
  workbench_.run(Delete{state_.selected});
}

void App::hide_selected() {
  const Document& document = workbench_.document();
  const auto turn = [this](const auto* entry) {
    if (entry) workbench_.run(Show{entry->id, !entry->visible});
    return entry != nullptr;
  };
  if (turn(find_patch(document, state_.selected)) || turn(find_region(document, state_.selected))) return;
  if (turn(find_scan(document, state_.selected)) || turn(find_map(document, state_.selected))) return;
  turn(find_robot(document, state_.selected));
}

void App::show_all() {
  const Document document = workbench_.document();
  const auto show = [this](const auto& entries) {
    for (const auto& entry : entries) {
      if (!entry.visible) workbench_.run(Show{entry.id, true});
    }
  };
  show(document.scans);
  show(document.regions);
  show(document.patches);
  show(document.maps);
  show(document.robots);
}

void App::rename_selected() {
  const Document& document = workbench_.document();
  if (const PatchEntry* patch = find_patch(document, state_.selected))
    memory_.new_name = patch->name;
  else if (const RegionEntry* region = find_region(document, state_.selected))
    memory_.new_name = region->name;
  else if (const ScanEntry* scan = find_scan(document, state_.selected))
    memory_.new_name = scan->name;
  else if (const MapEntry* map = find_map(document, state_.selected))
    memory_.new_name = map->name;
  else if (const RobotEntry* robot = find_robot(document, state_.selected))
    memory_.new_name = robot->name;
  else
    return;
  if (state_.selected != state_.draft) memory_.renaming = state_.selected;
}

void App::choose_surface(SurfaceRequest surface) {
  state_.surface = surface;
  workbench_.choose({surface, state_.robust, state_.boundary});
}

void App::select(const std::string& id) {
  state_.selected = id;
  workbench_.focus(id);
}

}  // namespace patchlab::viewer
