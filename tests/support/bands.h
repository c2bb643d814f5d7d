// Where a sample statistic may lie when what it estimates is as stated.
#pragma once

#include <vector>

namespace patchlab::test {

struct Band {
  double low, high;
  bool contains(double value) const { return low <= value && value <= high; }
};

// How many of `trials` may hit, each with probability `share`: left with at most probability `false_alarm`.
Band binomial_band(int trials, double share, double false_alarm);
// Shares that explain `hits` of `trials` (Clopper and Pearson), with at least this confidence.
Band share_interval(int hits, int trials, double confidence);
// The mean NEES/dof of `trials` fits whose errors are normal with the stated covariance.
Band nees_band(int trials, int dof, double false_alarm);
// About a mean that was expected: the values' own standard error, two-sided.
Band mean_band(double expected, const std::vector<double>& values, double false_alarm);

}  // namespace patchlab::test
