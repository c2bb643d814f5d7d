// The medians of interleaved repetitions, as the table of the README.
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

namespace patchlab::bench {

// Collects the time of one fit of every repetition, beside what Google Benchmark prints.
class Collector : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override;

  double median(const std::string& name) const;  // us of one item; NaN where it did not run
  double spread(
      const std::string& name) const;  // half of the middle half of the repetitions, over the median

 private:
  std::map<std::string, std::vector<double>> times_;
};

// "9.5 µs ±3 %", "1.20 ms ±2 %"; "-" for NaN.
std::string duration(double us, double spread);
// ", 18 ×"; nothing for NaN.
std::string ratio(double of, double to);

// "0.97": of the growth from one size to another.
std::string exponent(double us, double us_before, std::size_t size, std::size_t size_before);

// Today and the kind of machine.
std::string when_and_where();

}  // namespace patchlab::bench
