// The sample of assets/: a scene, the scan that a range camera makes of it, and its truth.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "engine/base/file.h"
#include "engine/io/read_scan.h"
#include "engine/io/scene.h"

namespace patchlab {
namespace {

std::string text_of(const std::string& name) {
  const Result<Bytes> bytes = read_file(std::filesystem::path(PATCHLAB_SOURCE_DIR) / "assets" / name);
  if (bytes) return std::string(as_text(*bytes));
  ADD_FAILURE() << bytes.error().message;
  return {};
}

Scan scan() { return *read_pcd(text_of("rock_field.pcd"), "rock_field.pcd"); }
PatchSet truth() { return *read_patch_set(text_of("rock_field.truth.json"), "rock_field.truth.json"); }

TEST(RockField, IsTheScanThatItsSceneGives) {
  const Result<SceneDescription> scene =
      read_scene(text_of("rock_field.scene.json"), "rock_field.scene.json");
  ASSERT_TRUE(scene) << scene.error().message;
  const Result<SimulatedScene> simulated = simulate(*scene, "", 1);
  ASSERT_TRUE(simulated) << simulated.error().message;
  EXPECT_EQ(sha256(write_pcd(simulated->scan)), sha256(text_of("rock_field.pcd")));
  EXPECT_EQ(*write_patch_set(simulated->truth), text_of("rock_field.truth.json"));
}

TEST(RockField, IsOfTheSizeOfThePapersScanInTwoMegabytes) {
  EXPECT_NEAR(static_cast<double>(scan().finite_count), 125000.0, 1000.0);
  EXPECT_LT(text_of("rock_field.pcd").size(), 2000000u);
}

TEST(RockField, IsOrganisedWithItsViewpointStated) {
  EXPECT_TRUE(scan().organized());
  EXPECT_TRUE(scan().viewpoint.stated);
}

TEST(RockField, ShowsEveryTypeOfTableI) {
  const PatchSet set = truth();
  std::set<const PatchTypeRow*> seen;
  for (const std::uint32_t label : scan().labels) {
    if (label > 0) seen.insert(set.patches.at(label - 1).patch.type);
  }
  EXPECT_EQ(seen.size(), patch_types().size());
}

TEST(RockField, HasNoPatchNearTheSingularityOfItsPose) {
  for (const PatchRecord& record : truth().patches) EXPECT_FALSE(near_singular(record.patch)) << record.id;
}

TEST(RockField, HasTheNoiseOfItsModelAboutTheTruth) {
  const Scan points = scan();
  const PatchSet set = truth();
  const NoiseModel noise = *noise_model("kinect1");
  double chi2 = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); i += 7) {
    if (!points.finite[i]) continue;
    const Patch& patch = set.patches.at(points.labels[i] - 1).patch;
    if (patch.type->surface != SurfaceType::plane) continue;
    const Vector3d normal = axes(patch).col(2);
    const double distance = normal.dot(points.point(i) - centre(patch));
    chi2 += distance * distance / normal.dot(covariance(noise, points.viewpoint, points.point(i)) * normal);
    ++count;
  }
  ASSERT_GT(count, 3000u);
  EXPECT_NEAR(chi2 / static_cast<double>(count), 1.0, 0.06);
}

}  // namespace
}  // namespace patchlab
