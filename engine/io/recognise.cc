#include "engine/io/recognise.h"

#include <algorithm>

#include "engine/io/depth_image.h"
#include "engine/io/kitti.h"
#include "engine/io/point_table.h"
#include "engine/io/text_numbers.h"

namespace patchlab {
namespace {

constexpr std::size_t sniffed = 64 << 10;  // bytes looked at to recognise a format
constexpr std::string_view convert =
    "; patchlab reads PCD, PLY, OBJ, OFF and STL files, point tables (CSV, XYZ), KITTI scans and depth images (PNG, "
    "PGM): convert it to one of them";

std::string_view first_word(std::string_view bytes) {
  LineReader lines(bytes.substr(0, sniffed));
  while (const auto line = lines.next()) {
    std::string_view text = trimmed(*line);
    if (!text.empty() && text.front() != '#') return next_word(text);
  }
  return {};
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
bool is_off(std::string_view bytes) {
  const std::string_view word = first_word(bytes);
  constexpr std::string_view prefix = "STCN4n";
  return word.ends_with("OFF") && word.size() <= 8 &&
         word.substr(0, word.size() - 3).find_first_not_of(prefix) == std::string_view::npos;
}
bool is_obj(std::string_view bytes) {
  constexpr std::string_view keywords[] = {"v", "vn", "vt", "vp", "f", "o", "g", "s", "mtllib", "usemtl"};
  return one_of(first_word(bytes), keywords);
}
bool is_stl(std::string_view bytes) {
  constexpr std::size_t header = 80, triangle = 50;
  return lower_case(first_word(bytes)) == "solid" ||
         (bytes.size() > header + 4 && (bytes.size() - header - 4) % triangle == 0 &&
          bytes.substr(0, header).find('\n') == std::string_view::npos);
}
bool is_table(std::string_view bytes) { return is_point_table(bytes.substr(0, sniffed)); }
bool is_utf16(std::string_view bytes) {
  return bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF");
}
bool is_netpbm(std::string_view bytes) {
  return bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '7' &&
         (bytes[2] == '\n' || bytes[2] == ' ');
}

struct ReaderRow {
  bool (*matches)(std::string_view bytes);
  ScanReader read;
};
constexpr ReaderRow readers[] = {{is_pcd, read_pcd},          {is_ply, read_ply}, {is_png, read_depth_image},
                                 {is_pgm, read_depth_image},  {is_off, read_off}, {is_obj, read_obj},
                                 {is_table, read_point_table}};

struct EndingRow {
  std::string_view ending;
  bool (*matches)(std::string_view bytes);
  ScanReader read;
};
bool any(std::string_view) { return true; }
constexpr EndingRow endings[] = {
    {".bin", is_kitti, read_kitti},  {".stl", any, read_stl},         {".obj", any, read_obj},
    {".pcd", any, read_pcd},         {".csv", any, read_point_table}, {".xyz", any, read_point_table},
    {".asc", any, read_point_table}, {".pts", any, read_point_table}, {".txt", any, read_point_table}};

struct Magic {
  std::string_view bytes;
  std::string_view
      what;  // and, after a semicolon, what to do about it where that is known better than in general
};
constexpr Magic magics[] = {
    {"ply\r", "a PLY file whose lines end with a carriage return alone; convert the line ends to LF"},
    {"ply", "a PLY file without a header"},
    {"LASF", "a LAS or LAZ file; convert it with PDAL, as in 'pdal translate scan.las scan.ply'"},
    {"ASTM-E57", "an E57 file; convert it with PDAL, as in 'pdal translate scan.e57 scan.ply'"},
    {"#ROSBAG", "a ROS bag; save its clouds as PCD with 'rosrun pcl_ros bag_to_pcd scan.bag TOPIC FOLDER'"},
    {"\x89MCAP",
     "an MCAP recording; play it with 'ros2 bag play' and save its clouds with 'ros2 run pcl_ros pointcloud_to_pcd'"},
    {"SQLite format 3",
     "an SQLite database; if it is a ROS 2 bag, play it with 'ros2 bag play' and save its clouds with 'ros2 run "
     "pcl_ros pointcloud_to_pcd'"},
    {"\xFF\xD8\xFF", "a JPEG image"},
    {"II*", "a TIFF image"},
    {"MM", "a TIFF image"},
    {"glTF", "a glTF file"},
    {"\x89HDF", "an HDF5 file"},
    {"\x93NUMPY", "a NumPy array"},
    {"\x1F\x8B", "a gzip archive; unpack it"},
    {"PK", "a ZIP archive; unpack it"},
    {"\x7F"
     "ELF",
     "a program"},
    {"# vtk", "a VTK file"},
    {"<", "an XML file"},
    {"{", "a JSON document"},
};

bool ends_with(std::string_view name, std::string_view ending) {
  return name.size() >= ending.size() && lower_case(name.substr(name.size() - ending.size())) == ending;
}

const Magic* magic_of(std::string_view bytes) {
  const auto* found =
      std::ranges::find_if(magics, [&](const Magic& magic) { return bytes.starts_with(magic.bytes); });
  return found == std::end(magics) ? nullptr : found;
}

}  // namespace

ScanReader scan_reader(std::string_view bytes, std::string_view name) {
  for (const ReaderRow& row : readers) {
    if (row.matches(bytes)) return row.read;
  }
  if (magic_of(bytes) != nullptr || is_utf16(bytes) || is_netpbm(bytes)) return nullptr;
  for (const EndingRow& row : endings) {
    if (ends_with(name, row.ending) && row.matches(bytes)) return row.read;
  }
  return is_stl(bytes) ? read_stl : nullptr;
}

std::string what_else(std::string_view bytes) {
  std::string what = "in no format that is known here";
  if (const Magic* magic = magic_of(bytes)) what = magic->what;
  if (is_utf16(bytes)) what = "text in UTF-16; save it as UTF-8";
  if (is_netpbm(bytes)) what = "a picture of the PNM family, but no binary grey one (P5) as depth images are";
  return what + (what.find(';') == std::string::npos ? std::string(convert) : "");
}

}  // namespace patchlab
