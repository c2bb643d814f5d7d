#include "viewer/panel/colours.h"
#include "viewer/panel/numbers.h"
#include "viewer/panel/panels.h"

namespace patchlab::viewer {

namespace {

void draw_keep_line(const PanelInput& in, Requests& out) {
  const Gui& gui = in.gui;
  ImGui::Dummy({0, gui.px(2)});
  if (button(gui, "inspector/keep", "Keep patch", {.key = "Enter", .strong = true}))
    out.actions.push_back(Action::keep);
  ImGui::SameLine(0, gui.px(8));
  if (button(gui, "inspector/discard", "Discard", {.key = "Esc"})) out.actions.push_back(Action::cancel);
}

void draw_method(const Gui& gui, const PatchEntry& entry) {
  const FitReport& report = entry.fit->report;
  section(gui, "HOW IT WAS FITTED");
  fact(gui, "method", std::string(name(report.method)));
  fact(gui, "bounds",
       std::string(name(report.bounds)) + ", containment " + significant(report.containment * 100, 3) + " %");
  fact(gui, "residuals, rms", quantity(report.residual_rms, Dimension::length, 2));
  fact(gui, "coverage", significant(report.coverage * 100, 2) + " %");
  fact(gui, "iterations", std::to_string(report.iterations) + (report.converged ? "" : ", not converged"));
}

void draw_patch(const PanelInput& in, const PatchEntry& entry, PanelMemory& memory, Requests& out) {
  if (!entry.fit) return;
  const FitResult& fit = *entry.fit;
  draw_title(in.gui, entry.name, kind_words(*fit.patch.type));
  draw_verdict(in.gui, fit.report);
  if (in.state.draft == entry.id) draw_keep_line(in, out);
  if (const ScanEntry* scan = find_scan(in.document, entry.scan)) draw_noise(in.gui, *scan, memory, out);
  draw_parameters(in.gui, fit.patch);
  draw_correlation(in.gui, fit.patch);
  draw_residuals(in.gui, fit.report);
  draw_candidates(in.gui, fit.report, fit.patch.type->surface, out);
  if (in.state.draft != entry.id) draw_questions(in, entry.id, out);
  draw_method(in.gui, entry);
}

void draw_region(const PanelInput& in, const RegionEntry& entry, PanelMemory& memory, Requests& out) {
  const Gui& gui = in.gui;
  draw_title(gui, entry.name, "region");
  fact(gui, "points", count(entry.points ? entry.points->size() : 0));
  if (const ScanEntry* scan = find_scan(in.document, entry.scan)) {
    fact(gui, "of scan", scan->name);
    draw_noise(gui, *scan, memory, out);
  }
  if (in.state.currency != Currency::failed || in.state.fit_message.empty()) return;
  section(gui, "NO PATCH");
  paragraph(gui, gui.theme.doubt_text, in.state.fit_message);
}

std::string position_text(const Eigen::Vector3d& p) {
  return fixed(p.x(), 3) + ",  " + fixed(p.y(), 3) + ",  " + fixed(p.z(), 3) + " m";
}

void draw_scan(const PanelInput& in, const ScanEntry& entry, PanelMemory& memory, Requests& out) {
  const Gui& gui = in.gui;
  draw_title(gui, entry.name, "scan");
  if (!entry.scan) return;
  const Scan& scan = *entry.scan;
  fact(gui, "file", scan.file, true);
  fact(gui, "format", scan.format + (scan.encoding.empty() ? "" : ", " + scan.encoding));
  fact(gui, "points", count(scan.size()));
  fact(gui, "finite", count(scan.finite_count));
  fact(gui, "pixel grid", scan.organized() ? count(scan.width) + " × " + count(scan.height) : "none");
  draw_noise(gui, entry, memory, out);
  section(gui, "SENSOR");
  if (scan.viewpoints.empty()) {
    fact(gui, "position", position_text(scan.viewpoint.position));
    fact(gui, "stated in the file", scan.viewpoint.stated ? "yes" : "no");
  } else {
    fact(gui, "positions", "one a point, stated in the file");
  }
  if (const std::optional<Bounds> box = bounds(scan)) {
    section(gui, "BOUNDS");
    fact(gui, "from", position_text(box->min));
    fact(gui, "to", position_text(box->max));
  }
  draw_merging(in, {}, memory, out);
  if (!scan.notices.empty()) section(gui, "NOTICES");
  for (const std::string& notice : scan.notices) paragraph(gui, gui.theme.text, notice);
}

void draw_earlier_work(const PanelInput& in, const EarlierWork& work, Requests& out) {
  const Gui& gui = in.gui;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = gui.px(26);
  if (ImGui::InvisibleButton(work.journal.c_str(), {width, height})) out.open = OpenRequest{work.journal};
  gui.note("earlier/" + work.scan);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (ImGui::IsItemHovered()) {
    draw.AddRectFilled({at.x - gui.px(6), at.y}, {at.x + width + gui.px(6), at.y + height},
                       u32(gui.theme.hover), gui.px(5));
  }
  tooltip(gui, work.journal.string());
  const float y = at.y + (height - gui.fonts.body->FontSize) / 2;
  const float room = width - text_size(gui.fonts.small, work.remark).x - gui.px(12);
  draw_text(draw, gui.fonts.body, {at.x, y}, gui.theme.text, fit_text(gui.fonts.body, work.scan, room));
  draw_text_right(draw, gui.fonts.small, {at.x + width, y + gui.px(1)}, gui.theme.text_dim, work.remark);
}

void draw_welcome(const PanelInput& in, Requests& out) {
  const Gui& gui = in.gui;
  draw_title(gui, "patchlab", "");
  paragraph(
      gui, gui.theme.text_dim,
      "Bounded curved patches with honest uncertainty, from range scans. Open a scan, draw a lasso round a surface, "
      "and the patch follows.");
  ImGui::Dummy({0, gui.px(6)});
  if (button(gui, "inspector/open", "Open a scan", {.key = "Ctrl+O", .strong = true})) {
    out.actions.push_back(Action::open_file);
  }
  if (!in.state.earlier.empty()) section(gui, "GO ON WITH", "nothing of it was lost");
  for (const EarlierWork& work : in.state.earlier) draw_earlier_work(in, work, out);
}

}  // namespace

void draw_title(const Gui& gui, const std::string& title, const std::string& kind) {
  ImGui::Dummy({0, gui.px(2)});
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const float kind_width = text_size(gui.fonts.body, kind).x;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw_text(draw, gui.fonts.title, at, gui.theme.text,
            fit_text(gui.fonts.title, title, width - kind_width - gui.px(12)));
  const float drop = gui.fonts.title->FontSize - gui.fonts.body->FontSize;
  draw_text_right(draw, gui.fonts.body, {at.x + width, at.y + drop / 2}, gui.theme.text_dim, kind);
  ImGui::Dummy({width, gui.fonts.title->FontSize + gui.px(4)});
}

void draw_inspector(const PanelInput& in, PanelMemory& memory, Requests& out) {
  const Gui& gui = in.gui;
  begin_panel("inspector", in.layout.inspector, gui.theme.panel, {gui.px(18), gui.px(10)}, true);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gui.px(8), gui.px(4)});
  if (const PatchEntry* patch = find_patch(in.document, in.state.selected)) {
    draw_patch(in, *patch, memory, out);
  } else if (const RegionEntry* region = find_region(in.document, in.state.selected)) {
    draw_region(in, *region, memory, out);
  } else if (const ScanEntry* scan = find_scan(in.document, in.state.selected)) {
    draw_scan(in, *scan, memory, out);
  } else if (const MapEntry* map = find_map(in.document, in.state.selected)) {
    draw_map(in, *map, memory, out);
  } else if (const RobotEntry* robot = find_robot(in.document, in.state.selected)) {
    draw_robot(in, *robot, memory, out);
  } else if (const std::optional<PlacedPatch> placed = find_placed(in.document, in.state.selected)) {
    draw_placed_patch(in, *placed, out);
  } else if (in.document.scans.empty()) {
    draw_welcome(in, out);
  }
  ImGui::PopStyleVar();
  end_panel();
}

}  // namespace patchlab::viewer
