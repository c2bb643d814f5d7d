// lasso_bench [--page FILE]: points in a lasso, beside a copy of the same bytes, the plain polygon test and
// Open3D.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <numbers>

#include "engine/region/lasso.h"
#include "engine/region/polygon_mask.h"
#include "engine/region/projector.h"
#include "tests/bench/lasso/open3d.h"
#include "tests/bench/round_robin/round_robin.h"

namespace patchlab::bench {
namespace {

using Contour = std::vector<Eigen::Vector2d>;

// A wall 2.5 m before the camera, a little rough, as wide as the view: in rows as a depth camera gives it, or
// in no order.
Scan wall(std::size_t points, bool shuffled) {
  Scan scan;
  std::uint64_t state = 1;
  const auto next = [&state] {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return static_cast<double>(state >> 11) * 0x1p-53;
  };
  const auto columns = static_cast<std::size_t>(std::sqrt(static_cast<double>(points) * 1.6));
  const double rows = static_cast<double>(points) / static_cast<double>(columns);
  for (std::size_t i = 0; i < points; ++i) {
    const double s = shuffled ? next() : static_cast<double>(i % columns) / static_cast<double>(columns);
    const double t = shuffled ? next() : static_cast<double>(i / columns) / rows;
    scan.positions.emplace_back(
        Eigen::Vector3d(3.4 * s - 1.7, 2.1 * t - 1.05, 0.02 * next() - 2.5).cast<float>());
  }
  scan.finite.assign(points, 1);
  scan.finite_count = points;
  return scan;
}

// Wavy, round the middle of 1920 x 1080, 16 % of the view.
Contour contour(int corners) {
  Contour all;
  for (int i = 0; i < corners; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / corners, r = 325.0 * (1.0 + 0.1 * std::sin(5.0 * turn));
    all.emplace_back(960.0 + r * std::cos(turn), 540.0 + r * std::sin(turn));
  }
  return all;
}

ViewCamera camera() {
  ViewCamera camera;
  camera.viewport = {1920, 1080};
  return camera;
}

std::vector<std::uint32_t> plain_lasso(const Scan& scan, const Contour& corners) {
  const ViewCamera view = camera();
  const Projector project_point(view);
  const std::vector<PolygonEdge> edges = polygon_edges(corners);
  std::vector<std::uint32_t> ids;
  for (std::uint32_t i = 0; i < scan.size(); ++i) {
    const Projected p = project_point(scan.point(i));
    if (in_depth(view, p.depth) && inside_polygon(edges, p.x, p.y)) ids.push_back(i);
  }
  return ids;
}

// Points that one has and the other has not.
std::size_t differing(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  return combine(a, b, SelectMode::add).size() - combine(a, b, SelectMode::intersect).size();
}

struct Case {
  std::size_t points;
  bool shuffled;
  std::string words() const {
    return std::to_string(points / 1000000) + " million, " + (shuffled ? "in no order" : "row by row");
  }
};

// One line of the table: the times of one cloud.
std::string line(const Case& one) {
  const Scan scan = wall(one.points, one.shuffled);
  const std::unique_ptr<char[]> copy(new char[12 * one.points]);
  RoundRobin times(one.points > 1000000 ? 7 : 21);
  std::vector<std::uint32_t> ids, plain;
  times.add("copy", [&] { std::memcpy(copy.get(), scan.positions.data(), 12 * one.points); });
  for (const int corners : {100, 500}) {
    const auto lasso = [&, corners] { ids = select_lasso(scan, camera(), contour(corners)); };
    times.add(std::to_string(corners), lasso);
    times.add(std::to_string(corners) + ", 2 threads", lasso, 2);
  }
  times.add(
      "copy on the wall", [&] { std::memcpy(copy.get(), scan.positions.data(), 12 * one.points); }, 2);
  times.run();
  RoundRobin slow(1);
  slow.add("plain", [&] { plain = plain_lasso(scan, contour(500)); });
  slow.run();
  std::string text = "| " + one.words() + " | " + time_of(times, "copy");
  for (const std::string name : {"100", "500"})
    text += " | " + time_of(times, name) + ", " + ratio_of(times, name, "copy");
  text += " | " + ratio_of(times, "500, 2 threads", "copy on the wall");
  text += " | " + time_of(slow, "plain") + " | " + std::to_string(differing(ids, plain)) + " |\n";
  return text;
}

}  // namespace
}  // namespace patchlab::bench

int main(int argc, char** argv) {
  using namespace patchlab::bench;
  std::string text =
      date_and_machine() +
      ". A lasso of 100 or 500 corners round 16 % of the view, on points of 12 bytes; ×: times a copy "
      "of them. Medians of processor time, half of the middle half as ±; two threads: least times.\n\n"
      "| points | copy | 100 corners | 500 corners | 500, two threads | every point against 500 edges | "
      "points that differ |\n|---|---|---|---|---|---|---|\n";
  for (const Case& one : {Case{1000000, false}, {1000000, true}, {10000000, false}, {10000000, true}})
    text += line(one);
  text += open3d_crop(1000000, contour(500));
  return report(argc, argv, "lasso", text);
}
