#include "tests/support/bands.h"

#include <boost/math/distributions/binomial.hpp>
#include <cmath>

#include "engine/base/chi_square.h"
#include "tests/support/battery.h"

namespace patchlab::test {

using Binomial = boost::math::binomial_distribution<double>;

Band binomial_band(int trials, double share, double false_alarm) {
  const Binomial hits(trials, share);
  return {quantile(hits, 0.5 * false_alarm), quantile(complement(hits, 0.5 * false_alarm))};
}

Band share_interval(int hits, int trials, double confidence) {
  const double tail = 0.5 * (1.0 - confidence);
  return {Binomial::find_lower_bound_on_p(trials, hits, tail),
          Binomial::find_upper_bound_on_p(trials, hits, tail)};
}

Band nees_band(int trials, int dof, double false_alarm) {
  const double total = static_cast<double>(trials) * dof;
  return {chi_square_quantile(0.5 * false_alarm, total) / total,
          chi_square_quantile(1.0 - 0.5 * false_alarm, total) / total};
}

Band mean_band(double expected, const std::vector<double>& values, double false_alarm) {
  const double reach = two_sided_normal_quantile(1.0 - false_alarm) * deviation(values) /
                       std::sqrt(static_cast<double>(values.size()));
  return {expected - reach, expected + reach};
}

}  // namespace patchlab::test
