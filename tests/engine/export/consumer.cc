#include "tests/engine/export/consumer.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>

namespace patchlab::test {

namespace fs = std::filesystem;

Folder::Folder() {
  std::string pattern = (fs::temp_directory_path() / "patchlab_export_XXXXXX").string();
  path_ = ::mkdtemp(pattern.data());
}

Folder::~Folder() { fs::remove_all(path_); }

Ran run(const std::string& command) {
  Ran ran{-1, {}};
  FILE* const pipe = ::popen(("{ " + command + "; } 2>&1").c_str(), "r");
  if (!pipe) return ran;
  std::array<char, 4096> bytes{};
  for (std::size_t got; (got = std::fread(bytes.data(), 1, bytes.size(), pipe)) > 0;)
    ran.output.append(bytes.data(), got);
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) ran.status = WEXITSTATUS(status);
  return ran;
}

fs::path export_to(const fs::path& place, const std::string& format, const PatchSet& set,
                   const ExportOptions& options) {
  const Result<Exported> exported = export_patches(**export_format(format), set, options);
  if (!exported) {
    ADD_FAILURE() << exported.error().message;
    return place;
  }
  const Result<void> written = write_exported(*exported, place);
  if (!written) ADD_FAILURE() << written.error().message;
  return place;
}

std::string exported_bytes(const std::string& format, const PatchSet& set, const ExportOptions& options) {
  const Result<Exported> exported = export_patches(**export_format(format), set, options);
  if (exported && exported->files.size() == 1) return exported->files.front().bytes;
  ADD_FAILURE() << (exported ? "several files" : exported.error().message);
  return {};
}

}  // namespace patchlab::test
