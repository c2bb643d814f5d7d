// The programs that read exports, run in a folder of their own.
#pragma once

#include <filesystem>
#include <string>

#include "engine/export/export.h"

namespace patchlab::test {

class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path at(const std::string& file) const { return path_ / file; }

 private:
  std::filesystem::path path_;
};

struct Ran {
  int status;
  std::string output;  // of both streams
};
Ran run(const std::string& command);

// Exports to a file or folder there; a failure of the test that asks where that is refused.
std::filesystem::path export_to(const std::filesystem::path& place, const std::string& format,
                                const PatchSet& set, const ExportOptions& options = {});
// The bytes of an export that is one file.
std::string exported_bytes(const std::string& format, const PatchSet& set, const ExportOptions& options = {});

}  // namespace patchlab::test

// Skips the test, by name, where a consumer is not installed.
#define PATCHLAB_NEEDS(program, package)                                       \
  if (patchlab::test::run(std::string("command -v ") + (program)).status != 0) \
  GTEST_SKIP() << "NOT PROVEN: " << (program) << " is not installed (Debian package " << (package) << ")"
