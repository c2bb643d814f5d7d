// Everything that has a key, a menu entry or a button, as one table: keys are bound from it, menus and the
// help sheet are written from it.
#pragma once

#include <span>
#include <string>

namespace patchlab::viewer {

enum class Action {
  open_file,
  save_journal_as,
  export_patches,
  save_picture,
  quit,
  undo,
  redo,
  remove,
  rename,
  orbit_tool,
  lasso_tool,
  rectangle_tool,
  surface_tool,
  measure_tool,
  visible_only,
  mode_set,
  mode_add,
  mode_subtract,
  mode_intersect,
  depth_slab,
  last_vertex,
  cancel,
  invert,
  grow,
  shrink,
  linked,
  hide,
  show_all,
  fit_automatic,
  fit_paraboloid,
  fit_plane,
  fit_sphere,
  fit_cylinder,
  fit_elliptic,
  fit_hyperbolic,
  fit_cylindric,
  fit_circular,
  bound_automatic,
  bound_ellipse,
  bound_circle,
  bound_rectangle,
  bound_quad,
  robust,
  noise,
  keep,
  home,
  frame_selection,
  sensor_view,
  view_right,
  view_top,
  view_front,
  view_oblique,
  view_left,
  view_below,
  view_back,
  perspective,
  colour_shading,
  colour_photo,
  colour_height,
  colour_label,
  colour_intensity,
  colour_residual,
  colour_noise,
  cividis,
  larger_points,
  smaller_points,
  show_surface,
  show_ellipsoid,
  show_cone,
  show_band,
  show_axes,
  show_offsets,
  show_points,
  show_grid,
  show_names,
  sigma_of_both,
  sigma_of_shape,
  sigma_of_pose,
  side_panels,
  theme,
  larger_interface,
  smaller_interface,
  normal_interface,
  help,
  palette,
  messages,
};

enum class Menu { file, edit, select, fit, view, help };

struct ActionRow {
  Action action;
  Menu menu;
  const char* name;  // "Undo"
  const char* help;  // one line
  int key = 0;       // as viewer/platform/key.h; 0: none
  bool ctrl = false;
  bool shift = false;
  int also = 0;  // a second key with the same modifiers
};

std::span<const ActionRow> action_table();
const ActionRow& row(Action action);
const char* name(Menu menu);
// "Ctrl+Shift+Z"; empty where there is none.
std::string key_name(const ActionRow& action);
// The key alone: "L".
std::string key_name(int key);

// What the mouse does, for the help sheet.
struct Gesture {
  const char* gesture;
  const char* help;
};
std::span<const Gesture> gesture_table();

}  // namespace patchlab::viewer
