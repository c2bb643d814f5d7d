// Meshes of patches, and the programs that read them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <map>
#include <sstream>

#include "engine/export/triangles.h"
#include "engine/mesh/patch_mesh.h"
#include "tests/engine/export/consumer.h"
#include "tests/engine/export/ten_types.h"

namespace patchlab {
namespace {

using testing::HasSubstr;

constexpr double thickness = 0.004;

double volume(const Triangles& mesh) {
  double six = 0.0;
  for (const auto& [a, b, c] : mesh.faces) six += mesh.points[a].dot(mesh.points[b].cross(mesh.points[c]));
  return six / 6.0;
}

// How often each directed edge occurs.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges(const Triangles& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
  for (const auto& [a, b, c] : mesh.faces) {
    ++count[{a, b}];
    ++count[{b, c}];
    ++count[{c, a}];
  }
  return count;
}

TEST(ThickSolid, IsClosedWithEveryEdgeOnceEachWay) {
  for (const test::SamplePatch& sample : test::sample_patches()) {
    const auto count = edges(thick_solid(sample.patch, thickness));
    for (const auto& [edge, times] : count) {
      ASSERT_EQ(times, 1) << sample.label;
      ASSERT_TRUE(count.contains({edge.second, edge.first})) << sample.label;
    }
  }
}

TEST(ThickSolid, HasTheVolumeOfItsProjectionTimesItsThickness) {
  for (const test::SamplePatch& sample : test::sample_patches()) {
    const double expected = area(boundary(sample.patch)) * thickness;
    EXPECT_NEAR(volume(thick_solid(sample.patch, thickness, 64)), expected, 2e-3 * expected) << sample.label;
  }
}

TEST(ThickSolid, HasTheOpenSurfaceOnTop) {
  for (const test::SamplePatch& sample : test::sample_patches()) {
    const Triangles open = open_surface(sample.patch), solid = thick_solid(sample.patch, thickness);
    for (std::size_t i = 0; i < open.points.size(); ++i) ASSERT_EQ(open.points[i], solid.points[i]);
    for (std::size_t i = 0; i < open.faces.size(); ++i) ASSERT_EQ(open.faces[i], solid.faces[i]);
  }
}

struct Read {
  std::vector<Vector3d> points;  // of the corners of the faces, in order
};

Read read_by_openmesh(const std::filesystem::path& file) {
  OpenMesh::IO::Options options;
  TriangleMesh mesh;
  Read read;
  EXPECT_TRUE(OpenMesh::IO::read_mesh(mesh, file.string(), options));
  for (const auto face : mesh.faces()) {
    for (auto corner = mesh.cfv_ccwbegin(face); corner.is_valid(); ++corner)
      read.points.push_back(Vector3d::Map(mesh.point(*corner).data()));
  }
  return read;
}

// What each format is read for: PLY and OBJ open, STL as a solid.
struct Shape {
  std::string format;
  ExportOptions options;
};
std::vector<Shape> shapes(const std::vector<std::string>& patches) {
  return {{"ply", {.patches = patches}},
          {"obj", {.patches = patches}},
          {"stl", {.patches = patches, .thickness = thickness}}};
}

// Every patch alone, so that OpenMesh joins no vertices of different patches.
TEST(Meshes, AreReadByOpenMeshFaceByFace) {
  const test::Folder folder;
  const PatchSet set = test::ten_types();
  for (const PatchRecord& record : set.patches) {
    for (const auto& [format, options] : shapes({record.id})) {
      const Triangles mesh = placed_triangles(record.patch, options);
      const Read read = read_by_openmesh(test::export_to(folder.at("set." + format), format, set, options));
      ASSERT_EQ(read.points.size(), 3 * mesh.faces.size()) << record.id << " " << format;
      for (std::size_t i = 0; i < read.points.size(); ++i) {
        const Vector3d& point = mesh.points[mesh.faces[i / 3][i % 3]];
        const std::size_t face = 3 * (i / 3);  // a reader may start it at another corner
        const double nearest =
            std::min({(read.points[face] - point).norm(), (read.points[face + 1] - point).norm(),
                      (read.points[face + 2] - point).norm()});
        ASSERT_LT(nearest, 2e-7) << record.id << " " << format;
      }
    }
  }
}

TEST(Obj, KeepsEveryBitOfAPoint) {
  const PatchSet set = test::sample_set();
  std::istringstream lines(test::exported_bytes("obj", set));
  std::vector<Vector3d> points;
  std::vector<std::string> objects;
  for (std::string keyword, line; lines >> keyword && std::getline(lines, line);) {
    if (keyword == "o") objects.push_back(line.substr(1));
    if (keyword != "v") continue;
    const char* at = line.c_str();
    char* end = nullptr;
    Vector3d& point = points.emplace_back();
    for (double& x : point) x = std::strtod(at, &end), at = end;
  }
  std::size_t next = 0;
  ASSERT_EQ(objects.size(), set.patches.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    EXPECT_EQ(objects[i], set.patches[i].id);
    for (const Vector3d& point : placed_triangles(set.patches[i].patch, {}).points)
      ASSERT_EQ(points.at(next++), point);
  }
  EXPECT_EQ(next, points.size());
}

TEST(Stl, IsRefusedWhereSinglePrecisionIsTooCoarse) {
  PatchSet set = test::designed_set();
  set.patches[0].patch.parameters.tail<3>() << 5e5, 5e6, 100.0;
  const Result<Exported> exported = export_patches(**export_format("stl"), set);
  ASSERT_FALSE(exported);
  EXPECT_EQ(exported.error().code, ErrorCode::refused);
  EXPECT_THAT(exported.error().message, HasSubstr("left_sole"));
  EXPECT_TRUE(export_patches(**export_format("obj"), set));
}

TEST(Meshes, OfSeveralFramesAreRefused) {
  PatchSet set = test::sample_set();
  set.patches[3].frame_id = "left_foot";
  for (const char* format : {"ply", "obj", "stl"}) {
    const Result<Exported> exported = export_patches(**export_format(format), set);
    ASSERT_FALSE(exported) << format;
    EXPECT_THAT(exported.error().message, HasSubstr(set.patches[3].id));
    EXPECT_THAT(exported.error().message, HasSubstr("left_foot"));
    EXPECT_TRUE(export_patches(**export_format(format), set, {.patches = {set.patches[3].id}}));
  }
}

double number_after(const std::string& text, const std::string& label, int which) {
  const std::size_t at = text.find_first_of("-0123456789", text.find(label) + label.size());
  std::istringstream rest(text.substr(at));
  double value = NAN;
  for (int i = 0; i <= which; ++i) rest >> value;
  return value;
}

TEST(Meshes, AreReadByAssimp) {
  PATCHLAB_NEEDS("assimp", "assimp-utils");
  const test::Folder folder;
  const PatchSet set = test::ten_types();
  for (const auto& [format, options] : shapes({})) {
    Eigen::AlignedBox3d box;
    std::size_t faces = 0;
    for (const PatchRecord& record : set.patches) {
      const Triangles mesh = placed_triangles(record.patch, options);
      faces += mesh.faces.size();
      for (const Vector3d& point : mesh.points) box.extend(point);
    }
    const auto file = test::export_to(folder.at("set." + format), format, set, options);
    const test::Ran ran = test::run("assimp info '" + file.string() + "' --raw");
    ASSERT_EQ(ran.status, 0) << ran.output;
    EXPECT_EQ(number_after(ran.output, "Faces:", 0), static_cast<double>(faces)) << ran.output;
    for (int i = 0; i < 3; ++i) {  // it prints six digits after the point
      EXPECT_NEAR(number_after(ran.output, "Minimum point", i), box.min()[i], 1e-6) << ran.output;
      EXPECT_NEAR(number_after(ran.output, "Maximum point", i), box.max()[i], 1e-6) << ran.output;
    }
  }
}

}  // namespace
}  // namespace patchlab
