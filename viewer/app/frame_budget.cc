// How many points a frame draws: while the camera moves, as many as can be drawn in time; all of them as soon
// as it stands still. What a lasso selects and a fit uses never depends on it.
#include <chrono>
#include <cmath>

#include "viewer/app/app.h"

namespace patchlab::viewer {

namespace {

constexpr double while_moving = 0.025;  // s a frame, for the points
constexpr double at_rest_after = 0.15;  // s

bool same_view(const ViewCamera& one, const ViewCamera& other) {
  return one.position == other.position && one.quaternion_xyzw == other.quaternion_xyzw &&
         one.fov_y == other.fov_y && one.height == other.height && one.perspective == other.perspective;
}

// Primes, so that no pattern of a pixel grid is left.
std::size_t prime_of_at_least(double wanted) {
  constexpr std::size_t primes[] = {1, 2, 3, 5, 7, 11, 13, 17, 23, 31, 43, 61, 89, 127, 181, 257};
  for (const std::size_t prime : primes)
    if (static_cast<double>(prime) >= wanted) return prime;
  return primes[std::size(primes) - 1];
}

}  // namespace

std::size_t App::points_one_in() {
  const ViewCamera now = view();
  if (!same_view(now, budget_.drawn)) budget_.moved_at = ImGui::GetTime();
  budget_.drawn = now;
  const bool moves = !picture_ && ImGui::GetTime() - budget_.moved_at < at_rest_after;
  const double needed = static_cast<double>(stage_.points()) * budget_.per_point;
  budget_.one_in = moves ? prime_of_at_least(needed / while_moving) : 1;
  return budget_.one_in;
}

void App::draw_scene(const ViewCamera& camera) {
  if (!platform_.drawing()) return;
  const Rect& view = layout_.view;
  Scene scene = stage_.scene();
  if (ground_) {
    scene.background_top = scene.background_bottom = *ground_;
    scene.fades = false;
  }
  const auto start = std::chrono::steady_clock::now();
  renderer_.draw(scene, camera,
                 {static_cast<int>(view.x), platform_.height() - static_cast<int>(view.bottom()),
                  static_cast<int>(view.width), static_cast<int>(view.height)});
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  const std::size_t drawn = stage_.points() / budget_.one_in;
  if (drawn > 0) budget_.per_point = took.count() / static_cast<double>(drawn);
}

}  // namespace patchlab::viewer
