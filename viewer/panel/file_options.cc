// What the file dialog asks beside a name: the format of an export, with what will be written in it, and how
// a picture is made.
#include <algorithm>
#include <sstream>

#include "engine/export/export.h"
#include "viewer/panel/file_dialog.h"
#include "viewer/panel/numbers.h"
#include "viewer/panel/panels.h"

namespace patchlab::viewer {

namespace {

constexpr std::size_t lines_shown = 5, names_shown = 6;

Document without_draft(const Document& document, const std::string& draft) {
  Document kept = document;
  std::erase_if(kept.patches, [&draft](const PatchEntry& entry) { return entry.id == draft; });
  return kept;
}

std::string patch_words(const PatchSet& set) {
  std::string words = count(set.patches.size()) + (set.patches.size() == 1 ? " patch: " : " patches: ");
  for (std::size_t i = 0; i < std::min(set.patches.size(), names_shown); ++i) {
    const PatchRecord& record = set.patches[i];
    words += (i > 0 ? ", " : "") + (record.name.empty() ? record.id : record.name) + " (" +
             short_surface_words(record.patch.type->surface) + ")";
  }
  if (set.patches.size() > names_shown) words += ", \u2026";
  return words;
}

bool is_text(const std::string& bytes) {
  return std::none_of(bytes.begin(), bytes.end(),
                      [](char c) { return c != '\n' && c != '\t' && c >= 0 && c < ' '; });
}

std::vector<std::string> first_lines(const std::string& bytes) {
  std::vector<std::string> lines;
  std::istringstream text(bytes.substr(0, 4000));
  for (std::string line; lines.size() < lines_shown && std::getline(text, line);) lines.push_back(line);
  return lines;
}

}  // namespace

// Made once a format: what is written then.
void FileDialog::make_preview(const PanelInput& in) {
  if (preview_of_ == static_cast<int>(format_)) return;
  preview_of_ = static_cast<int>(format_);
  const PatchSet set = set_to_export(without_draft(in.document, in.state.draft), in.state.selected, {});
  const Result<Exported> made = export_formats()[format_].write(set, {});
  preview_ = {patch_words(set)};
  if (!made) {
    preview_.push_back(made.error().message);
    return;
  }
  std::uintmax_t size = 0;
  for (const ExportedFile& file : made->files) size += file.bytes.size();
  preview_.front() += "  ·  " + size_words(size);
  if (made->files.size() > 1) preview_.front() += " in " + count(made->files.size()) + " files";
  preview_.insert(preview_.end(), made->notices.begin(), made->notices.end());
  if (made->files.empty() || !is_text(made->files.front().bytes)) return;
  const std::vector<std::string> lines = first_lines(made->files.front().bytes);
  preview_.insert(preview_.end(), lines.begin(), lines.end());
  preview_.resize(std::min(preview_.size(), lines_shown + 1));
}

void FileDialog::draw_formats(const PanelInput& in) {
  const Gui& gui = in.gui;
  const auto formats = export_formats();
  const float right = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x;
  for (std::size_t i = 0; i < formats.size(); ++i) {
    const std::string name = "format/" + std::string(formats[i].name);
    if (i > 0) ImGui::SameLine(0, gui.px(6));
    if (i > 0 && ImGui::GetCursorPosX() + button_width(gui, formats[i].name, "") > right) ImGui::NewLine();
    if (button(gui, name.c_str(), formats[i].name, {.chosen = i == format_})) {
      format_ = i;
      typed_ = std::filesystem::path(typed_).replace_extension(formats[i].extension).string();
    }
    tooltip(gui, formats[i].description);
  }
  make_preview(in);
  paragraph(gui, gui.theme.text,
            std::string(formats[format_].description) +
                "; covariance: " + std::string(formats[format_].covariance));
  paragraph(gui, gui.theme.text_dim, preview_.front());
  const float width = ImGui::GetContentRegionAvail().x - gui.px(16);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float line = gui.fonts.small->FontSize + gui.px(3);
  const float height = line * static_cast<float>(preview_.size() - 1) + gui.px(10);
  if (preview_.size() == 1) return;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(at, {at.x + width + gui.px(16), at.y + height}, u32(gui.theme.panel), gui.px(5));
  for (std::size_t i = 1; i < preview_.size(); ++i) {
    draw_text(draw, gui.fonts.small, {at.x + gui.px(8), at.y + gui.px(5) + line * static_cast<float>(i - 1)},
              gui.theme.text_dim, fit_text(gui.fonts.small, preview_[i], width));
  }
  ImGui::Dummy({width, height});
}

void FileDialog::draw_picture_options(const Gui& gui) {
  const auto choose = [&gui](const char* name, const char* text, bool chosen) {
    const bool pressed = button(gui, name, text, {.chosen = chosen});
    ImGui::SameLine(0, gui.px(6));
    return pressed;
  };
  if (choose("picture/window", "Window", !picture_.view_alone))
    picture_.view_alone = picture_.transparent = false;
  if (choose("picture/view", "View alone", picture_.view_alone)) picture_.view_alone = true;
  ImGui::Dummy({gui.px(10), 1});
  ImGui::SameLine();
  if (choose("picture/1", "as large", picture_.times == 1)) picture_.times = 1;
  if (choose("picture/2", "2 times", picture_.times == 2)) picture_.times = 2;
  if (choose("picture/4", "4 times", picture_.times == 4)) picture_.times = 4;
  ImGui::Dummy({gui.px(10), 1});
  ImGui::SameLine();
  if (choose("picture/transparent", "no ground", picture_.transparent)) {
    picture_.transparent = !picture_.transparent;
    picture_.view_alone = picture_.view_alone || picture_.transparent;
  }
  ImGui::NewLine();
}

}  // namespace patchlab::viewer
