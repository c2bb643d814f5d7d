// The look: one table of colours a theme, and the spacing every panel keeps. Text on its ground has a
// contrast of at least 4.5 (tests/viewer/app/theme_test.cc).
#pragma once

#include "viewer/render/scene.h"

namespace patchlab::viewer {

enum class ThemeChoice { dark, light };

struct Theme {
  Rgba view_top, view_bottom;               // behind the scene
  Rgba bar, panel, popup;                   // grounds
  Rgba line;                                // hairlines and empty tracks
  Rgba hover, pressed;                      // of a row or button
  Rgba text, text_dim;                      // primary, secondary
  Rgba accent, accent_ground, accent_text;  // what is chosen: its frame, its ground, text on that ground
  Rgba good, good_ground, good_text;        // verdicts
  Rgba doubt, doubt_ground, doubt_text;
  Rgba bad, bad_ground, bad_text;
  Rgba point_lit, point_dark;  // points, facing the light and not
  Rgba point_selected, point_outlier;
  Rgba axis_x, axis_y, axis_z;
  Rgba ellipsoid, ellipsoid_rim;
  Rgba map_patch, robot_patch, robot_link, gaussian;  // maps and robots, as in Fig. 4 of the paper
  double neutral_lightness;                           // of diverging(): OKLab lightness of zero
};

Theme theme(ThemeChoice choice);

// Sets ImGui's style from a fresh one, so that a change of scale never scales twice.
void apply_style(const Theme& theme, float scale);

}  // namespace patchlab::viewer
