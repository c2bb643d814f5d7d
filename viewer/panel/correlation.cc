#include <algorithm>
#include <cmath>

#include "engine/patch/marginals.h"
#include "viewer/panel/colours.h"
#include "viewer/panel/numbers.h"
#include "viewer/panel/panels.h"
#include "viewer/panel/parameter_rows.h"

namespace patchlab::viewer {

namespace {

void draw_cells(const Gui& gui, const Patch& patch, const PatchMatrix& correlations, float cell) {
  const std::vector<std::string> names = local_names(*patch.type);
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float gap = gui.px(2);
  const Eigen::Index n = correlations.rows();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const ImVec2 at = {origin.x + static_cast<float>(j) * cell, origin.y + static_cast<float>(i) * cell};
      const ImVec2 end = {at.x + cell - gap, at.y + cell - gap};
      draw.AddRectFilled(at, end, u32(diverging(correlations(i, j), gui.theme.neutral_lightness)), gui.px(2));
      if (!ImGui::IsWindowHovered() || !ImGui::IsMouseHoveringRect(at, {at.x + cell, at.y + cell})) continue;
      draw.AddRect(at, end, u32(gui.theme.text), gui.px(2));
      const std::string pair = local_words(names[static_cast<std::size_t>(i)]) + " with " +
                               local_words(names[static_cast<std::size_t>(j)]);
      ImGui::SetTooltip("%s: %s", pair.c_str(), fixed(correlations(i, j), 2).c_str());
    }
  }
}

std::string yes_no(bool yes) { return yes ? "yes" : "no"; }

}  // namespace

void draw_correlation(const Gui& gui, const Patch& patch) {
  if (!patch.covariance_local) return;
  section(gui, "CORRELATION", "shape and pose together");
  const PatchMatrix correlations = correlation(*patch.covariance_local);
  const float width = ImGui::GetContentRegionAvail().x;
  const float side = std::min(gui.px(148), width * 0.45f);
  const float cell = std::floor(side / static_cast<float>(correlations.rows()));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  draw_cells(gui, patch, correlations, cell);

  const float text_x = at.x + side + gui.px(16), line = gui.fonts.body->FontSize + gui.px(6);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const StrongestPair strongest = strongest_pair(patch, correlations);
  draw_text(draw, gui.fonts.body, {text_x, at.y}, gui.theme.text_dim, "strongest");
  draw_label(gui, draw, {text_x, at.y + line}, gui.theme.text, strongest.one);
  draw_label(gui, draw, {text_x, at.y + 2 * line}, gui.theme.text, strongest.other);
  draw_text_right(draw, gui.fonts.body, {at.x + width, at.y}, gui.theme.text,
                  fixed(strongest.correlation, 2));
  const float below = at.y + 3 * line + gui.px(10);
  draw_text(draw, gui.fonts.body, {text_x, below}, gui.theme.text_dim, "near-singular");
  draw_text_right(draw, gui.fonts.body, {at.x + width, below}, gui.theme.text, yes_no(near_singular(patch)));
  draw_text(draw, gui.fonts.body, {text_x, below + line}, gui.theme.text_dim, "spin observable");
  draw_text_right(draw, gui.fonts.body, {at.x + width, below + line}, gui.theme.text,
                  yes_no(!patch.type->revolute()));
  ImGui::Dummy({width, std::max(side, 5 * line + gui.px(10))});
  if (near_singular(patch) && ImGui::IsMouseHoveringRect({text_x, below}, {at.x + width, below + line})) {
    tooltip(
        gui,
        "The normal points nearly against z of this frame, where r_xy is singular: its covariance says little there. "
        "The tilt above is given in the patch's own axes, where nothing is singular.");
  }
}

}  // namespace patchlab::viewer
