// The second sample of assets/: a bench with a ball, a pipe, a box, a bowl and a step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "engine/base/file.h"
#include "engine/io/read_scan.h"
#include "engine/io/scene.h"

namespace patchlab {
namespace {

std::string asset_text(const std::string& name) {
  const Result<Bytes> bytes = read_file(std::filesystem::path(PATCHLAB_SOURCE_DIR) / "assets" / name);
  if (bytes) return std::string(as_text(*bytes));
  ADD_FAILURE() << bytes.error().message;
  return {};
}

TEST(BenchScene, IsTheScanThatItsSceneGives) {
  const Result<SceneDescription> scene = read_scene(asset_text("bench.scene.json"), "bench.scene.json");
  ASSERT_TRUE(scene) << scene.error().message;
  const Result<SimulatedScene> simulated = simulate(*scene, "", 1);
  ASSERT_TRUE(simulated) << simulated.error().message;
  EXPECT_EQ(sha256(write_pcd(simulated->scan)), sha256(asset_text("bench.pcd")));
  EXPECT_EQ(*write_patch_set(simulated->truth), asset_text("bench.truth.json"));
}

TEST(BenchScene, ShowsEveryObjectAndLosesReturns) {
  const Scan scan = *read_pcd(asset_text("bench.pcd"), "bench.pcd");
  const PatchSet truth = *read_patch_set(asset_text("bench.truth.json"), "bench.truth.json");
  for (std::uint32_t label = 1; label <= truth.patches.size(); ++label) {
    EXPECT_GT(std::ranges::count(scan.labels, label), 900) << truth.patches[label - 1].name;
  }
  EXPECT_LT(scan.finite_count, scan.size());
}

TEST(BenchScene, HasDepthsOfWholeMillimetres) {
  const Scan scan = *read_pcd(asset_text("bench.pcd"), "bench.pcd");
  const Eigen::Matrix3d sensor_from_world = rotation(scan.viewpoint).transpose();
  for (std::size_t i = 0; i < scan.size(); i += 11) {
    if (!scan.finite[i]) continue;
    const double millimetres = 1000.0 * (sensor_from_world * (scan.point(i) - scan.viewpoint.position)).z();
    EXPECT_NEAR(millimetres, std::round(millimetres), 1e-3);
  }
}

}  // namespace
}  // namespace patchlab
