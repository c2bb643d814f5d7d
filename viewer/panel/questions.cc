// A patch of a map or robot in the inspector, and questions about any patch: its tilt, and how it lies to
// another one.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "viewer/panel/numbers.h"
#include "viewer/panel/panels.h"

namespace patchlab::viewer {

namespace {

constexpr double one_degree = std::numbers::pi / 180.0;
constexpr double least_limit = 1.0, most_limit = 60.0;  // degrees

std::string length_words(const Estimate& estimate) {
  const Measured words = measured(estimate.value, estimate.sigma, Dimension::length);
  return words.value + "  " + words.sigma;
}

std::string angle_words(const Estimate& estimate) {
  return fixed(estimate.value / one_degree, 2) + "°  ± " + significant(estimate.sigma / one_degree, 2) + "°";
}

std::string probability_words(double p) {
  if (p > 0.0 && p < 1e-4) return "< 0.01 %";
  if (p < 1.0 && p > 1.0 - 1e-4) return "> 99.99 %";
  return significant(100.0 * p, 3) + " %";
}

void draw_slope(const PanelInput& in, Requests& out) {
  const Gui& gui = in.gui;
  const Questions& asked = in.state.questions;
  if (!asked.slope) return;
  const std::string frame = shown_frame(in.document);
  fact(gui, std::string("tilt against ") + up_in(frame).axis + " of " + frame,
       angle_words(asked.slope->tilt));
  fact(gui, "steeper than " + fixed(asked.limit / one_degree, 0) + "°",
       probability_words(asked.slope->exceeds));
  double part = (asked.limit / one_degree - least_limit) / (most_limit - least_limit);
  if (slider(gui, "questions/limit", part))
    out.tilt_limit = std::round(least_limit + part * (most_limit - least_limit)) * one_degree;
}

void draw_chooser(const PanelInput& in, const std::string& patch, Requests& out) {
  const Gui& gui = in.gui;
  const std::optional<PlacedPatch> other = find_placed(in.document, in.state.questions.other);
  ImGui::SetNextItemWidth(-1);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {gui.px(8), gui.px(5)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {gui.px(8), gui.px(8)});
  const std::string shown =
      other && other->id != patch ? "against " + other->name : "against another patch\u2026";
  const bool open = ImGui::BeginCombo("##against", shown.c_str(), ImGuiComboFlags_HeightLarge);
  gui.note("questions/against");
  if (open) {
    for (const PlacedPatch& one : placed_patches(in.document)) {
      if (one.id == patch || one.id == in.state.draft) continue;
      if (ImGui::Selectable((one.name + "##" + one.id).c_str(), one.id == in.state.questions.other))
        out.ask_about = one.id;
      gui.note("questions/" + one.name);
    }
    close_on_escape();
    ImGui::EndCombo();
  }
  ImGui::PopStyleVar(2);
}

void draw_observations(const Gui& gui, const MapPatch& patch) {
  if (patch.observations.empty()) return;
  section(gui, "SEEN", "squared distance when it was fused");
  for (const Observation& seen : patch.observations) {
    const std::string where = seen.source.empty() ? seen.id : seen.source + ", " + seen.id;
    fact(gui, where, seen.dof > 0 ? significant(seen.chi2, 3) + " of " + std::to_string(seen.dof) : "first");
  }
}

std::string owner_words(const Document& document, const PlacedPatch& placed) {
  if (placed.of == PatchOf::robot)
    return "link " + placed.frame + " of " + find_robot(document, placed.owner)->name;
  return "map " + find_map(document, placed.owner)->name;
}

}  // namespace

void draw_questions(const PanelInput& in, const std::string& patch, Requests& out) {
  const Gui& gui = in.gui;
  const bool has_others = placed_patches(in.document).size() > 1;
  if (!in.state.questions.slope && !has_others) return;
  section(gui, "QUESTIONS");
  draw_slope(in, out);
  if (!has_others) return;
  draw_chooser(in, patch, out);
  if (const std::optional<Relation>& relation = in.state.questions.relation) {
    fact(gui, "centres apart", length_words(relation->distance));
    fact(gui, "angle of the normals", angle_words(relation->angle));
    fact(gui, "gap", length_words(relation->foot.gap));
    fact(gui, "rocking", length_words(relation->foot.rocking));
    fact(gui, "within its bounds", fixed(100.0 * relation->foot.share, 0) + " %");
  }
  if (in.state.questions.message.empty()) return;
  paragraph(gui, gui.theme.doubt_text, in.state.questions.message);
}

void draw_placed_patch(const PanelInput& in, const PlacedPatch& placed, Requests& out) {
  const Gui& gui = in.gui;
  const Result<Patch> patch = as_shown(in.document, placed);
  if (!patch) return;
  draw_title(gui, placed.name, kind_words(*patch->type));
  fact(gui, "of", owner_words(in.document, placed));
  draw_questions(in, placed.id, out);
  draw_parameters(gui, *patch);
  draw_correlation(gui, *patch);
  if (placed.of != PatchOf::map) return;
  const std::vector<MapPatch>& patches = find_map(in.document, placed.owner)->map->patches;
  const std::string id = placed.id.substr(placed.owner.size() + 1);
  draw_observations(gui, *std::ranges::find(patches, id, &MapPatch::id));
}

}  // namespace patchlab::viewer
