// A plain list of things to draw: what the app makes of a document, and the renderer draws. Knows no GL and
// no ImGui. Positions in metre about `origin` of the scene. Shared arrays are never changed once they are in
// a scene: a new array is a new pointer, by which the renderer knows what it has on the GPU already.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace patchlab::viewer {

using Rgba = std::array<float, 4>;  // straight alpha, sRGB, 0..1
using Rgba8 = std::array<std::uint8_t, 4>;

template <class T>
using Shared = std::shared_ptr<const std::vector<T>>;

struct PointsItem {
  Shared<Eigen::Vector3f> positions;  // NaN positions are skipped
  Shared<Rgba8> colours;              // one a point; alpha: 0 leaves it out, between fades to the background
  float size = 2.0f;                  // px
  float set_back = 0.0f;              // m: surfaces and lines so close behind a point are drawn over it
  std::size_t step = 1;  // draws every step-th point only: a prime, while the camera moves over a large scan
  bool operator==(const PointsItem&) const = default;
};

// Whether there is something to draw: as many colours as positions, and at least one.
inline bool complete(const PointsItem& item) {
  return item.positions && item.colours && !item.positions->empty() && item.step > 0 &&
         item.positions->size() == item.colours->size();
}

struct MeshVertex {
  Eigen::Vector3f position;
  Eigen::Vector3f normal;
  Rgba8 colour;  // alpha below 255: translucent
};
struct MeshItem {
  Shared<MeshVertex> vertices;
  Shared<std::uint32_t> triangles;  // three a triangle, anticlockwise seen from outside
  bool lit = true;
};

// Where it is seen through a translucent mesh it is dimmed; where anything else hides it, it is not drawn.
struct LineItem {
  std::vector<Eigen::Vector3f> points{};
  Rgba colour{};
  float width = 2.0f;  // px
  bool closed = false;
  bool on_top = false;        // drawn over everything (axes, ellipsoid rims)
  float hidden_alpha = 1.0f;  // on_top: opacity of the part that something hides
};

struct Scene {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::vector<PointsItem> points;
  std::vector<MeshItem> meshes;  // opaque first, then translucent back to front by centre
  std::vector<LineItem> lines;
  Rgba background_top{}, background_bottom{};
  bool fades = true;  // points into the background with distance
};

}  // namespace patchlab::viewer
