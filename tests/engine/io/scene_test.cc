#include "engine/io/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "engine/base/file.h"
#include "tests/support/sample_patches.h"
#include "tests/support/seeded_random.h"

namespace patchlab {
namespace {

using nlohmann::json;
using testing::HasSubstr;

json sphere_object(const std::string& name, double depth) {
  return {{"name", name},
          {"patch",
           {{"surface", "sphere"},
            {"boundary", "circle"},
            {"parameters",
             {{"names", {"d", "kappa", "r_x", "r_y", "c_x", "c_y", "c_z"}},
              {"values", {0.06, -12.5, 3.0, 0.0, 0.05, 0.0, depth}}}}}}};
}

json scene_json() {
  return {{"format", "patchlab.scene"},
          {"version", 1},
          {"camera",
           {{"width", 64},
            {"height", 48},
            {"fx", 52.5},
            {"fy", 52.5},
            {"cx", 31.5},
            {"cy", 23.5},
            {"pose", {{"position", {0, 0, 0}}, {"quaternion_xyzw", {0, 0, 0, 1}}}}}},
          {"noise", "isotropic:1e-9"},
          {"objects", {sphere_object("ball", 1.0), sphere_object("far ball", 2.0)}}};
}

SceneDescription scene() {
  const Result<SceneDescription> read = read_scene(scene_json().dump(), "a.json");
  if (read) return *read;
  ADD_FAILURE() << read.error().message;
  return {};
}

template <class Change>
std::string refusal(const Change& change) {
  json object = scene_json();
  change(object);
  const Result<SceneDescription> read = read_scene(object.dump(), "a.json");
  return read ? "accepted" : read.error().message;
}

TEST(Scene, IsReadAsWritten) {
  const SceneDescription read = scene();
  EXPECT_EQ(read.camera.width, 64u);
  EXPECT_EQ(read.camera.height, 48u);
  EXPECT_EQ(read.camera.fx, 52.5);
  EXPECT_EQ(read.camera.cy, 23.5);
  EXPECT_EQ(read.noise, "isotropic:1e-9");
  ASSERT_EQ(read.objects.size(), 2u);
  EXPECT_EQ(read.objects[1].name, "far ball");
  EXPECT_EQ(read.objects[1].patch.type->surface, SurfaceType::sphere);
  EXPECT_EQ(read.objects[1].patch.parameters[6], 2.0);
}

TEST(Scene, IsRefusedByNameOfFileObjectAndMember) {
  EXPECT_THAT(refusal([](json& s) { s["format"] = "patchlab.patch_set"; }),
              HasSubstr("a.json: format is not"));
  EXPECT_THAT(refusal([](json& s) { s["version"] = 2; }), HasSubstr("version 2 is not one"));
  EXPECT_THAT(refusal([](json& s) { s.erase("camera"); }), HasSubstr("lacks the member \"camera\""));
  EXPECT_THAT(refusal([](json& s) { s["camera"]["width"] = 0; }), HasSubstr("camera has no pixels"));
  EXPECT_THAT(refusal([](json& s) { s["camera"]["width"] = 1e9; }), HasSubstr("camera.width"));
  EXPECT_THAT(refusal([](json& s) { s["camera"]["fx"] = -1; }), HasSubstr("focal length"));
  EXPECT_THAT(refusal([](json& s) { s["objects"][1]["name"] = "ball"; }),
              HasSubstr("objects[1].name is taken"));
  EXPECT_THAT(refusal([](json& s) { s["objects"][1]["name"] = ""; }), HasSubstr("objects[1].name is empty"));
  EXPECT_THAT(refusal([](json& s) { s["objects"][0].erase("patch"); }),
              HasSubstr("object \"ball\" lacks the member \"patch\""));
  EXPECT_THAT(refusal([](json& s) { s["objects"][0]["patch"]["parameters"]["values"][0] = 0.09; }),
              HasSubstr("object \"ball\": patch cannot be: "));
}

TEST(Scene, SaysThatMeshesAreNotSimulatedYet) {
  EXPECT_THAT(refusal([](json& s) {
                s["objects"][1] = {{"name", "rock"}, {"mesh", "rock.ply"}};
              }),
              HasSubstr("object \"rock\" is a mesh, which cannot be simulated yet"));
}

TEST(Scene, HasItsObjectsAsDesignedTruth) {
  const PatchSet set = truth(scene());
  ASSERT_EQ(set.patches.size(), 2u);
  EXPECT_EQ(set.patches[0].id, "ball");
  EXPECT_EQ(set.patches[0].frame_id, "world");
  EXPECT_EQ(set.patches[0].patch.parameters, scene().objects[0].patch.parameters);
  EXPECT_FALSE(set.patches[0].patch.covariance);
  EXPECT_TRUE(write_patch_set(set));
}

TEST(Scene, GivesTheNearerOfTwoObjectsOnARay) {
  const CastRay cast = cast_ray(scene());
  const auto near = cast(Vector3d::Zero(), Vector3d(0.05, 0.0, 1.0));
  ASSERT_TRUE(near);
  EXPECT_EQ(near->object, 0u);
  EXPECT_NEAR(near->s, 1.0, 0.01);
  const auto from_behind = cast(Vector3d(0.05, 0.0, 4.0), Vector3d(0.0, 0.0, -1.0));
  ASSERT_TRUE(from_behind);
  EXPECT_EQ(from_behind->object, 1u);
  EXPECT_FALSE(cast(Vector3d::Zero(), Vector3d(0.0, 0.0, -1.0)));
}

// The ball around a patch must not cut off any of it.
TEST(Scene, HitsWhateverARayHits) {
  test::SeededRandom random;
  int hits = 0;
  for (const test::SamplePatch& sample : test::sample_patches()) {
    SceneDescription one;
    one.objects.push_back({"patch", sample.patch});
    const CastRay cast = cast_ray(one);
    const double size = 1.5 * extent(boundary(sample.patch)).norm();
    for (int i = 0; i < 500; ++i) {
      const Vector3d origin = centre(sample.patch) + 2.0 * random.unit3();
      const Vector3d target = centre(sample.patch) + size * random.uniform() * random.unit3();
      const std::optional<double> expected = ray_hit(sample.patch, origin, target - origin);
      const std::optional<Hit> found = cast(origin, target - origin);
      ASSERT_EQ(found.has_value(), expected.has_value()) << sample.label;
      if (!expected) continue;
      EXPECT_EQ(found->s, *expected) << sample.label;
      ++hits;
    }
  }
  EXPECT_GT(hits, 1000);
}

TEST(Simulate, LabelsWhatLiesOnAnObjectByItsNumber) {
  const Result<SimulatedScene> simulated = simulate(scene(), "", 1);
  ASSERT_TRUE(simulated) << simulated.error().message;
  const Scan& scan = simulated->scan;
  ASSERT_GT(scan.finite_count, 10u);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!scan.finite[i]) continue;
    const Patch& patch = simulated->truth.patches[scan.labels[i] - 1].patch;
    const Vector3d q_patch = apply_inverse(world_from_patch(patch), scan.point(i));
    EXPECT_NEAR(implicit(q_patch, k3(patch)), 0.0, 1e-6);
  }
}

TEST(Simulate, TakesAnotherNoiseModelWhereOneIsGiven) {
  const Scan quiet = simulate(scene(), "", 1)->scan, loud = simulate(scene(), "isotropic:0.01", 1)->scan;
  double largest = 0.0;
  for (std::size_t i = 0; i < quiet.size(); ++i) {
    if (quiet.finite[i]) largest = std::max(largest, (quiet.point(i) - loud.point(i)).norm());
  }
  EXPECT_GT(largest, 0.01);
}

TEST(Simulate, RefusesANoiseModelItCannotUse) {
  for (const char* noise : {"from_file", "nonsense"}) {
    const Result<SimulatedScene> simulated = simulate(scene(), noise, 1);
    ASSERT_FALSE(simulated) << noise;
    EXPECT_EQ(simulated.error().code, ErrorCode::usage);
  }
}

TEST(Scene, ReadsTheContractButForItsMesh) {
  const std::filesystem::path contract =
      std::filesystem::path(PATCHLAB_SOURCE_DIR) / "../shared/contracts/scene.json";
  if (!std::filesystem::exists(contract)) GTEST_SKIP() << "the contracts are not beside this checkout";
  json object = json::parse(as_text(*read_file(contract)));
  EXPECT_FALSE(read_scene(object.dump(), "scene.json"));
  object["objects"].erase(1);
  const Result<SceneDescription> read = read_scene(object.dump(), "scene.json");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_GT(simulate(*read, "", 1)->scan.finite_count, 500u);
}

}  // namespace
}  // namespace patchlab
