// association_report [TRIALS] [--page FILE]: how well are patches of two views associated? Simulated rocks
// and ground, 30 % of the patches in one view only, errors drawn from the stated covariances.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "engine/map/associate.h"
#include "tests/bench/page/page.h"
#include "tests/engine/map/rock_scene.h"

namespace patchlab::test {
namespace {

struct Row {
  int patches, trials;
  Score score;
  double seconds = 0.0;
};

Row run(int patches, int trials) {
  Row row{patches, trials, {}};
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

// A share of so many, with its standard error.
std::string share(double value, int of) {
  return bench::text("%.4f ± %.4f", value, std::sqrt(std::max(0.0, value * (1.0 - value)) / std::max(1, of)));
}

std::string line(const Row& row) {
  const Score& s = row.score;
  return "| " + std::to_string(row.patches) + " | " + std::to_string(row.trials) + " | " +
         std::to_string(s.possible) + " | " + std::to_string(s.right) + " | " + std::to_string(s.wrong) +
         " | " + share(s.precision(), s.right + s.wrong) + " | " + share(s.recall(), s.possible) + " | " +
         bench::text("%.0f ms", 1e3 * row.seconds / row.trials) + " |\n";
}

std::string table(int trials) {
  std::string out =
      bench::date_and_machine() +
      ". Rocks and ground, each patch's errors and the pose's (about a degree and 15 mm) drawn from "
      "their covariances; three patches in ten are in one view only. Gate 95 %. ±: standard error.\n\n"
      "| patches | pairs of views | pairs to find | found | wrong | precision | recall | one association |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const int patches : {20, 50, 100}) out += line(run(patches, trials));
  return out;
}

}  // namespace
}  // namespace patchlab::test

int main(int argc, char** argv) {
  int trials = 20;
  std::string page;
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]) == "--page" && i + 1 < argc)
      page = argv[++i];
    else
      trials = std::max(1, std::atoi(argv[i]));
  }
  const std::string table = patchlab::test::table(trials);
  std::fputs(table.c_str(), stdout);
  if (page.empty() || patchlab::bench::write_between_marks(page, "association", table)) return 0;
  std::fprintf(stderr, "%s: cannot be written, or has no mark \"association\".\n", page.c_str());
  return 1;
}
