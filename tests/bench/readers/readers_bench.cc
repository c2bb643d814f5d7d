// How long scans take to read, beside a plain read of the same bytes in the same run: read/ is ::read into
// memory of its own, scan/ is read_scan. Files of 5 million points unless --points says otherwise.
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>

#include "engine/io/read_scan.h"

namespace patchlab {
namespace {

namespace fs = std::filesystem;

std::string points_as_bytes(std::size_t points) {
  std::string bytes(points * 12, '\0');
  for (std::size_t i = 0; i < points; ++i) {
    const float t = static_cast<float>(i) * 1e-4F;
    const float point[3] = {std::cos(t), std::sin(t), 1.F + t * 1e-3F};
    std::memcpy(bytes.data() + 12 * i, point, sizeof point);
  }
  return bytes;
}

std::string pcd_header(std::size_t points) {
  const std::string n = std::to_string(points);
  return "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + n +
         "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + n + "\nDATA binary\n";
}
std::string ply_header(std::size_t points) {
  return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(points) +
         "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
}

void write(const fs::path& file, const std::string& header, const std::string& data) {
  std::ofstream out(file, std::ios::binary);
  out << header << data;
}

void plain_read(benchmark::State& state, const fs::path& file) {
  const std::size_t size = fs::file_size(file);
  for (auto _ : state) {
    const std::unique_ptr<char[]> memory(new char[size]);
    const int descriptor = ::open(file.c_str(), O_RDONLY);
    std::size_t done = 0;
    while (done < size) {
      const ssize_t got = ::read(descriptor, memory.get() + done, size - done);
      if (got <= 0) break;
      done += static_cast<std::size_t>(got);
    }
    ::close(descriptor);
    if (done < size) state.SkipWithError("cannot read the file");
    benchmark::DoNotOptimize(memory.get());
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * size));
}

void scan_read(benchmark::State& state, const fs::path& file) {
  for (auto _ : state) {
    const Result<Scan> scan = read_scan(file);
    if (!scan) state.SkipWithError(scan.error().message.c_str());
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * fs::file_size(file)));
}

std::size_t points_asked(int argc, char** argv) {
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::string_view(argv[i]) == "--points") return static_cast<std::size_t>(std::atoll(argv[i + 1]));
  }
  return 5'000'000;
}

}  // namespace
}  // namespace patchlab

int main(int argc, char** argv) {
  using namespace patchlab;
  benchmark::Initialize(&argc, argv);
  std::string pattern = (fs::temp_directory_path() / "patchlab_readers_XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) return 1;
  const fs::path folder = pattern;
  const std::size_t points = points_asked(argc, argv);
  const std::string data = points_as_bytes(points);
  for (const auto& [name, header] :
       {std::pair{"binary.pcd", pcd_header(points)}, {"binary.ply", ply_header(points)}}) {
    const fs::path file = folder / name;
    write(file, header, data);
    benchmark::RegisterBenchmark((std::string("read/") + name).c_str(), plain_read, file)
        ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark((std::string("scan/") + name).c_str(), scan_read, file)
        ->Unit(benchmark::kMillisecond);
  }
  benchmark::RunSpecifiedBenchmarks();
  fs::remove_all(folder);
}
