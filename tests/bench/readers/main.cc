// readers_bench [--points N] [--page FILE]: how long files of points with colours take to read, beside fread
// of the same bytes and PCL's readers. Files lie in the page cache.
#include <malloc.h>
#include <stdlib.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <string_view>
#include <vector>

#include "engine/io/read_scan.h"
#include "tests/bench/readers/pcl_readers.h"
#include "tests/bench/round_robin/round_robin.h"

namespace patchlab::bench {
namespace {

namespace fs = std::filesystem;

struct ColouredPoint {
  float x, y, z;
  std::uint8_t red, green, blue;
};

std::vector<ColouredPoint> spiral(std::size_t points) {
  std::vector<ColouredPoint> all;
  all.reserve(points);
  for (std::size_t i = 0; i < points; ++i) {
    const float t = static_cast<float>(i) * 1e-4F;
    all.push_back({std::cos(t), std::sin(t), 1.0F + t * 1e-3F, static_cast<std::uint8_t>(i), 100, 200});
  }
  return all;
}

template <class... Values>
void append(std::string& bytes, const Values&... values) {
  (bytes.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
}

std::string pcd(const std::vector<ColouredPoint>& points, bool text) {
  const std::string n = std::to_string(points.size());
  std::string file = "VERSION .7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH " + n +
                     "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + n + "\nDATA " +
                     (text ? "ascii\n" : "binary\n");
  char line[96];
  for (const ColouredPoint& p : points) {
    const std::uint32_t rgb = std::uint32_t{p.red} << 16U | std::uint32_t{p.green} << 8U | p.blue;
    if (text) {
      const int length = std::snprintf(line, sizeof line, "%.9g %.9g %.9g %u\n", static_cast<double>(p.x),
                                       static_cast<double>(p.y), static_cast<double>(p.z), rgb);
      file.append(line, static_cast<std::size_t>(length));
    } else {
      append(file, p.x, p.y, p.z, rgb);
    }
  }
  return file;
}

std::string ply(const std::vector<ColouredPoint>& points) {
  std::string file =
      "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(points.size()) +
      "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar "
      "green\nproperty uchar blue\nend_header\n";
  for (const ColouredPoint& p : points) append(file, p.x, p.y, p.z, p.red, p.green, p.blue);
  return file;
}

void plain_read(const std::string& file, std::size_t size) {
  const std::unique_ptr<char[]> memory(new char[size]);
  std::FILE* const in = std::fopen(file.c_str(), "rb");
  const bool whole = in != nullptr && std::fread(memory.get(), 1, size, in) == size;
  if (in != nullptr) std::fclose(in);
  if (!whole) std::exit(1);
}

std::string line(const fs::path& folder, const std::string& words, const std::string& name,
                 const std::string& bytes, std::size_t points) {
  const std::string file = folder / name;
  std::ofstream(file, std::ios::binary) << bytes;
  bool right = true;
  RoundRobin times(11);
  times.add("fread", [&] { plain_read(file, bytes.size()); });
  times.add("ours", [&] {
    const Result<Scan> scan = read_scan(file);
    right = right && scan && scan->finite_count == points && scan->colours.size() == points;
  });
  if (has_pcl_readers()) times.add("PCL", [&] { right = right && read_by_pcl(file) == points; });
  times.run();
  if (!right) std::exit(1);
  char size[32];
  std::snprintf(size, sizeof size, "%.0f MB", 1e-6 * static_cast<double>(bytes.size()));
  return "| " + words + ", " + size + " | " + time_of(times, "fread") + " | " + time_of(times, "ours") +
         ", " + ratio_of(times, "ours", "fread") + " | " + time_of(times, "PCL") + " | " +
         ratio_of(times, "PCL", "ours") + " |\n";
}

std::size_t points_asked(int argc, char** argv) {
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::string_view(argv[i]) == "--points") return static_cast<std::size_t>(std::atoll(argv[i + 1]));
  }
  return 1'000'000;
}

}  // namespace
}  // namespace patchlab::bench

int main(int argc, char** argv) {
  using namespace patchlab::bench;
  mallopt(M_MMAP_THRESHOLD,
          1 << 16);  // memory is new to each reader, as it is to a program that reads one file
  std::string pattern = (fs::temp_directory_path() / "patchlab_readers_XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) return 1;
  const std::vector<ColouredPoint> points = spiral(points_asked(argc, argv));
  const std::size_t n = points.size();
  std::string text =
      date_and_machine() + ". Files of " + std::to_string(n) +
      " points with colours, in the page cache, into new memory. Medians of processor time, half of the middle half as ±.\n\n"
      "| file | `fread` | `read_scan`, times `fread` | PCL | PCL, times `read_scan` |\n|---|---|---|---|---|\n";
  text += line(pattern, "PCD, binary", "binary.pcd", pcd(points, false), n);
  text += line(pattern, "PLY, binary", "binary.ply", ply(points), n);
  text += line(pattern, "PCD, text", "text.pcd", pcd(points, true), n);
  fs::remove_all(pattern);
  return report(argc, argv, "readers", text);
}
