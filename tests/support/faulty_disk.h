// A disk that fails, as a test can have one: it stands between the program and the calls of the C library
// that change a file, for the files of one folder.
//
// What is on the disk for certain is what was there when the file was last synced; what has been written
// since may be lost with the power, wholly or in part.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace patchlab::test {

class FaultyDisk {
 public:
  explicit FaultyDisk(std::filesystem::path folder);  // one at a time
  FaultyDisk(const FaultyDisk&) = delete;
  FaultyDisk& operator=(const FaultyDisk&) = delete;
  ~FaultyDisk();

  // After `calls` more calls, `failures` of them fail with this errno; a write has first written a part.
  void fail(std::size_t calls, int reason, std::size_t failures = 1);
  // What was called since the last time it was asked: "write", "sync", "cut" ("sync folder" for a folder).
  std::vector<std::string> take_calls();
  // Called before each sync of a file takes place.
  std::function<void()> before_sync;
  // Bytes of the file that was synced last which are on the disk for certain.
  std::size_t synced_bytes() const { return synced_bytes_; }

  // For the calls that are stood between.
  struct Verdict {
    int reason = 0;  // 0: let it through
  };
  bool watches(int descriptor) const;
  Verdict judge(const char* call);
  void synced(int descriptor);

 private:
  std::filesystem::path folder_;
  std::vector<std::string> calls_;
  std::size_t until_ = 0, failures_ = 0, synced_bytes_ = 0;
  int reason_ = 0;
};

}  // namespace patchlab::test
