#include "engine/base/folder.h"

#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "engine/base/file.h"

namespace patchlab {
namespace {

namespace fs = std::filesystem;

Error not_written(const fs::path& folder, const std::string& why) {
  return {ErrorCode::unwritable, folder.string() + ": " + why + "; nothing was written."};
}

Result<void> fill(const fs::path& folder,
                  const std::vector<std::pair<std::string, std::string_view>>& files) {
  std::error_code error;
  for (const auto& [name, bytes] : files) {
    const fs::path file = folder / name;
    fs::create_directories(file.parent_path(), error);
    if (error) return not_written(file, "cannot be created: " + error.message());
    const Result<void> written = write_file(file, bytes);
    if (!written) return written.error();
  }
  return {};
}

}  // namespace

Result<void> write_folder(const fs::path& folder,
                          const std::vector<std::pair<std::string, std::string_view>>& files) {
  std::error_code error;
  if (fs::exists(folder, error) && !(fs::is_directory(folder, error) && fs::is_empty(folder, error)))
    return not_written(folder, "is there already; name a new folder");
  fs::path target = folder.lexically_normal();
  if (target.filename().empty()) target = target.parent_path();  // "world/"
  std::string temporary = target.string() + ".XXXXXX";
  if (!::mkdtemp(temporary.data())) {
    const std::error_code why(errno, std::generic_category());
    return not_written(folder, "cannot be created: " + why.message());
  }
  const mode_t mask = ::umask(0);
  ::umask(mask);
  ::chmod(temporary.c_str(), 0777 & ~mask);
  Result<void> filled = fill(temporary, files);
  if (filled) {
    fs::rename(temporary, target, error);
    if (!error) return {};
    filled = not_written(folder, "cannot be put in place: " + error.message());
  }
  fs::remove_all(temporary, error);
  return filled;
}

}  // namespace patchlab
