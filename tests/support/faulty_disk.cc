#include "tests/support/faulty_disk.h"

#include <dlfcn.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

namespace patchlab::test {
namespace {

// What the calls below ask; they have no other way to it.
FaultyDisk*& disk() {
  static FaultyDisk* watching = nullptr;
  return watching;
}

template <class Call>
Call next(const char* name) {
  return reinterpret_cast<Call>(::dlsym(RTLD_NEXT, name));
}

bool is_folder(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && S_ISDIR(status.st_mode);
}

}  // namespace

FaultyDisk::FaultyDisk(std::filesystem::path folder) : folder_(std::filesystem::canonical(folder)) {
  disk() = this;
}
FaultyDisk::~FaultyDisk() { disk() = nullptr; }

void FaultyDisk::fail(std::size_t calls, int reason, std::size_t failures) {
  until_ = calls;
  reason_ = reason;
  failures_ = failures;
}

std::vector<std::string> FaultyDisk::take_calls() { return std::exchange(calls_, {}); }

bool FaultyDisk::watches(int descriptor) const {
  std::error_code failed;
  const auto file = std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(descriptor), failed);
  return !failed && file.string().starts_with(folder_.string());
}

FaultyDisk::Verdict FaultyDisk::judge(const char* call) {
  calls_.emplace_back(call);
  if (failures_ == 0) return {};
  if (until_ > 0) {
    --until_;
    return {};
  }
  --failures_;
  return {reason_};
}

void FaultyDisk::synced(int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) == 0) synced_bytes_ = static_cast<std::size_t>(status.st_size);
}

}  // namespace patchlab::test

using patchlab::test::disk;
using patchlab::test::is_folder;
using patchlab::test::next;

extern "C" {

ssize_t write(int descriptor, const void* bytes, size_t count) {
  static const auto real = next<ssize_t (*)(int, const void*, size_t)>("write");
  if (disk() == nullptr || !disk()->watches(descriptor)) return real(descriptor, bytes, count);
  const auto verdict = disk()->judge("write");
  if (verdict.reason == 0) return real(descriptor, bytes, count);
  (void)!real(descriptor, bytes, count / 2);
  errno = verdict.reason;
  return -1;
}

int fsync(int descriptor) {
  static const auto real = next<int (*)(int)>("fsync");
  if (disk() == nullptr || !disk()->watches(descriptor)) return real(descriptor);
  if (is_folder(descriptor)) {
    (void)disk()->judge("sync folder");
    return real(descriptor);
  }
  if (disk()->before_sync) disk()->before_sync();
  const auto verdict = disk()->judge("sync");
  if (verdict.reason == 0) {
    const int done = real(descriptor);
    disk()->synced(descriptor);
    return done;
  }
  errno = verdict.reason;
  return -1;
}

int ftruncate(int descriptor, off_t length) noexcept {
  static const auto real = next<int (*)(int, off_t)>("ftruncate");
  if (disk() == nullptr || !disk()->watches(descriptor)) return real(descriptor, length);
  const auto verdict = disk()->judge("cut");
  if (verdict.reason == 0) return real(descriptor, length);
  errno = verdict.reason;
  return -1;
}

}  // extern "C"
