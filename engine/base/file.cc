#include "engine/base/file.h"

#include <fcntl.h>
#include <openssl/sha.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "engine/base/large_pages.h"

namespace patchlab {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int number() const { return number_; }
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

std::string reason() { return std::strerror(errno); }

Error unreadable(const std::string& name, const std::string& why) {
  return {ErrorCode::unreadable, name + ": " + why};
}

std::string megabytes(std::uint64_t bytes) { return std::to_string(bytes >> 20) + " MB"; }

// They stay in the cache from being made to being read.
constexpr std::size_t bytes_a_read = std::size_t{256} << 10;

Result<Bytes> read_to_end(int descriptor, const std::string& name, std::uint64_t limit, std::size_t expected,
                          const Progress& progress) {
  Bytes bytes;
  reserve_large(bytes, expected);
  std::size_t used = 0;
  for (;;) {
    if (used == bytes.size())
      bytes.resize(used < expected ? std::min(used + bytes_a_read, expected) : used + bytes_a_read);
    const double share =
        expected > 0 ? std::min(1.0, static_cast<double>(used) / static_cast<double>(expected)) : 0.0;
    if (!keep_going(progress, share)) return Error{ErrorCode::cancelled, name + ": reading was cancelled."};
    const ssize_t got = ::read(descriptor, bytes.data() + used, bytes.size() - used);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return unreadable(name, "cannot be read: " + reason() + ".");
    if (got == 0) break;
    used += static_cast<std::size_t>(got);
    if (used > limit) return unreadable(name, "is larger than the limit of " + megabytes(limit) + ".");
  }
  bytes.resize(used);
  return bytes;
}

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

// A device or a pipe, which no new file may replace.
Result<void> write_in_place(const std::filesystem::path& file, std::string_view bytes) {
  Descriptor descriptor(::open(file.c_str(), O_WRONLY | O_CLOEXEC));
  const bool written =
      descriptor.number() >= 0 && write_all(descriptor.number(), bytes) && descriptor.close();
  if (!written) return Error{ErrorCode::unwritable, file.string() + ": cannot be written: " + reason() + "."};
  return {};
}

}  // namespace

Result<Bytes> read_file(const std::filesystem::path& file, std::uint64_t limit, const Progress& progress) {
  if (file == "-") return read_to_end(STDIN_FILENO, "standard input", limit, 0, progress);
  const std::string name = file.string();
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return unreadable(name, "cannot be opened: " + reason() + ".");
  if (S_ISDIR(status.st_mode)) return unreadable(name, "is a folder, not a file.");
  if (!S_ISREG(status.st_mode)) return unreadable(name, "is not a regular file (a pipe or a device).");
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size == 0) return unreadable(name, "is empty.");
  if (size > limit) {
    return unreadable(name,
                      "holds " + megabytes(size) + ", more than the limit of " + megabytes(limit) + ".");
  }
  Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (descriptor.number() < 0) return unreadable(name, "cannot be opened: " + reason() + ".");
  return read_to_end(descriptor.number(), name, limit, size + 1, progress);
}

Result<void> write_file(const std::filesystem::path& file, std::string_view bytes) {
  if (file == "-") {
    const bool written =
        std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size() && std::fflush(stdout) == 0;
    if (!written)
      return Error{ErrorCode::unwritable, "standard output: cannot be written: " + reason() + "."};
    return {};
  }
  struct stat status {};
  const bool exists = ::stat(file.c_str(), &status) == 0;
  if (exists && !S_ISREG(status.st_mode)) return write_in_place(file, bytes);
  std::error_code no_link;
  const std::filesystem::path target = exists ? std::filesystem::canonical(file, no_link) : file;
  if (no_link)
    return Error{ErrorCode::unwritable, file.string() + ": cannot be found: " + no_link.message() + "."};
  const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
  std::string temporary = target.string() + ".XXXXXX";
  Descriptor descriptor(::mkostemp(temporary.data(), O_CLOEXEC));
  const auto fail = [&](const std::string& what) {
    const std::string why = reason();
    if (descriptor.number() >= 0) ::unlink(temporary.c_str());
    return Error{ErrorCode::unwritable,
                 file.string() + ": cannot " + what + ": " + why + "; nothing was written."};
  };
  if (descriptor.number() < 0) return fail("be created");
  const mode_t mask = ::umask(0);
  ::umask(mask);
  if (!write_all(descriptor.number(), bytes)) return fail("be written");
  if (::fchmod(descriptor.number(), 0666 & ~mask) != 0 || ::fsync(descriptor.number()) != 0)
    return fail("be saved");
  if (::rename(temporary.c_str(), target.c_str()) != 0) return fail("be put in place");
  Descriptor parent(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (parent.number() >= 0) ::fsync(parent.number());
  return {};
}

std::string sha256(std::string_view bytes) {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
  SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), digest.data());
  std::string text;
  for (const unsigned char byte : digest) {
    constexpr std::string_view digits = "0123456789abcdef";
    text += digits[byte >> 4];
    text += digits[byte & 15];
  }
  return text;
}

}  // namespace patchlab
