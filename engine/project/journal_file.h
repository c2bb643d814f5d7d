// The file of a journal, open for one program alone. What append() acknowledges is on the disk; what it
// refuses has left no trace.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace patchlab {

class JournalFile {
 public:
  // Opens or creates it. Errors: refused where another program has it open, unreadable, unwritable.
  static Result<JournalFile> open(const std::filesystem::path& path);

  JournalFile(JournalFile&& other) noexcept;
  JournalFile& operator=(JournalFile&& other) noexcept;
  ~JournalFile();

  const std::filesystem::path& path() const { return path_; }
  Result<std::string> read() const;
  // Cuts the file to its first `length` bytes.
  Result<void> truncate(std::size_t length);
  // Appends and syncs all of `bytes`, or none.
  Result<void> append(std::string_view bytes);

 private:
  JournalFile(std::filesystem::path path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}
  Error unwritable(int reason) const;

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::size_t length_ = 0;  // of what is acknowledged
  bool torn_ = false;       // the file may hold more than that, of an append that failed
};

}  // namespace patchlab
