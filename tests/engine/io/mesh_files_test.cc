// OBJ, OFF and STL: vertices become points, faces are checked and counted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "engine/io/mesh_data.h"

namespace patchlab {
namespace {

using testing::Contains;
using testing::HasSubstr;

Scan read(std::string_view text, const ReadOptions& options = {}) {
  Result<Scan> scan = read_scan_bytes(text, "mesh", options);
  if (!scan) ADD_FAILURE() << scan.error().message;
  return scan ? *std::move(scan) : Scan{};
}

std::string mesh_refusal(std::string_view text, const std::string& name = "mesh") {
  const Result<Scan> scan = read_scan_bytes(text, name);
  return scan ? "accepted" : scan.error().message;
}

using Facet = std::array<Eigen::Vector3f, 3>;

std::string binary_stl(const std::vector<Facet>& facets, const std::string& title = "made here") {
  std::string bytes = title + std::string(80 - title.size(), ' ');
  const auto count = static_cast<std::uint32_t>(facets.size());
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  for (const Facet& facet : facets) {
    bytes.append(12, '\0');
    for (const Eigen::Vector3f& corner : facet)
      bytes.append(reinterpret_cast<const char*>(corner.data()), 12);
    bytes.append(2, '\0');
  }
  return bytes;
}

const Facet lower = {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(1, 1, 0)};
const Facet upper = {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(1, 1, 0), Eigen::Vector3f(0, 1, 0.5)};

TEST(MeshFiles, VerticesOfAnObjKeepTheirDigits) {
  const Scan scan = read(
      "# made by hand\no part\nv 500000.123456789 0.25 -1e-3 0.5 0.5 0.5\nvn 0 0 1\nv 500001 2 3\n"
      "v 500002 3 \\\n 4\nf 1//1 2//1 \\\n 3//1\n");
  EXPECT_EQ(scan.format, "obj");
  ASSERT_EQ(scan.size(), 3u);
  EXPECT_NEAR(scan.point(0).x(), 500000.123456789, 1e-6);
  EXPECT_EQ(scan.point(2), Eigen::Vector3d(500002, 3, 4));
  EXPECT_THAT(scan.notices, Contains(HasSubstr("1 faces were left out")));
  EXPECT_THAT(scan.notices, Contains(HasSubstr("states no viewpoint")));
  EXPECT_FALSE(scan.viewpoint.stated);
}

TEST(MeshFiles, FacesOfAnObjCountFromOneOrFromTheEnd) {
  const Result<MeshData> mesh = parse_obj(
      "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf -4 -3 -2 -1\nf 1/7 2/7 3/7\n"
      "f 0 1 2\nf -5 1 2\nf 1 2 5\nf 1 2\nf x y z\n",
      "mesh", {});
  ASSERT_TRUE(mesh) << mesh.error().message;
  using Triangle = std::array<std::uint32_t, 3>;
  EXPECT_THAT(mesh->triangles, testing::ElementsAre(Triangle{0, 1, 2}, Triangle{0, 1, 2}, Triangle{0, 2, 3},
                                                    Triangle{0, 1, 2}));
  EXPECT_EQ(mesh->faces, 8u);
  EXPECT_EQ(mesh->bad_faces, 5u);
}

TEST(MeshFiles, ACommentMayFollowAVertexOrAFace) {
  const Scan scan = read("v 0 0 1 # first\nv 1 0 1# second\nv 1 1 1\nf 1 2 3 # all\nusemtl a#b\n");
  EXPECT_EQ(scan.size(), 3u);
  EXPECT_THAT(scan.notices, Contains(HasSubstr("its 1 faces were left out")));
}

TEST(MeshFiles, FacesOfAPlyStandBeforeOrAfterTheirVertices) {
  const std::string vertices = "element vertex 4\nproperty float x\nproperty double y\nproperty float z\n",
                    faces = "element face 3\nproperty uchar red\nproperty list uchar int vertex_indices\n",
                    xyz = "0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n", quad = "9 4 0 1 2 3\n9 3 0 1 4\n9 3 2 1 0\n";
  using Triangle = std::array<std::uint32_t, 3>;
  for (const std::string& text :
       {"ply\nformat ascii 1.0\n" + vertices + faces + "end_header\n" + xyz + quad,
        "ply\nformat ascii 1.0\n" + faces + vertices + "end_header\n" + quad + xyz}) {
    const Result<MeshData> mesh = parse_mesh(text, "mesh", {});
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh->vertices[3], Eigen::Vector3d(0, 1, 0.5));
    EXPECT_THAT(mesh->triangles,
                testing::ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{2, 1, 0}));
    EXPECT_EQ(mesh->bad_faces, 1u);
  }
}

TEST(MeshFiles, AnObjThatIsWrongIsRefusedByLine) {
  EXPECT_THAT(mesh_refusal("v 0 0\n"), HasSubstr("line 1: a vertex has 2 values"));
  EXPECT_THAT(mesh_refusal("v 0 0 0\nv 1 a 0\n"), HasSubstr("line 2: 'a' in a vertex is not a number"));
  EXPECT_THAT(mesh_refusal("v 0 0 0\nw 1 2 3\n"), HasSubstr("line 2: 'w' is no entry of an OBJ file"));
  EXPECT_THAT(mesh_refusal("o nothing\n"), HasSubstr("holds no vertices"));
}

TEST(MeshFiles, OffVerticesHaveTheValuesTheirKeywordSays) {
  const Scan scan = read("# first\nOFF 3 1 0 # counts\n0 0 1\n\n1 0 1 # two\n1 2 1\n3 0 1 2\n");
  EXPECT_EQ(scan.format, "off");
  ASSERT_EQ(scan.size(), 3u);
  EXPECT_EQ(scan.point(2), Eigen::Vector3d(1, 2, 1));
  EXPECT_EQ(read("COFF\n1 0 0\n1 2 3 255 0 0 255\n").size(), 1u);
  EXPECT_EQ(read("NOFF\n1 0 0\n1 2 3 0 0 1\n").size(), 1u);
  EXPECT_THAT(mesh_refusal("OFF\n1 0 0\n1 2 3 4\n"), HasSubstr("line 3: a vertex has 4 values, not 3"));
  EXPECT_THAT(mesh_refusal("4OFF\n1 0 0\n1 2 3 4\n"), HasSubstr("another dimension"));
  EXPECT_THAT(mesh_refusal("OFF BINARY\n1 0 0\n"), HasSubstr("binary OFF"));
  EXPECT_THAT(mesh_refusal("OFF\n9 0 0\n1 2 3\n"), HasSubstr("9 vertices and 0 faces do not fit"));
  EXPECT_THAT(mesh_refusal("OFF\n2 0 0\n1.5 2.5 3.5\n"), HasSubstr("ends before its last vertex"));
  EXPECT_THAT(mesh_refusal("OFF\nthree\n"), HasSubstr("no count of vertices"));
}

TEST(MeshFiles, StlCornersAreMergedInBothEncodings) {
  const Scan binary = read(binary_stl({lower, upper}));
  EXPECT_EQ(binary.encoding, "binary");
  EXPECT_EQ(binary.size(), 4u);
  EXPECT_EQ(binary.point(3), Eigen::Vector3d(0, 1, 0.5));
  EXPECT_EQ(read(binary_stl({lower, upper}, "solid in name only")).size(), 4u);
  const Scan ascii = read(
      "solid a\nfacet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 1 1 0\n"
      " endloop\nendfacet\nendsolid a\n");
  EXPECT_EQ(ascii.encoding, "ascii");
  EXPECT_EQ(ascii.size(), 3u);
  EXPECT_EQ(
      read("SOLID A\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 1 1 0\nENDLOOP\n"
           "ENDFACET\nENDSOLID\n")
          .size(),
      3u);
}

TEST(MeshFiles, AnStlThatIsWrongIsRefused) {
  const std::string whole = binary_stl({lower, upper});
  EXPECT_THAT(mesh_refusal(whole.substr(0, whole.size() - 1), "a.STL"),
              HasSubstr("promises 2 triangles of 50 bytes, but 99"));
  EXPECT_THAT(mesh_refusal(binary_stl({}), "a.stl"), HasSubstr("no triangles"));
  EXPECT_THAT(mesh_refusal("solid a\nfacet normal 0 0 1\nvertex 0 0 0\nvertex 1 0 0\nendfacet\n"),
              HasSubstr("line 5: the facet that ends here has 2 vertices"));
  EXPECT_THAT(mesh_refusal("solid a\nfacet normal 0 0 1\nvertex 0 0 0\n"), HasSubstr("ends within a facet"));
  EXPECT_THAT(mesh_refusal("solid a\nfacet normal 0 0 1\nvertex 0 0 x\n"),
              HasSubstr("line 3: 'x' in a vertex"));
}

TEST(MeshFiles, MillimetresBecomeMetres) {
  const Scan scan = read("v 100 0 0\nv 0 50 0\nv 0 0 25\n", {.unit = LengthUnit::mm});
  EXPECT_LT((scan.point(0) - Eigen::Vector3d(0.1, 0, 0)).norm(), 1e-8);
}

}  // namespace
}  // namespace patchlab
