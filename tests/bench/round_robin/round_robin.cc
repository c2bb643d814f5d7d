#include "tests/bench/round_robin/round_robin.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>

namespace patchlab::bench {
namespace {

double now_ms(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

}  // namespace

void RoundRobin::add(const std::string& name, std::function<void()> work, int threads) {
  candidates_.push_back({name, std::move(work), threads, {}});
}

void RoundRobin::run() {
  for (int round = 0; round <= rounds_; ++round) {
    for (Candidate& candidate : candidates_) {
      const clockid_t clock = candidate.threads == 1 ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC;
      tbb::task_arena(candidate.threads).execute([&] {
        const double start = now_ms(clock);
        candidate.work();
        if (round > 0) candidate.ms.push_back(now_ms(clock) - start);
      });
    }
  }
}

bool RoundRobin::has(const std::string& name) const {
  return std::ranges::any_of(candidates_, [&](const Candidate& one) { return one.name == name; });
}

const RoundRobin::Candidate& RoundRobin::find(const std::string& name) const {
  return *std::ranges::find_if(candidates_, [&](const Candidate& one) { return one.name == name; });
}

double RoundRobin::median_ms(const std::string& name) const { return quantile(find(name).ms, 0.5); }

double RoundRobin::least_ms(const std::string& name) const { return quantile(find(name).ms, 0.0); }

double RoundRobin::spread(const std::string& name) const {
  const std::vector<double>& ms = find(name).ms;
  return 0.5 * (quantile(ms, 0.75) - quantile(ms, 0.25)) / quantile(ms, 0.5);
}

double RoundRobin::ratio(const std::string& name, const std::string& reference) const {
  const Candidate &one = find(name), &other = find(reference);
  if (one.threads > 1 || other.threads > 1) return least_ms(name) / least_ms(reference);
  std::vector<double> ratios;
  for (std::size_t i = 0; i < one.ms.size(); ++i) ratios.push_back(one.ms[i] / other.ms[i]);
  return quantile(ratios, 0.5);
}

std::string time_of(const RoundRobin& times, const std::string& name) {
  if (!times.has(name)) return "-";
  const double ms = times.median_ms(name);
  return (ms < 0.1   ? text("%.1f µs", 1e3 * ms)
          : ms < 1.0 ? text("%.0f µs", 1e3 * ms)
                     : text(ms < 100.0 ? "%.2f ms" : "%.0f ms", ms)) +
         text(" ±%.0f %%", 100.0 * times.spread(name));
}

std::string ratio_of(const RoundRobin& times, const std::string& name, const std::string& reference) {
  if (!times.has(name) || !times.has(reference)) return "-";
  const double ratio = times.ratio(name, reference);
  return text(ratio < 3.0 ? "%.2f ×" : ratio < 30.0 ? "%.1f ×" : "%.0f ×", ratio);
}

int report(int argc, char** argv, const std::string& mark, const std::string& text) {
  std::fputs(text.c_str(), stdout);
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::strcmp(argv[i], "--page") != 0) continue;
    if (write_between_marks(argv[i + 1], mark, text)) return 0;
    std::fprintf(stderr, "%s: no place for <!-- %s -->\n", argv[i + 1], mark.c_str());
    return 1;
  }
  return 0;
}

}  // namespace patchlab::bench
