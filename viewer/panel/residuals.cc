#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "viewer/panel/colours.h"
#include "viewer/panel/panels.h"

namespace patchlab::viewer {

namespace {

constexpr int bins = 32;
constexpr double reach = 4.0;  // standard deviations each side; what lies beyond is in the last bin
constexpr double bin_width = 2 * reach / bins;

struct Histogram {
  std::array<double, bins> share{};  // of all, per standard deviation: comparable with the normal density
  double highest = 0.0;
};

Histogram histogram(const std::vector<double>& residuals) {
  Histogram h;
  const double one = 1.0 / (static_cast<double>(residuals.size()) * bin_width);
  for (const double residual : residuals) {
    const double at = std::clamp((residual + reach) / bin_width, 0.0, bins - 1.0);
    h.share[static_cast<std::size_t>(at)] += one;
  }
  h.highest = *std::max_element(h.share.begin(), h.share.end());
  return h;
}

double normal_density(double x) { return std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi); }

}  // namespace

void draw_residuals(const Gui& gui, const FitReport& report) {
  if (report.residuals.empty()) return;
  section(gui, "RESIDUALS, σ", "line: as the sensor model says");
  const Theme& theme = gui.theme;
  const Histogram h = histogram(report.residuals);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = gui.px(64);
  const double top = std::max(h.highest, normal_density(0.0)) * 1.04;
  const auto x_of = [&](double sigma) {
    return at.x + width * static_cast<float>((sigma + reach) / (2 * reach));
  };
  const auto y_of = [&](double density) { return at.y + height * static_cast<float>(1.0 - density / top); };

  ImDrawList& draw = *ImGui::GetWindowDrawList();
  for (int i = 0; i < bins; ++i) {
    const double from = -reach + i * bin_width, share = h.share[static_cast<std::size_t>(i)];
    if (share == 0.0) continue;
    draw.AddRectFilled({x_of(from) + gui.px(0.5f), y_of(share)},
                       {x_of(from + bin_width) - gui.px(0.5f), at.y + height},
                       u32(with_alpha(theme.accent, 0.55f)));
  }
  std::array<ImVec2, 81> curve;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const double x = -reach + 2 * reach * static_cast<double>(i) / (curve.size() - 1);
    curve[i] = {x_of(x), y_of(normal_density(x))};
  }
  draw.AddPolyline(curve.data(), static_cast<int>(curve.size()), u32(theme.text), 0, gui.px(1.5f));
  draw.AddLine({at.x, at.y + height}, {at.x + width, at.y + height}, u32(theme.line), gui.px(1));
  for (const int tick : {-3, -2, -1, 0, 1, 2, 3}) {
    const std::string label = tick < 0 ? "\u2212" + std::to_string(-tick) : std::to_string(tick);
    const float x = x_of(tick) - text_size(gui.fonts.small, label).x / 2;
    draw_text(draw, gui.fonts.small, {x, at.y + height + gui.px(4)}, theme.text_dim, label);
  }
  ImGui::Dummy({width, height + gui.px(18)});
  tooltip(
      gui,
      "Signed distances of the points to the patch in standard deviations of the noise model. Residuals beyond "
      "4 are in the outermost bars.");
}

}  // namespace patchlab::viewer
