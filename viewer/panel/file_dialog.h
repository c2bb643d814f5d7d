// The file dialog: open a scan or journal, save a copy of the journal or a picture, export the patches. Works
// by mouse, by keyboard alone, and without any helper program. The folder is read when it is entered, not
// every frame.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viewer/panel/gui.h"
#include "viewer/panel/view_state.h"

namespace patchlab::viewer {

struct PanelInput;

enum class FilePurpose { open, save_journal, export_patches, save_picture };

class FileDialog {
 public:
  // `name` is what the path box starts with when something is to be written.
  void show(FilePurpose purpose, const std::filesystem::path& folder, const std::string& name = {});
  bool is_open() const { return open_; }
  const std::filesystem::path& folder() const { return folder_; }

  void draw(const PanelInput& in, Requests& out);

 private:
  struct Entry {
    std::string name;
    bool is_folder = false;
    std::uintmax_t size = 0;
  };
  void enter(const std::filesystem::path& folder);
  void draw_list(const Gui& gui, Requests& out);
  // file_options.cc
  void draw_formats(const PanelInput& in);
  void draw_picture_options(const Gui& gui);
  void make_preview(const PanelInput& in);

  void move_cursor();
  std::vector<std::size_t> shown() const;  // entries that the typed text matches
  std::filesystem::path typed_path() const;
  std::optional<std::filesystem::path> chosen() const;
  void confirm(const std::filesystem::path& file, Requests& out);
  void finish(const std::filesystem::path& file, Requests& out);
  void close();

  bool open_ = false;
  FilePurpose purpose_ = FilePurpose::open;
  std::filesystem::path folder_;
  std::string typed_;
  std::string message_;  // what is wrong with the choice, as a sentence
  std::vector<Entry> entries_;
  std::size_t cursor_ = 0;
  std::size_t format_ = 0;
  std::vector<std::string> preview_;  // of the export: what of, then its first lines
  int preview_of_ = -1;               // format
  PictureRequest picture_;
  std::filesystem::path overwrite_;  // asked about once
  bool focus_ = false;
};

}  // namespace patchlab::viewer
