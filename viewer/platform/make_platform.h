// The two kinds of platform, made by make_platform.
#pragma once

#include "viewer/platform/platform.h"

namespace patchlab::viewer {

Result<std::unique_ptr<Platform>> make_window_platform(const PlatformOptions& options);
Result<std::unique_ptr<Platform>> make_headless_platform(const PlatformOptions& options);

}  // namespace patchlab::viewer
