#include "engine/project/journal_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "engine/base/file.h"

namespace patchlab {
namespace {

constexpr std::uint64_t largest = std::uint64_t{256} << 20;  // bytes

// 0, or the errno of what failed.
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return errno;
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return ::fsync(descriptor) == 0 ? 0 : errno;
}

void sync_folder(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

Result<JournalFile> JournalFile::open(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
    return Error{ErrorCode::unreadable,
                 path.string() + ": is not a regular file, so it cannot be a journal."};
  }
  JournalFile file(path, ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NONBLOCK, 0666));
  if (file.descriptor_ < 0) {
    return Error{ErrorCode::unwritable,
                 path.string() + ": cannot be opened for writing: " + std::strerror(errno) + "."};
  }
  if (::flock(file.descriptor_, LOCK_EX | LOCK_NB) != 0) {
    return Error{
        ErrorCode::refused,
        path.string() + ": is open in another patchlab; close it there, or work on a copy of the journal."};
  }
  sync_folder(path);
  return file;
}

JournalFile::JournalFile(JournalFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      length_(std::exchange(other.length_, 0)),
      torn_(std::exchange(other.torn_, false)) {}

JournalFile& JournalFile::operator=(JournalFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(length_, other.length_);
  std::swap(torn_, other.torn_);
  return *this;
}

JournalFile::~JournalFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Result<std::string> JournalFile::read() const {
  struct stat status {};
  if (::fstat(descriptor_, &status) == 0 && status.st_size == 0) return std::string();
  const Result<Bytes> bytes = read_file(path_, largest);
  if (!bytes) return bytes.error();
  return std::string(as_text(*bytes));
}

Result<void> JournalFile::truncate(std::size_t length) {
  const bool done = ::ftruncate(descriptor_, static_cast<off_t>(length)) == 0 && ::fsync(descriptor_) == 0;
  if (!done) return unwritable(errno);
  length_ = length;
  torn_ = false;
  return {};
}

Result<void> JournalFile::append(std::string_view bytes) {
  if (torn_) {
    if (const Result<void> restored = truncate(length_); !restored) return restored;
  }
  torn_ = true;
  if (const int reason = write_all(descriptor_, bytes); reason != 0) {
    const Result<void> restored = truncate(length_);
    return restored ? unwritable(reason) : restored;
  }
  length_ += bytes.size();
  torn_ = false;
  return {};
}

Error JournalFile::unwritable(int reason) const {
  return {ErrorCode::unwritable,
          path_.string() + ": cannot be written: " + std::strerror(reason) +
              "; the last action was not done. Make room, or see to the disk, then do it again."};
}

}  // namespace patchlab
