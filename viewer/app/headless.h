// Running the program without a user: frames until everything is there, logs of events played against it.
#pragma once

#include <vector>

#include "engine/base/result.h"
#include "viewer/app/app.h"
#include "viewer/app/input_log.h"

namespace patchlab::viewer {

// Frames until the app has settled, and what is on the screen with it.
void run_until_settled(App& app, Platform& platform);

// Plays a log. unreadable error where a widget it names is not on the screen.
Result<void> play(const std::vector<LogEvent>& events, App& app, Platform& platform);

}  // namespace patchlab::viewer
