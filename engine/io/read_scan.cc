#include "engine/io/read_scan.h"

#include <algorithm>
#include <new>

#include "engine/io/point_table.h"
#include "engine/io/read_error.h"
#include "engine/io/text_numbers.h"

namespace patchlab {
namespace {

constexpr std::size_t sniffed = 64 << 10;  // bytes looked at to recognise a format
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
constexpr std::string_view convert =
    "; patchlab reads PCD and PLY files and point tables (CSV with a header row x,y,z): convert it to one of them";

using Reader = Result<Scan> (*)(std::string_view bytes, const std::string& name, const ReadOptions& options);

// The first line that is neither empty nor a comment.
std::string_view first_line(std::string_view bytes) {
  LineReader lines(bytes.substr(0, sniffed));
  while (const auto line = lines.next()) {
    const std::string_view text = trimmed(*line);
    if (!text.empty() && text.front() != '#') return text;
  }
  return {};
}

std::string_view first_word(std::string_view bytes) {
  std::string_view line = first_line(bytes);
  return next_word(line);
}

template <std::size_t N>
bool one_of(std::string_view word, const std::string_view (&words)[N]) {
  return std::ranges::find(words, word) != std::end(words);
}

bool is_pcd(std::string_view bytes) {
  constexpr std::string_view first_entries[] = {"VERSION", "FIELDS", "COLUMNS"};
  return bytes.starts_with("# .PCD") || one_of(first_word(bytes), first_entries);
}
bool is_ply(std::string_view bytes) { return bytes.starts_with("ply\n") || bytes.starts_with("ply\r\n"); }
bool is_point_table(std::string_view bytes) { return is_point_table_header(first_line(bytes)); }
bool is_off(std::string_view bytes) {
  constexpr std::string_view magic[] = {"OFF", "COFF", "NOFF", "CNOFF", "STOFF", "4OFF", "nOFF"};
  return one_of(first_word(bytes), magic);
}
bool is_obj(std::string_view bytes) {
  constexpr std::string_view entries[] = {"v", "vn", "vt", "vp", "f", "o", "g", "s", "mtllib", "usemtl"};
  return one_of(first_word(bytes), entries);
}
bool is_stl(std::string_view bytes) {
  constexpr std::size_t header = 80, triangle = 50;
  return bytes.starts_with("solid") ||
         (bytes.size() >= header + 4 && (bytes.size() - header - 4) % triangle == 0 &&
          bytes.substr(0, header).find('\n') == std::string_view::npos);
}
bool is_numbers(std::string_view bytes) {
  std::string word(first_word(bytes));
  const std::size_t end = word.find_first_of(",;\t");
  return parse_number<double>(std::string_view(word).substr(0, end)).has_value();
}
bool is_netpbm(std::string_view bytes) {
  return bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '7' &&
         (bytes[2] == '\n' || bytes[2] == ' ');
}
bool is_utf16(std::string_view bytes) {
  return bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF");
}

struct ReaderRow {
  bool (*matches)(std::string_view bytes);
  Reader read;
};
constexpr ReaderRow readers[] = {{is_pcd, read_pcd}, {is_ply, read_ply}, {is_point_table, read_point_table}};

struct Magic {
  std::string_view bytes;
  std::string_view what;
};
constexpr Magic magics[] = {
    {"ply\r", "a PLY file whose lines end with a carriage return alone; convert the line ends to LF"},
    {"ply", "a PLY file without a header"},
    {"LASF", "a LAS or LAZ file"},
    {"ASTM-E57", "an E57 file"},
    {"\x89PNG", "a PNG image"},
    {"\xFF\xD8\xFF", "a JPEG image"},
    {"II*", "a TIFF image"},
    {"MM", "a TIFF image"},
    {"glTF", "a glTF file"},
    {"#ROSBAG", "a ROS bag"},
    {"\x89MCAP", "an MCAP recording"},
    {"\x89HDF", "an HDF5 file"},
    {"\x93NUMPY", "a NumPy array"},
    {"\x1F\x8B", "a gzip archive"},
    {"PK", "a ZIP archive"},
    {"\x7F"
     "ELF",
     "a program"},
    {"# vtk", "a VTK file"},
    {"<", "an XML file"},
    {"{", "a JSON document"},
};

struct Recognised {
  bool (*matches)(std::string_view bytes);
  std::string_view what;  // and, after a semicolon, what to do about it where it is not to convert the file
};
constexpr Recognised others[] = {
    {is_utf16, "text in UTF-16; save it as UTF-8"},
    {is_netpbm, "a PGM or PPM image"},
    {is_off, "an OFF mesh"},
    {is_obj, "an OBJ mesh"},
    {is_numbers,
     "a table of numbers without a header row; name its columns in the first line, as in 'x,y,z'"},
    {is_stl, "an STL mesh"},
};

std::string_view recognise(std::string_view bytes) {
  for (const Magic& magic : magics) {
    if (bytes.starts_with(magic.bytes)) return magic.what;
  }
  for (const Recognised& other : others) {
    if (other.matches(bytes)) return other.what;
  }
  return "in no format that is known here";
}

Result<Scan> dispatch(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  if (bytes.empty()) return unreadable(name, "is empty.");
  if (bytes.starts_with(byte_order_mark)) bytes.remove_prefix(byte_order_mark.size());
  for (const ReaderRow& row : readers) {
    if (row.matches(bytes)) return row.read(bytes, name, options);
  }
  const std::string what(recognise(bytes));
  const bool says_what_to_do = what.find(';') != std::string::npos;
  return unreadable(name, "is " + what + (says_what_to_do ? "" : std::string(convert)) + ".");
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
    const Result<Bytes> bytes = read_file(file);
    if (!bytes) return bytes.error();
    Result<Scan> scan = read_scan_bytes(as_text(*bytes), name, options);
    if (scan) scan->file = file.string();
    return scan;
  } catch (const std::bad_alloc&) {
    return unreadable(name, "there is not enough memory to read it.");
  }
}

}  // namespace patchlab
