// grid_bench [--page FILE]: normals of a depth camera's scan, and the pixels of a window, beside PCL.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "engine/scan/grid_normals.h"
#include "engine/scan/neighbours.h"
#include "tests/bench/grid/pcl_grid.h"
#include "tests/bench/grid/scene.h"
#include "tests/bench/round_robin/round_robin.h"

namespace patchlab::bench {
namespace {

struct Errors {
  double median = 0.0;  // degrees, away from edges
  double share = 0.0;   // of the finite points that have a normal
};

Errors errors_of(const SeenScene& scene, const std::vector<Eigen::Vector3f>& normals) {
  std::vector<double> degrees;
  std::size_t told = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (!scene.scan.finite[i] || !normals[i].allFinite()) continue;
    ++told;
    const auto cosine = static_cast<double>(std::abs(normals[i].dot(scene.normals[i])));
    if (!scene.near_edge[i]) degrees.push_back(57.29578 * std::acos(std::min(cosine, 1.0)));
  }
  std::ranges::nth_element(degrees, degrees.begin() + static_cast<std::ptrdiff_t>(degrees.size() / 2));
  return {degrees[degrees.size() / 2],
          static_cast<double>(told) / static_cast<double>(scene.scan.finite_count)};
}

std::string normals_table(const SeenScene& scene) {
  PclGrid pcl(scene.scan);
  std::vector<Eigen::Vector3f> ours, copy(scene.scan.size());
  RoundRobin times(9), slow(1);
  times.add("ours", [&] { ours = grid_normals(scene.scan); });
  times.add(
      "ours, two threads", [&] { ours = grid_normals(scene.scan); }, 2);
  times.add("covariance", [&] { pcl.integral_covariance(); });
  times.add("gradient", [&] { pcl.integral_gradient(); });
  times.add("copy", [&] {
    std::memcpy(static_cast<void*>(copy.data()), scene.scan.positions.data(), 12 * copy.size());
  });
  times.run();
  slow.add("nearest", [&] { pcl.nearest_twenty(); });
  slow.run();
  std::string text =
      "| normals | time | times ours | median error | points with a normal |\n|---|---|---|---|---|\n";
  const auto line = [&](const char* words, const RoundRobin& of, const char* name, const Errors& errors) {
    char quality[64];
    std::snprintf(quality, sizeof quality, " | %.1f° | %.0f %% |\n", errors.median, 100.0 * errors.share);
    const std::string ratio =
        of.has("ours")
            ? ratio_of(of, name, "ours")
            : std::to_string(static_cast<int>(of.median_ms(name) / times.median_ms("ours"))) + " ×";
    text += "| " + std::string(words) + " | " + time_of(of, name) + " | " + ratio + quality;
  };
  line("`grid_normals`, 11 x 11", times, "ours", errors_of(scene, ours));
  line("the same, two threads", times, "ours, two threads", errors_of(scene, ours));
  line("PCL `NormalEstimation`, 20 nearest", slow, "nearest", errors_of(scene, pcl.normals()));
  pcl.integral_covariance();
  line("PCL `IntegralImageNormalEstimation`, covariance, 11", times, "covariance",
       errors_of(scene, pcl.normals()));
  pcl.integral_gradient();
  line("the same, average gradient", times, "gradient", errors_of(scene, pcl.normals()));
  return text + "| a copy of the points | " + time_of(times, "copy") + " | " +
         ratio_of(times, "copy", "ours") + " | | |\n";
}

// Of 500 points, all others within 7.5 cm: by the k-d tree, and in the window of pixels that they lie in.
std::string window_table(const Scan& scan) {
  constexpr float radius = 0.075F;
  std::vector<std::uint32_t> seeds;
  for (std::uint32_t i = 0; i < scan.size() && seeds.size() < 500; i += 607) {
    if (scan.finite[i]) seeds.push_back(i);
  }
  const NeighbourIndex index(scan);
  std::vector<Neighbour> near;
  std::vector<std::uint32_t> pixels;
  std::size_t by_tree = 0, by_window = 0;
  RoundRobin times(9);
  times.add("tree", [&] {
    by_tree = 0;
    for (const std::uint32_t seed : seeds) {
      index.within(scan.positions[seed], radius, near);
      by_tree += near.size();
    }
  });
  times.add("window", [&] {
    by_window = 0;
    for (const std::uint32_t seed : seeds) {
      const Eigen::Vector3f here = scan.positions[seed];
      const auto reach = static_cast<std::uint32_t>(2.0F * 525.0F * radius / here.z());
      grid_neighbours(scan, seed, reach, pixels);
      by_window += 1 + static_cast<std::size_t>(std::ranges::count_if(pixels, [&](std::uint32_t id) {
                     return (scan.positions[id] - here).squaredNorm() <= radius * radius;
                   }));
    }
  });
  times.add("build", [&] { const NeighbourIndex again(scan); });
  times.run();
  char text[512];
  std::snprintf(
      text, sizeof text,
      "\nThe points within 7.5 cm of %zu points: by PCL's k-d tree %s (%zu points; its making %s), in windows of pixels %s "
      "(%zu points), %s less.\n",
      seeds.size(), time_of(times, "tree").c_str(), by_tree, time_of(times, "build").c_str(),
      time_of(times, "window").c_str(), by_window, ratio_of(times, "tree", "window").c_str());
  return text;
}

}  // namespace
}  // namespace patchlab::bench

int main(int argc, char** argv) {
  using namespace patchlab::bench;
  const SeenScene scene = ground_and_boulders(*patchlab::noise_model("kinect1"));
  const std::string text =
      date_and_machine() + ". Boulders on the ground, 640 x 480 pixels of a simulated Kinect, " +
      std::to_string(scene.scan.finite_count) +
      " points. Medians of processor time, half of the middle half as ±; two threads: least times.\n\n" +
      normals_table(scene) + window_table(scene.scan);
  return report(argc, argv, "normals", text);
}
