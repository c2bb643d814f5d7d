#include "viewer/panel/actions.h"

#include <algorithm>
#include <array>

#include "viewer/platform/key.h"

namespace patchlab::viewer {

namespace {

constexpr bool kCtrl = true, kShift = true;

constexpr ActionRow kActions[] = {
    {Action::open_file, Menu::file, "Open...", "a scan, or a journal to go on with", 'O', kCtrl},
    {Action::save_journal_as, Menu::file, "Save journal as...", "a copy of all that was done so far", 'S',
     kCtrl, kShift},
    {Action::export_patches, Menu::file, "Export patches...",
     "the kept patches, for a robot or another program", 'E', kCtrl},
    {Action::save_picture, Menu::file, "Save picture...", "of the window or of the view alone, at any size",
     key::f12},
    {Action::quit, Menu::file, "Quit", "nothing is lost: every step is saved as it happens", 'Q', kCtrl},

    {Action::undo, Menu::edit, "Undo", "takes the last step back, whatever it was", 'Z', kCtrl},
    {Action::redo, Menu::edit, "Redo", "does it again", 'Z', kCtrl, kShift},
    {Action::remove, Menu::edit, "Delete", "the chosen patch, region or scan", key::del},
    {Action::rename, Menu::edit, "Rename", "the chosen patch, region or scan", key::f2},

    {Action::orbit_tool, Menu::select, "Orbit", "the left button turns the view", 'O'},
    {Action::lasso_tool, Menu::select, "Lasso", "drag to draw, click for corners", 'L'},
    {Action::rectangle_tool, Menu::select, "Rectangle", "drag from corner to corner", 'M'},
    {Action::surface_tool, Menu::select, "Smooth surface",
     "click a point: the surface it lies on, up to its edges", 'G'},
    {Action::measure_tool, Menu::select, "Measure",
     "click two points: their distance, with its standard deviation", 'D'},
    {Action::visible_only, Menu::select, "Visible only",
     "a contour leaves out what other points hide; otherwise it goes through", 'X'},
    {Action::mode_set, Menu::select, "Set", "a new contour replaces the selection"},
    {Action::mode_add, Menu::select, "Add", "a new contour adds to the selection (Shift)"},
    {Action::mode_subtract, Menu::select, "Subtract", "a new contour takes away from the selection (Ctrl)"},
    {Action::mode_intersect, Menu::select, "Intersect",
     "only what is also in a new contour stays (Shift+Ctrl)"},
    {Action::depth_slab, Menu::select, "Depth slab", "only a layer about the pivot is shown and selected",
     'Z'},
    {Action::last_vertex, Menu::select, "Take last corner back", "while drawing", key::backspace},
    {Action::cancel, Menu::select, "Cancel", "the contour first, then the fit, then the tool", key::escape},

    {Action::invert, Menu::select, "Invert", "all points of the scan that are not in the region", 'I', kCtrl},
    {Action::grow, Menu::select, "Grow", "by a ring of neighbours", '=', false, false, key::pad_add},
    {Action::shrink, Menu::select, "Shrink", "by a ring of neighbours", '-', false, false, key::pad_subtract},
    {Action::linked, Menu::select, "All linked", "everything smoothly connected with the region", 'K'},
    {Action::hide, Menu::select, "Hide", "the chosen patch, region or scan, or show it again", 'H'},
    {Action::show_all, Menu::select, "Show all", "whatever was hidden", 'H', false, kShift},

    {Action::fit_automatic, Menu::fit, "Automatic", "all surfaces, the best one is chosen", '0', false, false,
     key::pad_0},
    {Action::fit_paraboloid, Menu::fit, "Paraboloid",
     "elliptic, hyperbolic, cylindric or circular, or a plane", '1', false, false, key::pad_0 + 1},
    {Action::fit_plane, Menu::fit, "Plane", "with the outline that suits the points", '2', false, false,
     key::pad_0 + 2},
    {Action::fit_sphere, Menu::fit, "Sphere", "with a circular outline", '3', false, false, key::pad_0 + 3},
    {Action::fit_cylinder, Menu::fit, "Cylinder", "circular, with a rectangular outline", '4', false, false,
     key::pad_0 + 4},
    {Action::fit_elliptic, Menu::fit, "Elliptic paraboloid",
     "this type alone, curved the same way in both directions"},
    {Action::fit_hyperbolic, Menu::fit, "Hyperbolic paraboloid", "this type alone, a saddle"},
    {Action::fit_cylindric, Menu::fit, "Cylindric paraboloid", "this type alone, curved in one direction"},
    {Action::fit_circular, Menu::fit, "Circular paraboloid",
     "this type alone, curved alike in both directions"},
    {Action::bound_automatic, Menu::fit, "Outline of a plane: automatic", "the one that suits the points"},
    {Action::bound_ellipse, Menu::fit, "Outline of a plane: ellipse",
     "of planes; other surfaces have one outline"},
    {Action::bound_circle, Menu::fit, "Outline of a plane: circle",
     "of planes; other surfaces have one outline"},
    {Action::bound_rectangle, Menu::fit, "Outline of a plane: rectangle",
     "of planes; other surfaces have one outline"},
    {Action::bound_quad, Menu::fit, "Outline of a plane: convex quad",
     "of planes; other surfaces have one outline"},
    {Action::robust, Menu::fit, "Reject outliers",
     "points that do not belong to the surface are flagged and left out", 'R'},
    {Action::noise, Menu::fit, "Noise model...", "of the scan: what if it were another?", 'N'},
    {Action::keep, Menu::fit, "Keep patch", "closes an open contour, then keeps the fitted patch", key::enter,
     false, false, key::pad_enter},

    {Action::home, Menu::view, "Frame all", "everything in view", key::home},
    {Action::frame_selection, Menu::view, "Frame selection", "the chosen patch, region or scan", 'F'},
    {Action::sensor_view, Menu::view, "View of the sensor", "from where the scan was taken", 'V'},
    {Action::view_right, Menu::view, "From the right", "about the axis that the view turns about", '6'},
    {Action::view_top, Menu::view, "From above", "", '7'},
    {Action::view_front, Menu::view, "From the front", "", '8'},
    {Action::view_oblique, Menu::view, "Obliquely from above", "", '9'},
    {Action::view_left, Menu::view, "From the left", "", '6', kCtrl},
    {Action::view_below, Menu::view, "From below", "", '7', kCtrl},
    {Action::view_back, Menu::view, "From behind", "", '8', kCtrl},
    {Action::perspective, Menu::view, "Perspective", "or parallel projection", '5'},
    {Action::colour_shading, Menu::view, "Points shaded", "grey, by how they face the sensor"},
    {Action::colour_photo, Menu::view, "Points in their own colours", "where the scan has them"},
    {Action::colour_height, Menu::view, "Points by height", "along the axis that the view turns about"},
    {Action::colour_label, Menu::view, "Points by label", "where the scan has labels"},
    {Action::colour_intensity, Menu::view, "Points by intensity", "where the scan says how much came back"},
    {Action::colour_residual, Menu::view, "Residuals on points",
     "signed distance to the patch in standard deviations", 'C'},
    {Action::colour_noise, Menu::view, "Points by noise",
     "how far the noise model spreads each: its largest standard deviation"},
    {Action::cividis, Menu::view, "Cividis colours", "instead of viridis, where numbers are colours"},
    {Action::larger_points, Menu::view, "Larger points", "", ']'},
    {Action::smaller_points, Menu::view, "Smaller points", "", '['},
    {Action::show_surface, Menu::view, "Surface", "coloured by the standard deviation of its height"},
    {Action::show_ellipsoid, Menu::view, "Ellipsoid of the centre", "95 %"},
    {Action::show_cone, Menu::view, "Cone of the normal", "95 %"},
    {Action::show_band, Menu::view, "Band of the outline", "95 %"},
    {Action::show_axes, Menu::view, "Local axes", "of the chosen patch"},
    {Action::show_offsets, Menu::view, "Offset surfaces",
     "where the surface lies with 95 %, above and below; how much further apart is written in the view", 'S'},
    {Action::show_points, Menu::view, "Ellipsoids of the points", "95 % of some points of the chosen region",
     'E'},
    {Action::show_grid, Menu::view, "Grid on patches", "lines of their local axes: how they are curved"},
    {Action::show_names, Menu::view, "Names of patches", "in the view"},
    {Action::sigma_of_both, Menu::view, "Uncertainty of shape and pose", "as the fit gives it"},
    {Action::sigma_of_shape, Menu::view, "Uncertainty of the shape alone",
     "intrinsic: as if the pose were known; outline and curvatures"},
    {Action::sigma_of_pose, Menu::view, "Uncertainty of the pose alone",
     "extrinsic: as if the shape were known"},
    {Action::side_panels, Menu::view, "Side panels", "or the view alone between the bars", key::tab},
    {Action::theme, Menu::view, "Light theme", "or dark", 'T', kCtrl},
    {Action::larger_interface, Menu::view, "Larger interface", "", '=', kCtrl, false, key::pad_add},
    {Action::smaller_interface, Menu::view, "Smaller interface", "", '-', kCtrl, false, key::pad_subtract},
    {Action::normal_interface, Menu::view, "Normal interface size", "", '0', kCtrl},

    {Action::help, Menu::help, "Keys and gestures", "this sheet", key::f1},
    {Action::palette, Menu::help, "All commands...", "find one by typing a part of its name", 'P', kCtrl},
    {Action::messages, Menu::help, "Messages...", "all that was said since the start"},
};

constexpr Gesture kGestures[] = {
    {"Left drag", "lasso tool: draws freehand, the release closes · orbit tool: turns the view"},
    {"Left click", "lasso tool: a corner; near the start it closes · orbit tool: chooses the patch under it"},
    {"Edge of a side panel", "drag: its width"},
    {"Double click", "closes the contour; elsewhere sets the pivot"},
    {"Left drag, left click",
     "rectangle tool: from corner to corner · smooth surface tool: a click takes the surface up to its edges"},
    {"Shift, Ctrl, both", "while starting a contour: add, subtract, intersect"},
    {"Right drag, Alt + left drag",
     "turns the view, also while a contour is being drawn; with Shift it moves the view"},
    {"Middle drag", "moves the view"},
    {"Wheel", "zooms to the cursor"},
};

constexpr struct {
  int key;
  const char* name;
} kKeyNames[] = {
    {key::del, "Delete"}, {key::backspace, "Backspace"},
    {key::escape, "Esc"}, {key::enter, "Enter"},
    {key::home, "Home"},  {key::f1, "F1"},
    {key::f2, "F2"},      {key::f12, "F12"},
    {key::tab, "Tab"},
};

}  // namespace

std::span<const ActionRow> action_table() { return kActions; }

const ActionRow& row(Action action) {
  return *std::find_if(std::begin(kActions), std::end(kActions),
                       [action](const ActionRow& candidate) { return candidate.action == action; });
}

const char* name(Menu menu) {
  constexpr std::array names = {"File", "Edit", "Select", "Fit", "View", "Help"};
  return names[static_cast<std::size_t>(menu)];
}

std::string key_name(int key) {
  for (const auto& known : kKeyNames)
    if (known.key == key) return known.name;
  return key == 0 ? std::string() : std::string(1, static_cast<char>(key));
}

std::string key_name(const ActionRow& action) {
  if (action.key == 0) return {};
  return std::string(action.ctrl ? "Ctrl+" : "") + (action.shift ? "Shift+" : "") + key_name(action.key);
}

std::span<const Gesture> gesture_table() { return kGestures; }

}  // namespace patchlab::viewer
