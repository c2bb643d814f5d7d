// The inspector of a map: what it holds, what it can be merged with, and the matches proposed for that.
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "engine/base/chi_square.h"
#include "viewer/panel/colours.h"
#include "viewer/panel/numbers.h"
#include "viewer/panel/panels.h"

namespace patchlab::viewer {

namespace {

using RefusedPairs = std::vector<std::array<std::string, 2>>;

constexpr double contradiction = 1e-3;  // p of all matches together below which the pose is doubted

std::string called(const Document& document, const std::string& id) {
  if (const MapEntry* map = find_map(document, id)) return map->name;
  const ScanEntry* scan = find_scan(document, id);
  return scan ? scan->name : id;
}

// Other maps, and scans that patches are fitted to.
std::vector<std::string> mergeable(const PanelInput& in, const std::string& map) {
  std::vector<std::string> ids;
  for (const MapEntry& entry : in.document.maps) {
    if (entry.id != map && !map.empty()) ids.push_back(entry.id);
  }
  for (const ScanEntry& scan : in.document.scans) {
    const auto is_of_it = [&](const PatchEntry& patch) {
      return patch.scan == scan.id && patch.id != in.state.draft;
    };
    if (std::ranges::any_of(in.document.patches, is_of_it)) ids.push_back(scan.id);
  }
  return ids;
}

std::string distance_words(const PairDistance& distance) {
  return significant(std::sqrt(distance.chi2), 3) + " σ";
}

std::string match_help(const Match& match) {
  return "χ² " + significant(match.distance.chi2, 3) + " of " + std::to_string(match.distance.dof) + ", " +
         p_value_text(match.distance.p_value) + "; " + significant(100 * match.share, 2) +
         " % of the smaller one is covered by the other. Click to ";
}

void draw_check(const Gui& gui, ImVec2 at, bool checked) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float side = gui.px(15);
  const ImVec2 end = {at.x + side, at.y + side};
  if (!checked) return draw.AddRect(at, end, u32(gui.theme.text_dim), gui.px(4), 0, gui.px(1.5f));
  draw.AddRectFilled(at, end, u32(gui.theme.accent), gui.px(4));
  const ImVec2 tick[] = {{at.x + side * 0.22f, at.y + side * 0.52f},
                         {at.x + side * 0.43f, at.y + side * 0.72f},
                         {at.x + side * 0.79f, at.y + side * 0.30f}};
  draw.AddPolyline(tick, 3, u32(gui.theme.panel), 0, gui.px(2));
}

// As the tree calls it.
std::string name_in(const PatchSet& set, const std::string& id) {
  const auto record = std::ranges::find(set.patches, id, &PatchRecord::id);
  return record == set.patches.end() || record->name.empty() ? id : record->name;
}

void draw_match(const Gui& gui, const MergeProposal& proposal, const Match& match, RefusedPairs& refused) {
  const std::array<std::string, 2> pair = {proposal.map.patches[match.a].id, proposal.view.ids[match.b]};
  const auto at_refused = std::ranges::find(refused, pair);
  const bool accepted = at_refused == refused.end();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = gui.px(26);
  const std::string ids = pair[0] + " = " + pair[1];
  const std::string name = name_in(proposal.set, pair[0]) + " = " + name_in(proposal.added, pair[1]);
  const bool pressed = ImGui::InvisibleButton(ids.c_str(), {width, height});
  gui.note("matches/" + ids);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (ImGui::IsItemHovered()) {
    draw.AddRectFilled({at.x - gui.px(6), at.y}, {at.x + width + gui.px(6), at.y + height},
                       u32(gui.theme.hover), gui.px(5));
  }
  tooltip(gui, match_help(match) + (accepted ? "refuse it." : "accept it."));
  draw_check(gui, {at.x, at.y + (height - gui.px(15)) / 2}, accepted);
  const float y = at.y + (height - gui.fonts.body->FontSize) / 2;
  const std::string distance = distance_words(match.distance);
  const float room = width - gui.px(36) - text_size(gui.fonts.body, distance).x;
  const Rgba& colour = accepted ? gui.theme.text : gui.theme.text_dim;
  draw_text(draw, gui.fonts.body, {at.x + gui.px(24), y}, colour, fit_text(gui.fonts.body, name, room));
  draw_text_right(draw, gui.fonts.body, {at.x + width, y}, gui.theme.text_dim, distance);
  if (!pressed) return;
  if (accepted)
    refused.push_back(pair);
  else
    refused.erase(at_refused);
}

void draw_buttons(const PanelInput& in, bool can_merge, PanelMemory& memory, Requests& out) {
  ImGui::Dummy({0, in.gui.px(4)});
  const Proposed& proposed = in.state.proposed;
  if (button(in.gui, "map/merge", "Merge", {.enabled = can_merge, .strong = can_merge})) {
    out.commands.push_back(Merge{proposed.map, proposed.view, AssociateOptions{}.gate, memory.refused});
    out.propose = ProposalRequest{};
  }
  ImGui::SameLine(0, in.gui.px(8));
  if (button(in.gui, "map/leave", "Leave it")) out.propose = ProposalRequest{};
}

void draw_proposal(const PanelInput& in, PanelMemory& memory, Requests& out) {
  const Gui& gui = in.gui;
  const Proposed& proposed = in.state.proposed;
  const std::string view = called(in.document, proposed.view);
  if (!proposed.matches) {
    section(gui, "MATCHES", "with " + view);
    paragraph(gui, proposed.message.empty() ? gui.theme.text_dim : gui.theme.doubt_text,
              proposed.message.empty() ? "Looking for patches that both see\u2026" : proposed.message);
    return draw_buttons(in, false, memory, out);
  }
  const MergeProposal& proposal = *proposed.matches;
  const std::size_t matches = proposal.found.matches.size(), all = proposal.view.patches.size();
  section(gui, "MATCHES", "with " + view + "; Mahalanobis distance");
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gui.px(8), 0});
  for (const Match& match : proposal.found.matches) draw_match(gui, proposal, match, memory.refused);
  ImGui::PopStyleVar();
  const std::size_t fused = matches - std::min(matches, memory.refused.size());
  paragraph(gui, gui.theme.text_dim, count(fused) + " fused, " + count(all - fused) + " added.");
  const bool contradicts =
      proposal.found.dof > 0 && chi_square_p_value(proposal.found.chi2, proposal.found.dof) < contradiction;
  if (contradicts) {
    paragraph(gui, gui.theme.doubt_text,
              "Together the matches contradict where " + view + " is said to stand: look at its σ.");
  }
  draw_buttons(in, true, memory, out);
}

std::size_t seen_again(const PatchMap& map) {
  return static_cast<std::size_t>(std::ranges::count_if(
      map.patches, [](const MapPatch& patch) { return patch.observations.size() > 1; }));
}

}  // namespace

void draw_merging(const PanelInput& in, const std::string& map, PanelMemory& memory, Requests& out) {
  const bool is_open = !in.state.proposed.view.empty() && in.state.proposed.map == map;
  if (is_open && !map.empty()) return draw_proposal(in, memory, out);
  std::vector<std::string> ids = mergeable(in, map);
  if (map.empty()) std::erase_if(ids, [&](const std::string& id) { return id != in.state.selected; });
  if (ids.empty()) return;
  section(in.gui, map.empty() ? "MAP" : "MERGE INTO IT");
  for (const std::string& id : ids) {
    const std::string text =
        map.empty() ? "Make a map of its patches" : "Patches of " + called(in.document, id);
    if (!button(in.gui, ("map/with " + id).c_str(), text)) continue;
    memory.refused.clear();
    if (map.empty())
      out.commands.push_back(Merge{{}, id, AssociateOptions{}.gate, {}});
    else
      out.propose = ProposalRequest{map, id};
  }
}

void draw_map(const PanelInput& in, const MapEntry& entry, PanelMemory& memory, Requests& out) {
  const Gui& gui = in.gui;
  draw_title(gui, entry.name, "map");
  fact(gui, "patches", count(entry.map->patches.size()));
  fact(gui, "seen more than once", count(seen_again(*entry.map)));
  fact(gui, "frame", entry.map->frame);
  draw_place(in, entry.map->frame, out);
  draw_merging(in, entry.id, memory, out);
}

}  // namespace patchlab::viewer
