#include <algorithm>

#include "viewer/panel/colours.h"
#include "viewer/panel/numbers.h"
#include "viewer/panel/panels.h"

namespace patchlab::viewer {

namespace {

struct Tone {
  Rgba ground, frame, text;
};

// A remark about the frame that the parameters are given in, not about the fit: it is said beside the
// correlations.
bool is_about_frame(const Finding& finding) { return finding.name == "near_singular"; }

bool has_doubts(const FitReport& report) {
  return std::any_of(report.warnings.begin(), report.warnings.end(),
                     [](const Finding& warning) { return !is_about_frame(warning); });
}

Tone tone_of(const Theme& theme, const FitReport& report) {
  if (!report.accepted) return {theme.bad_ground, theme.bad, theme.bad_text};
  if (has_doubts(report)) return {theme.doubt_ground, theme.doubt, theme.doubt_text};
  return {theme.good_ground, theme.good, theme.good_text};
}

const char* headline(const FitReport& report) {
  if (!report.accepted) return "Not accepted";
  return has_doubts(report) ? "Accepted, but" : "Agrees with the noise model";
}

std::string numbers_of(const FitReport& report) {
  std::string text;
  if (report.dof > 0) {
    text =
        "χ²/dof " + significant(report.chi2 / report.dof, 3) + " (" + p_value_text(report.p_value) + ")  ·  ";
  }
  text += count(report.points) + " points";
  if (report.robust || !report.outliers.empty()) {
    text +=
        "  ·  " + count(report.outliers.size()) + (report.outliers.size() == 1 ? " outlier" : " outliers");
  }
  return text;
}

}  // namespace

std::vector<std::string> sentences_of(const FitReport& report) {
  std::vector<Finding> said = report.reasons;
  for (const Finding& warning : report.warnings) {
    const bool known = std::any_of(said.begin(), said.end(), [&warning](const Finding& finding) {
      return finding.name == warning.name || finding.sentence == warning.sentence;
    });
    if (!known && !is_about_frame(warning)) said.push_back(warning);
  }
  std::vector<std::string> sentences;
  for (const Finding& finding : said) sentences.push_back(finding.sentence);
  return sentences;
}

void draw_verdict(const Gui& gui, const FitReport& report) {
  const Tone tone = tone_of(gui.theme, report);
  const float pad = gui.px(11);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.ChannelsSplit(2);
  draw.ChannelsSetCurrent(1);
  ImGui::SetCursorScreenPos({at.x + pad, at.y + pad});
  ImGui::BeginGroup();
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width - 2 * pad);
  const auto write = [&](ImFont* font, const Rgba& colour, const std::string& text) {
    ImGui::PushFont(font);
    ImGui::PushStyleColor(ImGuiCol_Text, u32(colour));
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
    ImGui::PopFont();
  };
  write(gui.fonts.strong, tone.text, headline(report));
  write(gui.fonts.body, gui.theme.text, numbers_of(report));
  for (const std::string& sentence : sentences_of(report)) write(gui.fonts.body, gui.theme.text, sentence);
  ImGui::PopTextWrapPos();
  ImGui::EndGroup();
  const float height = ImGui::GetItemRectSize().y + 2 * pad;
  draw.ChannelsSetCurrent(0);
  draw.AddRectFilled(at, {at.x + width, at.y + height}, u32(tone.ground), gui.px(7));
  draw.AddRectFilled(at, {at.x + gui.px(3), at.y + height}, u32(tone.frame), gui.px(7),
                     ImDrawFlags_RoundCornersLeft);
  draw.ChannelsMerge();
  ImGui::SetCursorScreenPos({at.x, at.y + height});
  ImGui::Dummy({width, gui.px(2)});
}

}  // namespace patchlab::viewer
