#include "viewer/panel/file_dialog.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "engine/export/export.h"
#include "viewer/panel/colours.h"
#include "viewer/panel/numbers.h"
#include "viewer/panel/panels.h"
#include "viewer/platform/key.h"

namespace patchlab::viewer {

namespace fs = std::filesystem;

namespace {

struct PurposeWords {
  const char* title;
  const char* confirm;
  const char* hint;
};
const PurposeWords& words(FilePurpose purpose) {
  static constexpr PurposeWords table[] = {
      {"Open a scan, a map, a robot or a journal", "Open", "type a path, or a part of a name"},
      {"Save a copy of the journal", "Save", "file name"},
      {"Export the patches", "Export", "file name"},
      {"Save a picture", "Save", "file name"},
  };
  return table[static_cast<std::size_t>(purpose)];
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

fs::path home_expanded(const std::string& typed) {
  const char* home = std::getenv("HOME");
  if (home && (typed == "~" || typed.starts_with("~/")))
    return fs::path(home) / typed.substr(std::min<std::size_t>(2, typed.size()));
  return typed;
}

}  // namespace

void FileDialog::show(FilePurpose purpose, const fs::path& folder, const std::string& name) {
  purpose_ = purpose;
  open_ = true;
  enter(folder);
  typed_ = name;
  preview_of_ = -1;
}

void FileDialog::enter(const fs::path& folder) {
  std::error_code error;
  const fs::path absolute = fs::weakly_canonical(fs::absolute(folder, error), error);
  fs::directory_iterator listing(absolute, fs::directory_options::skip_permission_denied, error);
  if (error) {
    message_ = "The folder " + folder.string() + " cannot be listed: " + error.message() + ".";
    return;
  }
  folder_ = absolute;
  entries_.clear();
  for (const fs::directory_entry& file : listing) {
    const std::string name = file.path().filename().string();
    if (name.starts_with(".")) continue;
    const bool is_folder = file.is_directory(error);
    entries_.push_back({name, is_folder, is_folder ? 0 : file.file_size(error)});
  }
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return a.is_folder != b.is_folder ? a.is_folder : lower(a.name) < lower(b.name);
  });
  typed_.clear();
  message_.clear();
  overwrite_.clear();
  cursor_ = 0;
  focus_ = true;
}

fs::path FileDialog::typed_path() const {
  const fs::path typed = home_expanded(typed_);
  return typed.is_absolute() ? typed : folder_ / typed;
}

std::vector<std::size_t> FileDialog::shown() const {
  const bool filters = purpose_ == FilePurpose::open && typed_.find('/') == std::string::npos;
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (!filters || lower(entries_[i].name).find(lower(typed_)) != std::string::npos) indices.push_back(i);
  }
  return indices;
}

// What is typed where it is there or is to be written; else the row at the cursor.
std::optional<fs::path> FileDialog::chosen() const {
  std::error_code error;
  const bool typed_is_there = !typed_.empty() && fs::exists(typed_path(), error);
  const std::vector<std::size_t> rows = shown();
  if (purpose_ == FilePurpose::open && !typed_is_there && !rows.empty()) {
    return folder_ / entries_[rows[std::min(cursor_, rows.size() - 1)]].name;
  }
  if (typed_.empty()) return std::nullopt;
  return typed_path();
}

void FileDialog::close() {
  open_ = false;
  ImGui::CloseCurrentPopup();
}

void FileDialog::confirm(const fs::path& file, Requests& out) {
  std::error_code error;
  if (fs::is_directory(file, error)) return enter(file);
  if (purpose_ == FilePurpose::open && !fs::exists(file, error)) {
    message_ = "There is no file " + file.string() + ".";
    return;
  }
  if (purpose_ != FilePurpose::open && fs::exists(file, error) && overwrite_ != file) {
    overwrite_ = file;
    message_ = "This file exists already. Press again to replace it.";
    return;
  }
  finish(file, out);
}

void FileDialog::finish(const fs::path& file, Requests& out) {
  switch (purpose_) {
    case FilePurpose::open:
      out.open = OpenRequest{file};
      break;
    case FilePurpose::save_journal:
      out.save_journal = file;
      break;
    case FilePurpose::export_patches:
      out.export_to = ExportRequest{std::string(export_formats()[format_].name), file};
      break;
    case FilePurpose::save_picture:
      out.picture = picture_;
      out.picture->file = file;
      break;
  }
  close();
}

void FileDialog::move_cursor() {
  const std::size_t rows = shown().size();
  if (rows == 0) return;
  if (ImGui::IsKeyPressed(key::down)) cursor_ = std::min(cursor_ + 1, rows - 1);
  if (ImGui::IsKeyPressed(key::up) && cursor_ > 0) --cursor_;
  cursor_ = std::min(cursor_, rows - 1);
}

void FileDialog::draw_list(const Gui& gui, Requests& out) {
  ImGui::BeginChild("list", {0, -gui.px(72)});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gui.px(8), 0});
  std::size_t line = 0;
  for (const std::size_t i : shown()) {
    const Entry entry = entries_[i];
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = gui.px(26);
    ImGui::PushID(static_cast<int>(i));
    const bool pressed = ImGui::InvisibleButton("entry", {width, height});
    gui.note("files/" + entry.name);
    ImGui::PopID();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const bool at_cursor = line++ == cursor_;
    if (at_cursor || ImGui::IsItemHovered()) {
      draw.AddRectFilled(at, {at.x + width, at.y + height},
                         u32(at_cursor ? gui.theme.accent_ground : gui.theme.hover), gui.px(5));
    }
    const float y = at.y + (height - gui.fonts.body->FontSize) / 2;
    draw_text(draw, gui.fonts.body, {at.x + gui.px(10), y},
              entry.is_folder ? gui.theme.accent_text : gui.theme.text,
              fit_text(gui.fonts.body, entry.name + (entry.is_folder ? "/" : ""), width - gui.px(110)));
    if (!entry.is_folder) {
      draw_text_right(draw, gui.fonts.small, {at.x + width - gui.px(10), y + gui.px(1)}, gui.theme.text_dim,
                      size_words(entry.size));
    }
    if (!pressed) continue;
    if (entry.is_folder || purpose_ == FilePurpose::open) {
      confirm(folder_ / entry.name, out);
      break;
    }
    typed_ = entry.name;
  }
  ImGui::PopStyleVar();
  ImGui::EndChild();
}

void FileDialog::draw(const PanelInput& in, Requests& out) {
  if (!open_) return;
  const Gui& gui = in.gui;
  if (!begin_dialog(gui, "files", {720, 600})) return;
  ImGui::PushFont(gui.fonts.title);
  ImGui::TextUnformatted(words(purpose_).title);
  ImGui::PopFont();
  if (button(gui, "files/up", "\u2191 Up")) enter(folder_.parent_path());
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  paragraph(gui, gui.theme.text_dim,
            fit_path(gui.fonts.body, folder_.string(), ImGui::GetContentRegionAvail().x));
  if (purpose_ == FilePurpose::export_patches) draw_formats(in);
  if (purpose_ == FilePurpose::save_picture) draw_picture_options(gui);
  move_cursor();
  if (focus_) ImGui::SetKeyboardFocusHere();
  focus_ = false;
  ImGui::SetNextItemWidth(-1);
  const bool entered =
      ImGui::InputTextWithHint("##path", words(purpose_).hint, &typed_, ImGuiInputTextFlags_EnterReturnsTrue);
  gui.note("files/path");
  draw_list(gui, out);
  paragraph(gui, gui.theme.doubt_text, message_);
  const float buttons =
      button_width(gui, "Cancel", "Esc") + button_width(gui, words(purpose_).confirm, "Enter") + gui.px(30);
  ImGui::SetCursorPosX(ImGui::GetWindowWidth() - buttons);
  if (button(gui, "files/cancel", "Cancel", {.key = "Esc"}) || ImGui::IsKeyPressed(key::escape, false))
    close();
  ImGui::SameLine();
  const bool pressed =
      button(gui, "files/confirm", words(purpose_).confirm, {.key = "Enter", .strong = true});
  if (entered || pressed) {
    if (const std::optional<fs::path> file = chosen()) confirm(*file, out);
  }
  end_dialog();
}

}  // namespace patchlab::viewer
