// How well are patches of two views associated? Simulated rocks and ground, 30 % of the patches in one view
// only, errors drawn from the stated covariances.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "engine/map/associate.h"
#include "tests/engine/map/rock_scene.h"

namespace patchlab::test {
namespace {

struct Row {
  Score score;
  double seconds = 0.0;
};

Row run(int patches, int trials) {
  Row row;
  for (int trial = 0; trial < trials; ++trial) {
    Random random(static_cast<std::uint64_t>(1000 * patches + trial));
    const TwoViews views = two_views(random, patches);
    const auto start = std::chrono::steady_clock::now();
    const Association found = associate(views.a.patches, views.b.patches, views.b.map_from_view);
    row.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    row.score += score(found.matches, views.a, views.b);
  }
  return row;
}

}  // namespace
}  // namespace patchlab::test

int main(int argc, char** argv) {
  const int trials = argc > 1 ? std::max(1, std::atoi(argv[1])) : 20;
  std::printf("patches  trials  precision  recall  s per association\n");
  for (const int patches : {20, 50, 100}) {
    const patchlab::test::Row row = patchlab::test::run(patches, trials);
    std::printf("%7d  %6d  %9.4f  %6.4f  %.3f\n", patches, trials, row.score.precision(), row.score.recall(),
                row.seconds / trials);
  }
}
