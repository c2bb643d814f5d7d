#include "engine/io/read_scan.h"

#include <algorithm>
#include <new>

#include "engine/base/progress_share.h"
#include "engine/io/read_error.h"
#include "engine/io/recognise.h"

namespace patchlab {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

Result<Scan> dispatch(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  if (bytes.empty()) return unreadable(name, "is empty.");
  if (bytes.starts_with(byte_order_mark)) bytes.remove_prefix(byte_order_mark.size());
  if (const ScanReader read = scan_reader(bytes, name)) return read(bytes, name, options);
  return unreadable(name, "is " + what_else(bytes) + ".");
}

}  // namespace

Result<Scan> read_scan_bytes(std::string_view bytes, const std::string& name,
                             const ReadOptions& options) try {
  Result<Scan> scan = dispatch(bytes, name, options);
  if (scan) scan->file = name;
  return scan;
} catch (const std::bad_alloc&) {
  return unreadable(name, "there is not enough memory to read it.");
}

Result<Scan> read_scan(const std::filesystem::path& file, const ReadOptions& options) {
  const std::string name = file == "-" ? "standard input" : file.string();
  try {
    constexpr double share_of_file = 0.5;
    const Result<Bytes> bytes =
        read_file(file, default_file_limit, share_of(options.progress, 0.0, share_of_file));
    if (!bytes) return bytes.error();
    ReadOptions rest = options;
    rest.progress = share_of(options.progress, share_of_file, 1.0);
    Result<Scan> scan = read_scan_bytes(as_text(*bytes), name, rest);
    if (scan) scan->file = file.string();
    return scan;
  } catch (const std::bad_alloc&) {
    return unreadable(name, "there is not enough memory to read it.");
  }
}

}  // namespace patchlab
