#include "viewer/panel/choices.h"

#include <algorithm>
#include <array>

namespace patchlab::viewer {

namespace {

template <class Value>
struct Choice {
  Action action;
  Value value;
};

constexpr Choice<SurfaceRequest> kSurfaceChoices[] = {
    {Action::fit_automatic, SurfaceRequest::automatic},
    {Action::fit_paraboloid, SurfaceRequest::paraboloid},
    {Action::fit_plane, SurfaceRequest::plane},
    {Action::fit_sphere, SurfaceRequest::sphere},
    {Action::fit_cylinder, SurfaceRequest::circular_cylinder},
    {Action::fit_elliptic, SurfaceRequest::elliptic_paraboloid},
    {Action::fit_hyperbolic, SurfaceRequest::hyperbolic_paraboloid},
    {Action::fit_cylindric, SurfaceRequest::cylindric_paraboloid},
    {Action::fit_circular, SurfaceRequest::circular_paraboloid}};
constexpr Choice<BoundaryRequest> kBoundaryChoices[] = {{Action::bound_automatic, BoundaryRequest::automatic},
                                                        {Action::bound_ellipse, BoundaryRequest::ellipse},
                                                        {Action::bound_circle, BoundaryRequest::circle},
                                                        {Action::bound_rectangle, BoundaryRequest::rectangle},
                                                        {Action::bound_quad, BoundaryRequest::convex_quad}};
constexpr Choice<Reshaping> kReshapingChoices[] = {{Action::invert, Reshaping::invert},
                                                   {Action::grow, Reshaping::grow},
                                                   {Action::shrink, Reshaping::shrink},
                                                   {Action::linked, Reshaping::linked}};
constexpr Choice<SelectMode> kModeChoices[] = {{Action::mode_set, SelectMode::set},
                                               {Action::mode_add, SelectMode::add},
                                               {Action::mode_subtract, SelectMode::subtract},
                                               {Action::mode_intersect, SelectMode::intersect}};
constexpr Choice<Tool> kToolChoices[] = {{Action::orbit_tool, Tool::orbit},
                                         {Action::lasso_tool, Tool::lasso},
                                         {Action::rectangle_tool, Tool::rectangle},
                                         {Action::surface_tool, Tool::surface},
                                         {Action::measure_tool, Tool::measure}};
constexpr Choice<PointColours> kColours[] = {
    {Action::colour_shading, PointColours::shading},     {Action::colour_photo, PointColours::photo},
    {Action::colour_height, PointColours::height},       {Action::colour_label, PointColours::label},
    {Action::colour_intensity, PointColours::intensity}, {Action::colour_residual, PointColours::residual},
    {Action::colour_noise, PointColours::noise}};
constexpr Choice<SigmaOf> kSigmas[] = {{Action::sigma_of_both, SigmaOf::both},
                                       {Action::sigma_of_shape, SigmaOf::shape},
                                       {Action::sigma_of_pose, SigmaOf::pose}};
constexpr Choice<bool Layers::*> kLayers[] = {
    {Action::show_surface, &Layers::surface}, {Action::show_ellipsoid, &Layers::ellipsoid},
    {Action::show_cone, &Layers::cone},       {Action::show_band, &Layers::band},
    {Action::show_axes, &Layers::axes},       {Action::show_offsets, &Layers::offsets},
    {Action::show_points, &Layers::points},   {Action::show_grid, &Layers::grid},
    {Action::show_names, &Layers::names}};

template <class Value, std::size_t n>
std::optional<Value> find(const Choice<Value> (&choices)[n], Action action) {
  for (const Choice<Value>& choice : choices)
    if (choice.action == action) return choice.value;
  return std::nullopt;
}

template <class Values>
bool any_scan_has(const Document& document, std::vector<Values> Scan::*values) {
  return std::any_of(document.scans.begin(), document.scans.end(), [values](const ScanEntry& entry) {
    return entry.scan && !((*entry.scan).*values).empty();
  });
}

template <class Entry>
bool any_hidden(const std::vector<Entry>& entries) {
  return std::any_of(entries.begin(), entries.end(), [](const Entry& entry) { return !entry.visible; });
}

bool has_kept_patch(const Document& document, const std::string& draft) {
  return std::any_of(document.patches.begin(), document.patches.end(),
                     [&draft](const PatchEntry& entry) { return entry.id != draft; });
}

}  // namespace

std::optional<SurfaceRequest> surface_of(Action action) { return find(kSurfaceChoices, action); }
std::optional<BoundaryRequest> boundary_of(Action action) { return find(kBoundaryChoices, action); }
std::optional<Reshaping> reshaping_of(Action action) { return find(kReshapingChoices, action); }
std::optional<SelectMode> mode_of(Action action) { return find(kModeChoices, action); }
std::optional<Tool> tool_of(Action action) { return find(kToolChoices, action); }
std::optional<PointColours> colours_of(Action action) { return find(kColours, action); }
std::optional<SigmaOf> sigma_of(Action action) { return find(kSigmas, action); }
bool Layers::*layer_of(Action action) { return find(kLayers, action).value_or(nullptr); }

std::optional<bool> is_chosen(Action action, const ViewState& state) {
  if (const auto surface = surface_of(action)) return state.surface == *surface;
  if (const auto boundary = boundary_of(action)) return state.boundary == *boundary;
  if (const auto mode = mode_of(action)) return state.mode == *mode;
  if (const auto tool = tool_of(action)) return state.tool == *tool;
  if (const auto colours = colours_of(action)) return state.colours == *colours;
  if (const auto part = sigma_of(action)) return state.sigma_of == *part;
  if (const auto layer = layer_of(action)) return state.layers.*layer;
  switch (action) {
    case Action::visible_only:
      return state.visible_only;
    case Action::depth_slab:
      return state.slab.has_value();
    case Action::robust:
      return state.robust;
    case Action::perspective:
      return state.perspective;
    case Action::cividis:
      return state.map == ColourMap::cividis;
    case Action::side_panels:
      return state.side_panels;
    case Action::theme:
      return state.theme == ThemeChoice::light;
    default:
      return std::nullopt;
  }
}

bool is_possible(Action action, const Document& document, const ViewState& state) {
  switch (action) {
    case Action::undo:
      return state.can_undo;
    case Action::redo:
      return state.can_redo;
    case Action::export_patches:
      return has_kept_patch(document, state.draft) || !document.maps.empty();
    case Action::save_journal_as:
      return !state.journal.empty();
    case Action::invert:
    case Action::grow:
    case Action::shrink:
    case Action::linked:
      return !state.drawing &&
             (find_region(document, state.selected) || find_patch(document, state.selected));
    case Action::show_all:
      return any_hidden(document.scans) || any_hidden(document.regions) || any_hidden(document.patches) ||
             any_hidden(document.maps) || any_hidden(document.robots);
    case Action::hide:
      return is_taken(document, state.selected) && state.selected != state.draft;
    case Action::remove:
    case Action::rename:
      return is_taken(document, state.selected);
    case Action::frame_selection:
      return !state.selected.empty();
    case Action::keep:
      return state.drawing || !state.draft.empty() || state.currency == Currency::fitting ||
             state.currency == Currency::preview;
    case Action::last_vertex:
      return state.drawing;
    case Action::noise:
    case Action::sensor_view:
    case Action::colour_noise:
      return !document.scans.empty();
    case Action::home:
    case Action::view_right:
    case Action::view_top:
    case Action::view_front:
    case Action::view_oblique:
    case Action::view_left:
    case Action::view_below:
    case Action::view_back:
      return !document.scans.empty() || !document.maps.empty() || !document.robots.empty();
    case Action::colour_photo:
      return any_scan_has(document, &Scan::colours);
    case Action::colour_label:
      return any_scan_has(document, &Scan::labels);
    case Action::colour_intensity:
      return any_scan_has(document, &Scan::intensities);
    case Action::colour_residual:
      return !document.patches.empty();
    default:
      return true;
  }
}

}  // namespace patchlab::viewer
