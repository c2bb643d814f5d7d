// Results go to standard output, messages and progress to standard error; progress only to a terminal.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/progress.h"
#include "engine/base/result.h"
#include "engine/export/export.h"

namespace patchlab {

// A sentence on standard error.
void say(std::string_view sentence);

// What a verb leaves: files, and a text for standard output ("-").
class Outputs {
 public:
  void add(std::filesystem::path file, std::string bytes);
  void add(std::filesystem::path place, Exported exported);  // a file or a folder
  // usage error where two results ask for standard output.
  static Result<void> check(const std::vector<std::filesystem::path>& files);
  // Writes all, files first; a file appears whole or not at all.
  Result<int> write() const;

 private:
  std::vector<std::pair<std::filesystem::path, Exported>> results_;
};

// "reading  42 %" on standard error while work goes on; gone when it is destroyed.
class ProgressLine {
 public:
  explicit ProgressLine(std::string what);
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine();

  Progress progress();

 private:
  std::string what_;
  bool on_terminal_;
  int shown_ = -1;  // percent
};

}  // namespace patchlab
