#include "engine/cli/output.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace patchlab {

void say(std::string_view sentence) {
  std::fwrite(sentence.data(), 1, sentence.size(), stderr);
  std::fputc('\n', stderr);
}

void Outputs::add(std::filesystem::path file, std::string bytes) {
  results_.emplace_back(std::move(file), Exported{{{"", std::move(bytes)}}, {}});
}

void Outputs::add(std::filesystem::path place, Exported exported) {
  results_.emplace_back(std::move(place), std::move(exported));
}

Result<void> Outputs::check(const std::vector<std::filesystem::path>& files) {
  if (std::ranges::count(files, std::filesystem::path("-")) < 2) return {};
  return Error{ErrorCode::usage,
               "Two results cannot both go to standard output; name a file for one of them."};
}

Result<int> Outputs::write() const {
  for (const bool to_files : {true, false}) {
    for (const auto& [place, exported] : results_) {
      if ((place != "-") != to_files) continue;
      const Result<void> written = write_exported(exported, place);
      if (!written) return written.error();
    }
  }
  return 0;
}

ProgressLine::ProgressLine(std::string what)
    : what_(std::move(what)), on_terminal_(::isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
  if (shown_ >= 0) std::fputs("\r\033[K", stderr);
}

Progress ProgressLine::progress() {
  if (!on_terminal_) return {};
  return [this](double fraction) {
    const int percent = static_cast<int>(100.0 * std::clamp(fraction, 0.0, 1.0));
    if (percent != shown_) std::fprintf(stderr, "\r\033[K%s %3d %%", what_.c_str(), percent);
    shown_ = percent;
    return true;
  };
}

}  // namespace patchlab
