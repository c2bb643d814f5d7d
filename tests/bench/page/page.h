// What all tables of benchmarks share: quantiles, numbers in words, date and machine, their place in a page.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

namespace patchlab::bench {

// The value below which that share of them lies; NaN of none.
double quantile(std::vector<double> values, double share);

template <class... Numbers>
std::string text(const char* format, Numbers... numbers) {
  char buffer[128];
  std::snprintf(buffer, sizeof buffer, format, numbers...);
  return buffer;
}

// "2026-01-31, PROCESSOR, 2 cores".
std::string date_and_machine();

// Puts `inner` between the file's `<!-- mark -->` and the next `<!-- end -->`. False where it has none or
// cannot be written.
bool write_between_marks(const std::string& file, const std::string& mark, const std::string& inner);

}  // namespace patchlab::bench
