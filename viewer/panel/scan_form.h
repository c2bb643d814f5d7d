// What a scan file does not say is asked, never guessed: the camera behind a depth image, the unit of lengths
// that are too large for metres.
#pragma once

#include <filesystem>
#include <string>

#include "viewer/panel/gui.h"
#include "viewer/panel/view_state.h"

namespace patchlab::viewer {

class ScanForm {
 public:
  // `why` is the sentence that the reader said.
  void ask_camera(const std::filesystem::path& file, const std::string& why);
  // Of a scan that is open: it is opened again instead.
  void ask_unit(const std::filesystem::path& file, const std::string& why, const std::string& scan);
  bool is_open() const { return asks_ != Asks::nothing; }

  void draw(const Gui& gui, Requests& out);

 private:
  enum class Asks { nothing, camera, unit };
  void draw_camera(const Gui& gui);
  void draw_unit(const Gui& gui);
  bool read_camera();  // what was typed, into wishes_; otherwise says why not
  void close();

  Asks asks_ = Asks::nothing;
  std::filesystem::path file_;
  std::string why_, scan_;
  std::string camera_;  // four numbers, or a file that holds them
  std::string scale_ = "1000";
  std::string message_;
  bool focus_ = false;
  ScanWishes wishes_;
};

}  // namespace patchlab::viewer
