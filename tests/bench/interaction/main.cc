// What happens between a lasso and its picture, stage by stage, on a ball before a wall; and the lasso beside
// a plain polygon test of every point, in one run.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "engine/fit/fit_patch.h"
#include "engine/region/lasso.h"
#include "engine/region/observe.h"
#include "engine/region/polygon_mask.h"
#include "engine/region/projector.h"
#include "engine/region/visibility.h"
#include "tests/bench/round_robin/round_robin.h"
#include "viewer/camera/orbit_camera.h"
#include "viewer/platform/platform.h"
#include "viewer/render/renderer.h"

namespace patchlab::viewer {
namespace {

using Contour = std::vector<Eigen::Vector2d>;
constexpr int repeats = 5;

// The least processor time of some repeats, ms: other work on the machine does not count. Work of several
// threads counts for each.
double least_ms(const std::function<void()>& work) {
  double least = 1e300;
  for (int i = 0; i < repeats; ++i) {
    const std::clock_t start = std::clock();
    work();
    least = std::min(least, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return least;
}

// A ball of 0.3 m, 1.5 m before the camera, in front of a wall; in no order, as scans are after a shuffle.
std::shared_ptr<const Scan> ball_and_wall(std::size_t points) {
  auto scan = std::make_shared<Scan>();
  std::uint64_t state = 1;
  const auto next = [&state] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 11) * 0x1p-53;
  };
  for (std::size_t i = 0; i < points; ++i) {
    if (i % 4 == 0) {
      const double z = 2 * next() - 1, turn = 2 * std::numbers::pi * next(), r = std::sqrt(1 - z * z);
      const Eigen::Vector3d out(r * std::cos(turn), r * std::sin(turn), z);
      scan->positions.push_back((Eigen::Vector3d(0, 0, 1.8) + 0.3 * out).cast<float>());
    } else {
      scan->positions.emplace_back(Eigen::Vector3d(4 * next() - 2, 3 * next() - 1.5, 2.5).cast<float>());
    }
  }
  scan->finite.assign(points, 1);
  scan->finite_count = points;
  return scan;
}

// Round the ball, with as many corners as a hand draws.
Contour contour(const ViewCamera& camera) {
  Contour corners;
  for (int i = 0; i < 200; ++i) {
    const double turn = 2 * std::numbers::pi * i / 200,
                 r = 0.13 * camera.viewport[1] * (1 + 0.1 * std::sin(5 * turn));
    corners.emplace_back(camera.viewport[0] / 2.0 + r * std::cos(turn),
                         camera.viewport[1] / 2.0 + r * std::sin(turn));
  }
  return corners;
}

std::vector<std::uint32_t> plain_lasso(const Scan& scan, const ViewCamera& camera, const Contour& corners) {
  const Projector project_point(camera);
  const std::vector<PolygonEdge> edges = polygon_edges(corners);
  std::vector<std::uint32_t> ids;
  for (std::uint32_t i = 0; i < scan.size(); ++i) {
    const Projected p = project_point(scan.point(i));
    if (in_depth(camera, p.depth) && inside_polygon(edges, p.x, p.y)) ids.push_back(i);
  }
  return ids;
}

std::string compare_lassos(std::size_t points, const ViewCamera& camera) {
  const std::shared_ptr<const Scan> scan = ball_and_wall(points);
  const Contour corners = contour(camera);
  std::vector<std::uint32_t> ours, plain;
  const double ours_ms = least_ms([&] { ours = select_lasso(*scan, camera, corners); });
  const double plain_ms = least_ms([&] { plain = plain_lasso(*scan, camera, corners); });
  char text[256];
  std::snprintf(
      text, sizeof text,
      "\nA lasso of 200 corners over %zu points in no order: %.1f ms; a plain polygon test of every point %.0f ms, %.0f "
      "times longer; %s.\n",
      points, ours_ms, plain_ms, plain_ms / ours_ms,
      ours == plain ? "the same points" : "NOT THE SAME POINTS");
  return text;
}

// What was timed, in order, ms.
using Stages = std::vector<std::pair<std::string, double>>;

void time_stages(std::size_t points, const ViewCamera& camera, Stages& stages) {
  const std::shared_ptr<const Scan> scan = ball_and_wall(points);
  const NoiseModel noise = *noise_model("isotropic:0.001");
  const Contour corners = contour(camera);
  std::vector<std::uint32_t> inside, seen;
  const auto say = [&](const std::string& stage, double ms) { stages.emplace_back(stage, ms); };
  const double mask = least_ms([&] { inside = select_lasso(*scan, camera, corners); });
  say("mask: points inside the lasso", mask);
  VisibilityCache cache;
  say("visibility, once a camera", least_ms([&] { (void)visible_points(*scan, camera, 0.006); }));
  (void)cache.get(scan, camera, 0.006);
  const double visible = least_ms([&] {
    const auto of_camera = cache.get(scan, camera, 0.006);
    seen.clear();
    for (const std::uint32_t id : inside)
      if ((*of_camera)[id]) seen.push_back(id);
  });
  say("visibility, while the camera stands still", visible);
  std::vector<std::uint32_t> some;
  for (std::size_t i = 0; i < seen.size(); i += 1 + seen.size() / 5000) some.push_back(seen[i]);
  FitOptions sphere;
  sphere.surface = SurfaceRequest::sphere;
  const auto fit = [&](const std::vector<std::uint32_t>& ids) {
    (void)fit_patch(*observe(*scan, noise, ids), sphere);
  };
  const double preview = least_ms([&] { fit(some); });
  say("fit of a sphere to a preview's points", preview);
  say("fit of a sphere to all points", least_ms([&] { fit(seen); }));
  Scene scene;
  const auto colours = [&] {
    auto fresh = std::make_shared<std::vector<Rgba8>>(scan->size(), Rgba8{180, 180, 180, 255});
    for (const std::uint32_t id : seen) (*fresh)[id] = {255, 230, 170, 255};
    scene.points = {{{scan, &scan->positions}, fresh}};
  };
  const double paint = least_ms(colours);
  say("colours of all points", paint);
  say("outside OpenGL, on the worker and beside it", mask + visible + preview + paint);
  Result<std::unique_ptr<Platform>> platform =
      make_platform({"bench", camera.viewport[0], camera.viewport[1], true, 1.0f});
  Result<Renderer> renderer = platform ? Renderer::create() : Result<Renderer>(platform.error());
  if (!renderer) return (void)std::printf("  no picture: %s\n", renderer.error().message.c_str());
  ViewCamera moved = camera;
  const auto frame = [&] {
    (*platform)->begin_frame();
    renderer->draw(scene, moved, {0, 0, camera.viewport[0], camera.viewport[1]});
    (*platform)->end_frame();
    (void)(*platform)->read_image();
  };
  say("upload and frame", least_ms([&] {
                            colours();
                            frame();
                          }) - paint);
  say("frame, while nothing changes", least_ms(frame));
  say("frame of all points, while the camera moves", least_ms([&] {
        moved.position.x() += 1e-3;
        frame();
      }));
  std::printf("  drawn by %s\n", (*platform)->gl_renderer().c_str());
}

// A line a stage, a column a size.
std::string stages_table(const std::vector<std::size_t>& sizes, const ViewCamera& camera) {
  std::vector<Stages> all(sizes.size());
  std::string text = "| one turn of the loop, ms |", rule = "\n|---|";
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    time_stages(sizes[k], camera, all[k]);
    text += " " + std::to_string(sizes[k]) + " points |";
    rule += "---|";
  }
  text += rule + "\n";
  for (std::size_t row = 0; row < all.front().size(); ++row) {
    text += "| " + all.front()[row].first + " |";
    for (const Stages& stages : all) {
      char ms[32] = " - |";
      if (row < stages.size()) std::snprintf(ms, sizeof ms, " %.2f |", stages[row].second);
      text += ms;
    }
    text += "\n";
  }
  return text;
}

}  // namespace
}  // namespace patchlab::viewer

int main(int argc, char** argv) {
  using namespace patchlab::viewer;
  std::vector<std::size_t> sizes;
  for (int i = 1; i < argc; ++i) {
    if (const double points = std::atof(argv[i]); points >= 1.0)
      sizes.push_back(static_cast<std::size_t>(points));
  }
  if (sizes.empty()) sizes = {125'000, 1'000'000, 5'000'000, 20'000'000};
  OrbitCamera orbit;
  orbit.pivot = {0, 0, 1.8};
  orbit.up = -Eigen::Vector3d::UnitY();
  orbit.elevation = 0.0;
  orbit.distance = 1.8;
  const patchlab::ViewCamera camera = view_camera(orbit, 1280, 800);
  const std::string text =
      patchlab::bench::date_and_machine() +
      ". A ball before a wall, points in no order, a lasso round the ball. Least processor time of "
      "five, all threads' together.\n\n" +
      stages_table(sizes, camera) + compare_lassos(5'000'000, camera);
  return patchlab::bench::report(argc, argv, "interaction", text);
}
