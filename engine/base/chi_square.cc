#include "engine/base/chi_square.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>

namespace patchlab {
namespace {

// Where a tail is below the least double, and Boost's own steps overflow, and throw.
bool is_far_up(double x, double dof) { return !(x < dof + 1e4 * (1.0 + std::sqrt(2.0 * dof))); }
bool is_far_down(double x, double dof) { return dof > 1000.0 && x < 0.05 * dof; }

}  // namespace

double chi_square_cdf(double x, double dof) {
  if (is_far_down(x, dof)) return 0.0;
  return is_far_up(x, dof) ? 1.0 : boost::math::cdf(boost::math::chi_squared(dof), x);
}

double chi_square_p_value(double x, double dof) {
  if (is_far_down(x, dof)) return 1.0;
  return is_far_up(x, dof) ? 0.0
                           : boost::math::cdf(boost::math::complement(boost::math::chi_squared(dof), x));
}

double chi_square_quantile(double probability, double dof) {
  return boost::math::quantile(boost::math::chi_squared(dof), probability);
}

double ellipsoid_scale(double probability, int dimensions) {
  return std::sqrt(chi_square_quantile(probability, dimensions));
}

double two_sided_normal_quantile(double probability) {
  return std::numbers::sqrt2 * boost::math::erf_inv(probability);
}

double log_normal_cdf(double x) {
  if (x > 0.0) return std::log1p(-0.5 * std::erfc(x / std::numbers::sqrt2));
  if (x > -30.0) return std::log(0.5 * std::erfc(-x / std::numbers::sqrt2));
  const double inverse_square = 1.0 / (x * x);
  return -0.5 * x * x - std::log(-x) - 0.5 * std::log(2.0 * std::numbers::pi) +
         std::log1p(-inverse_square * (1.0 - 3.0 * inverse_square));
}

}  // namespace patchlab
