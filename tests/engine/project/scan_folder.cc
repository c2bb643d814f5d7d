#include "tests/engine/project/scan_folder.h"

#include <fstream>
#include <limits>

#include "engine/base/random.h"
#include "engine/io/read_scan.h"

namespace patchlab {
namespace {

constexpr int kPointsOfAPlate = 150;

Scan boxes() {
  Random random(42);
  Scan scan;
  for (const std::uint32_t label : {7u, 8u}) {
    const double x = label == 7 ? -0.2 : 0.2;
    for (int i = 0; i < kPointsOfAPlate; ++i) {
      const double u = random.uniform(-0.1, 0.1), v = random.uniform(-0.1, 0.1), w = 0.001 * random.normal();
      scan.positions.push_back(Eigen::Vector3d(x + u, v, 1.0 + w).cast<float>());
      scan.labels.push_back(label);
    }
  }
  scan.positions.emplace_back(std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F);
  scan.labels.push_back(7);
  scan.finite.assign(scan.size(), 1);
  scan.finite.back() = 0;
  scan.finite_count = scan.size() - 1;
  scan.width = static_cast<std::uint32_t>(scan.size());
  return scan;
}

}  // namespace

ScanFolder::ScanFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "patchlab_project_XXXXXX").string();
  folder_ = ::mkdtemp(pattern.data());
  write("boxes.pcd", write_pcd(boxes()));
}

ScanFolder::~ScanFolder() { std::filesystem::remove_all(folder_); }

std::string ScanFolder::text(const std::string& file) const {
  std::ifstream stream(at(file), std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void ScanFolder::write(const std::string& file, const std::string& text) const {
  std::ofstream(at(file), std::ios::binary) << text;
}

Select ScanFolder::select_label(const std::string& region, std::uint32_t label) {
  Select select{.region = region, .scan = "scan-1"};
  select.label = label;
  return select;
}

Select ScanFolder::lasso_left(const std::string& region) {
  Select select{.region = region, .scan = "scan-1"};
  select.camera.quaternion_xyzw = {1, 0, 0, 0};  // looks along +z: x to the right, y down
  select.polygon = {{100, 100}, {640, 100}, {640, 700}, {100, 700}};
  return select;
}

Fit ScanFolder::fit_plane(const std::string& patch, const std::string& region) {
  Fit fit{.patch = patch, .region = region};
  fit.options.surface = SurfaceRequest::plane;
  return fit;
}

Document ScanFolder::after(std::vector<Command> commands) const {
  Document document;
  for (Command& command : commands) {
    Result<Document> next = apply(document, command, here());
    if (!next) {
      ADD_FAILURE() << next.error().message;
      return document;
    }
    document = std::move(*next);
  }
  return document;
}

}  // namespace patchlab
