// Logs of what a user did, for tests, pictures and bug reports: one event a line, played against the real
// program.
//
//   click tools/Lasso      a widget by its name, or "click 640 400" a place
//   move 640 400           the pointer, in pixels of the frame
//   press left             a button goes down; release left
//   drag 600 300 700 380   the left button down at the first place, along the others, up at the last
//   wheel -2               notches
//   key Ctrl+Z             a key as the help sheet names it
//   hold Shift             a modifier from now on; hold nothing
//   type mug side          text
//   wait                   until nothing moves and nothing runs in the background
//   # a comment
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace patchlab::viewer {

struct LogEvent {
  enum class Kind { click_widget, click, move, press, release, drag, wheel, key, hold, type, wait } kind;
  int line = 0;
  std::vector<Eigen::Vector2f> places;  // px
  int button = 0;                       // 0 left, 1 right, 2 middle
  float notches = 0;
  std::vector<int> keys;  // key codes, modifiers first
  std::string text;       // widget name or typed text
};

// unreadable error with the line that is wrong.
Result<std::vector<LogEvent>> parse_input_log(std::string_view text, const std::string& name);

}  // namespace patchlab::viewer
