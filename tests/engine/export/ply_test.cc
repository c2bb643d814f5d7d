#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <cstring>
#include <map>
#include <sstream>

#include "engine/mesh/patch_mesh.h"
#include "engine/patch/marginals.h"
#include "tests/engine/export/consumer.h"
#include "tests/engine/io/sample_set.h"

namespace patchlab {
namespace {

struct PlyVertex {
  Vector3d point, normal;
  double height_sigma;
  std::uint32_t patch;
};
struct Ply {
  std::vector<std::string> header;
  std::vector<PlyVertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> faces;
  std::size_t bytes_left = 0;
};

template <class T>
T take(std::string_view& bytes) {
  T value;
  EXPECT_GE(bytes.size(), sizeof value);
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes.remove_prefix(sizeof value);
  return value;
}

Vector3d take3(std::string_view& bytes) {
  const auto x = take<double>(bytes), y = take<double>(bytes), z = take<double>(bytes);
  return {x, y, z};
}

// Reads what the header announces, and only that.
Ply read_ply(const std::string& text) {
  Ply ply;
  std::istringstream lines(text);
  std::map<std::string, std::size_t> counts;
  for (std::string line; std::getline(lines, line) && line != "end_header";) {
    ply.header.push_back(line);
    std::istringstream words(line);
    std::string word, element;
    if (words >> word && word == "element" && words >> element) words >> counts[element];
  }
  std::string_view body = std::string_view(text).substr(text.find("end_header\n") + 11);
  for (std::size_t i = 0; i < counts["vertex"]; ++i) {
    const Vector3d point = take3(body), normal = take3(body);
    const auto sigma = take<double>(body);
    ply.vertices.push_back({point, normal, sigma, take<std::uint32_t>(body)});
  }
  for (std::size_t i = 0; i < counts["face"]; ++i) {
    EXPECT_EQ(take<std::uint8_t>(body), 3);
    auto& face = ply.faces.emplace_back();
    for (std::uint32_t& vertex : face) vertex = take<std::uint32_t>(body);
  }
  ply.bytes_left = body.size();
  return ply;
}

Ply exported(const PatchSet& set) { return read_ply(test::exported_bytes("ply", set)); }

TEST(ExportPly, HoldsTheMeshOfEachPatchInDoubles) {
  const PatchSet set = test::sample_set();
  const Ply ply = exported(set);
  std::size_t at = 0, faces = 0;
  for (std::size_t i = 0; i < set.patches.size(); ++i) {
    const Patch& patch = set.patches[i].patch;
    const TriangleMesh mesh = surface_mesh(patch);
    const std::vector<Vector2d> u = surface_coordinates(patch);
    ASSERT_LE(at + mesh.n_vertices(), ply.vertices.size());
    for (const auto vertex : mesh.vertices()) {
      const PlyVertex& written = ply.vertices[at + static_cast<std::size_t>(vertex.idx())];
      EXPECT_EQ(written.point, Vector3d::Map(mesh.point(vertex).data()));
      EXPECT_EQ(written.normal, Vector3d::Map(mesh.normal(vertex).data()));
      EXPECT_EQ(written.patch, i);
      EXPECT_EQ(written.height_sigma, height_sigma(patch, u[static_cast<std::size_t>(vertex.idx())]));
    }
    at += mesh.n_vertices();
    faces += mesh.n_faces();
  }
  EXPECT_EQ(ply.vertices.size(), at);
  EXPECT_EQ(ply.faces.size(), faces);
  EXPECT_EQ(ply.bytes_left, 0u);
}

TEST(ExportPly, TurnsEachTriangleOutwardWithinOnePatch) {
  const Ply ply = exported(test::sample_set());
  for (const auto& [a, b, c] : ply.faces) {
    ASSERT_LT(std::max({a, b, c}), ply.vertices.size());
    const PlyVertex &va = ply.vertices[a], &vb = ply.vertices[b], &vc = ply.vertices[c];
    EXPECT_EQ(va.patch, vb.patch);
    EXPECT_EQ(va.patch, vc.patch);
    EXPECT_GT((vb.point - va.point).cross(vc.point - va.point).dot(va.normal), 0.0);
  }
}

TEST(ExportPly, IsReadByOpenMesh) {
  const std::string bytes = test::exported_bytes("ply", test::sample_set());
  std::istringstream stream(bytes);
  OpenMesh::IO::Options options(OpenMesh::IO::Options::VertexNormal);
  TriangleMesh mesh;
  mesh.request_vertex_normals();
  ASSERT_TRUE(OpenMesh::IO::read_mesh(mesh, stream, ".ply", options));
  const Ply ply = read_ply(bytes);
  ASSERT_EQ(mesh.n_vertices(), ply.vertices.size());
  EXPECT_EQ(mesh.n_faces(), ply.faces.size());
  for (const auto vertex : mesh.vertices()) {
    const Vector3d point = Vector3d::Map(mesh.point(vertex).data());
    EXPECT_LT((point - ply.vertices[static_cast<std::size_t>(vertex.idx())].point).norm(), 1e-6);
  }
}

TEST(ExportPly, NamesPatchesTypesAndFramesInComments) {
  PatchSet set = test::designed_set();
  set.patches[0].id = "left\nsole";
  EXPECT_THAT(exported(set).header,
              testing::Contains("comment patch 0 is left sole: plane, rectangle, in frame left_foot"));
}

TEST(ExportPly, SaysWhereAPatchHasNoCovariance) {
  for (const PlyVertex& vertex : exported(test::designed_set()).vertices)
    EXPECT_EQ(vertex.height_sigma, -1.0);
}

TEST(ExportPly, OfNoPatchesIsAMeshWithoutVertices) {
  const Ply ply = exported({});
  EXPECT_TRUE(ply.vertices.empty());
  EXPECT_EQ(ply.bytes_left, 0u);
}

}  // namespace
}  // namespace patchlab
