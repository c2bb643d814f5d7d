#include <algorithm>
#include <cmath>

#include "viewer/panel/colours.h"
#include "viewer/panel/numbers.h"
#include "viewer/panel/panels.h"

namespace patchlab::viewer {

namespace {

// Where columns end, in parts of the width.
constexpr float chi2_end = 0.60f, sigma_end = 0.78f;

constexpr double narrow_lead = 6.0;  // of BIC: below it evidence is weak

SurfaceRequest request_of(SurfaceType surface) { return *surface_request_from_name(name(surface)); }

std::string difference(double bic) {
  if (bic <= 0.0) return "0";
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
  if (candidate.dof > 0) {
    const double ratio = candidate.chi2 / candidate.dof;
    draw_text_right(draw, gui.fonts.body, {at.x + width * chi2_end, y}, theme.text_dim,
                    significant(ratio, 3));
    draw_text_right(draw, gui.fonts.body, {at.x + width * sigma_end, y}, theme.text_dim,
                    significant(std::sqrt(ratio), 3));
  }
  draw_text_right(draw, gui.fonts.body, {at.x + width, y}, shown ? theme.accent_text : theme.text_dim,
                  difference(candidate.bic - best_bic));
}

void draw_heads(const Gui& gui) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const auto head = [&](float end, const char* text) {
    draw_text_right(draw, gui.fonts.small, {at.x + width * end, at.y}, gui.theme.text_dim, text);
  };
  head(chi2_end, "χ²/dof");
  head(sigma_end, "rms, σ");
  head(1.0f, "ΔBIC");
  ImGui::Dummy({width, gui.fonts.small->FontSize + gui.px(2)});
}

}  // namespace

std::string choice_words(const std::vector<Candidate>& candidates) {
  const auto chosen =
      std::find_if(candidates.begin(), candidates.end(), [](const Candidate& c) { return c.chosen; });
  if (chosen == candidates.end() || candidates.size() < 2) return {};
  const Candidate& next = chosen == candidates.begin() ? candidates[1] : candidates.front();
  const double ahead = next.bic - chosen->bic;
  const std::string others = next.reason.empty() ? "" : ": " + next.reason;
  if (ahead < narrow_lead) return "A narrow lead on " + surface_words(next.surface) + others + ".";
  return "The least BIC, " + significant(ahead, 2) + " ahead of " + surface_words(next.surface) + others +
         ".";
}

void draw_candidates(const Gui& gui, const FitReport& report, SurfaceType shown, Requests& out) {
  if (report.candidates.size() < 2) return;
  section(gui, "SURFACES COMPARED", "click to fit one instead");
  draw_heads(gui);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gui.px(8), 0});
  for (const Candidate& candidate : report.candidates) {
    draw_row(gui, candidate, report.candidates.front().bic, candidate.surface == shown, out);
  }
  ImGui::PopStyleVar();
  if (const std::string words = choice_words(report.candidates); !words.empty()) {
    ImGui::Dummy({0, gui.px(2)});
    paragraph(gui, gui.theme.text_dim, words);
  }
}

}  // namespace patchlab::viewer
