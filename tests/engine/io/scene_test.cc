#include "engine/io/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

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
              HasSubstr("object \"ball\" lacks the member \"patch\" or \"mesh\", or has both"));
  EXPECT_THAT(refusal([](json& s) { s["objects"][0]["mesh"] = "ball.ply"; }), HasSubstr("or has both"));
  EXPECT_THAT(refusal([](json& s) { s["objects"][0]["patch"]["parameters"]["values"][0] = 0.09; }),
              HasSubstr("object \"ball\": patch cannot be: "));
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

TEST(Scene, ReadsTheContractButForTheFileOfItsMesh) {
  const std::filesystem::path contract =
      std::filesystem::path(PATCHLAB_SOURCE_DIR) / "../shared/contracts/scene.json";
  if (!std::filesystem::exists(contract)) GTEST_SKIP() << "the contracts are not beside this checkout";
  json object = json::parse(as_text(*read_file(contract)));
  const Result<SceneDescription> without_mesh = read_scene(object.dump(), "scene.json");
  ASSERT_FALSE(without_mesh);
  EXPECT_THAT(without_mesh.error().message,
              HasSubstr("object \"rock\": mesh cannot be used: rock.ply: cannot be opened"));
  object["objects"].erase(1);
  const Result<SceneDescription> read = read_scene(object.dump(), "scene.json");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_GT(simulate(*read, "", 1)->scan.finite_count, 500u);
}

class SceneFolder : public testing::Test {
 protected:
  SceneFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "patchlab_scene_XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~SceneFolder() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

// Meshes as files: a square of side 0.2 at z = 0 about the origin, in every format and in two units.
class SceneMeshTest : public SceneFolder,
                      public testing::WithParamInterface<std::pair<const char*, std::string>> {};

json mesh_object(const std::string& file) {
  return {{"name", "square"},
          {"mesh", file},
          {"pose", {{"position", {0.05, 0, 0.5}}, {"quaternion_xyzw", {0, 0, 0, 1}}}}};
}

TEST_P(SceneMeshTest, IsSeenWhereItsPosePutsIt) {
  const auto& [file, text] = GetParam();
  ASSERT_TRUE(write_file(folder_ / file, text));
  json object = scene_json();
  object["objects"].push_back(mesh_object(file));
  object["objects"][2]["unit"] = std::string(file).starts_with("mm") ? "mm" : "m";
  const Result<SceneDescription> read = read_scene(object.dump(), "a.json", folder_);
  ASSERT_TRUE(read) << read.error().message;
  const Result<SimulatedScene> simulated = simulate(*read, "", 1);
  EXPECT_EQ(simulated->truth.patches.size(), 2u) << "a mesh has no patch";
  const Scan& scan = simulated->scan;
  Eigen::AlignedBox3d seen;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (scan.labels[i] == 3) seen.extend(scan.point(i));
  }
  const double pixel = 0.5 / 52.5;
  EXPECT_NEAR(seen.min().x(), -0.05, pixel);
  EXPECT_NEAR(seen.max().x(), 0.15, pixel);
  EXPECT_NEAR(seen.max().y(), 0.1, pixel);
  EXPECT_NEAR(seen.min().z(), 0.5, 1e-6);
  EXPECT_NEAR(seen.max().z(), 0.5, 1e-6);
  const Hit hit = cast_ray(*read)(Vector3d::Zero(), Vector3d(0.05, 0.0, 1.0)).value_or(Hit{});
  EXPECT_EQ(hit.object, 2u) << "it hides the ball behind it";
}

INSTANTIATE_TEST_SUITE_P(
    Formats, SceneMeshTest,
    testing::Values(
        std::pair("square.obj", "v -.1 -.1 0\nv .1 -.1 0\nv .1 .1 0\nv -.1 .1 0\nf 1 2 3 4\n"),
        std::pair("mm.obj", "v -100 -100 0\nv 100 -100 0\nv 100 100 0\nv -100 100 0\nf 1 2 3\nf 1 3 4\n"),
        std::pair("square.off", "OFF\n4 1 0\n-.1 -.1 0\n.1 -.1 0\n.1 .1 0\n-.1 .1 0\n4 0 1 2 3\n"),
        std::pair(
            "square.stl",
            "solid a\nfacet normal 0 0 1\nouter loop\nvertex -.1 -.1 0\nvertex .1 -.1 0\nvertex .1 .1 0\n"
            "endloop\nendfacet\nfacet normal 0 0 1\nouter loop\nvertex -.1 -.1 0\nvertex .1 .1 0\n"
            "vertex -.1 .1 0\nendloop\nendfacet\nendsolid\n"),
        std::pair(
            "square.ply",
            "ply\nformat ascii 1.0\nelement face 2\nproperty list uchar int vertex_indices\nelement vertex 4\n"
            "property float x\nproperty float y\nproperty float z\nend_header\n3 0 1 2\n3 0 2 3\n"
            "-.1 -.1 0\n.1 -.1 0\n.1 .1 0\n-.1 .1 0\n")),
    [](const auto& file) {
      std::string name = file.param.first;
      std::ranges::replace(name, '.', '_');
      return name;
    });

TEST_F(SceneFolder, WithAMeshFileThatHoldsNoneIsRefused) {
  ASSERT_TRUE(write_file(folder_ / "points.ply",
                         "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                         "property float z\nend_header\n1 2 3\n"));
  ASSERT_TRUE(write_file(folder_ / "table.csv", "x,y,z\n1,2,3\n"));
  for (const auto& [file, what] : {std::pair{"points.ply", "holds no face"},
                                   {"table.csv", "is no mesh"},
                                   {"", "is empty"},
                                   {"nothing.stl", "cannot be opened"}}) {
    json object = scene_json();
    object["objects"].push_back(mesh_object(file));
    const Result<SceneDescription> read = read_scene(object.dump(), "a.json", folder_);
    ASSERT_FALSE(read) << file;
    EXPECT_THAT(read.error().message, HasSubstr("a.json: object \"square\": mesh "));
    EXPECT_THAT(read.error().message, HasSubstr(what));
  }
  EXPECT_THAT(refusal([](json& s) {
                s["objects"].push_back(mesh_object("a.obj"));
                s["objects"][2]["unit"] = "yard";
              }),
              HasSubstr("unit is none of"));
}

}  // namespace
}  // namespace patchlab
