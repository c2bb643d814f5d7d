#include <algorithm>

#include "viewer/panel/colours.h"
#include "viewer/panel/numbers.h"
#include "viewer/panel/panels.h"

namespace patchlab::viewer {

namespace {

SurfaceRequest request_of(SurfaceType surface) { return *surface_request_from_name(name(surface)); }

std::string difference(double bic) {
  if (bic <= 0.0) return "ΔBIC 0";
  return "+ " + (bic < 10.0 ? fixed(bic, 1) : count(static_cast<std::size_t>(std::min(bic, 1e12))));
}

void draw_row(const Gui& gui, const Candidate& candidate, double best_bic, bool shown, Requests& out) {
  const Theme& theme = gui.theme;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = gui.px(24);
  const std::string words = surface_words(candidate.surface);
  if (ImGui::InvisibleButton(words.c_str(), {width, height})) out.surface = request_of(candidate.surface);
  gui.note("candidates/" + words);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (ImGui::IsItemHovered()) {
    draw.AddRectFilled({at.x - gui.px(6), at.y}, {at.x + width + gui.px(6), at.y + height}, u32(theme.hover),
                       gui.px(5));
  }
  tooltip(gui, candidate.reason.empty() ? "Fit this shape instead" : candidate.reason);
  const float y = at.y + (height - gui.fonts.body->FontSize) / 2;
  draw_text(draw, gui.fonts.body, {at.x, y}, shown ? theme.accent_text : theme.text, words);
  const std::string ratio =
      candidate.dof > 0 ? "χ²/dof " + significant(candidate.chi2 / candidate.dof, 3) : "";
  draw_text_right(draw, gui.fonts.body, {at.x + width * 0.72f, y}, theme.text_dim, ratio);
  draw_text_right(draw, gui.fonts.body, {at.x + width, y}, shown ? theme.accent_text : theme.text_dim,
                  difference(candidate.bic - best_bic));
}

}  // namespace

void draw_candidates(const Gui& gui, const FitReport& report, SurfaceType shown, Requests& out) {
  if (report.candidates.size() < 2) return;
  section(gui, "OTHER SHAPES", "click to fit one instead");
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gui.px(8), 0});
  for (const Candidate& candidate : report.candidates) {
    draw_row(gui, candidate, report.candidates.front().bic, candidate.surface == shown, out);
  }
  ImGui::PopStyleVar();
}

}  // namespace patchlab::viewer
