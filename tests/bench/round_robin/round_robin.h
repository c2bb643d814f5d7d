// Candidates timed in turn: each round runs every one of them once, so that what else the machine does meets
// all alike, and ratios are taken within a round.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/bench/page/page.h"

namespace patchlab::bench {

class RoundRobin {
 public:
  // With how many threads. One: processor time of the process counts. More: the time on the wall.
  explicit RoundRobin(int rounds) : rounds_(rounds) {}
  void add(const std::string& name, std::function<void()> work, int threads = 1);
  // After one round that does not count.
  void run();

  bool has(const std::string& name) const;
  double median_ms(const std::string& name) const;
  double least_ms(const std::string& name) const;
  // Half of the middle half of the times, over the median.
  double spread(const std::string& name) const;
  // Median of the rounds' ratios of times; where either has several threads, that of the least times, since
  // time on the wall is other work's too.
  double ratio(const std::string& name, const std::string& reference) const;

 private:
  struct Candidate {
    std::string name;
    std::function<void()> work;
    int threads;
    std::vector<double> ms;
  };
  const Candidate& find(const std::string& name) const;

  int rounds_;
  std::vector<Candidate> candidates_;
};

// "1.20 ms ±2 %", "740 µs ±3 %"; "-" where it did not run.
std::string time_of(const RoundRobin& times, const std::string& name);
// "18 ×", "0.92 ×"; "-" where either did not run.
std::string ratio_of(const RoundRobin& times, const std::string& name, const std::string& reference);

// With `--page FILE` among the arguments, puts text between the file's `<!-- mark -->` and `<!-- end -->`;
// prints it in any case. The program's exit status.
int report(int argc, char** argv, const std::string& mark, const std::string& text);

}  // namespace patchlab::bench
