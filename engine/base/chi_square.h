// Chi-square and normal distribution, by Boost.Math.
#pragma once

namespace patchlab {

// P(chi^2_dof <= x). dof > 0, x >= 0.
double chi_square_cdf(double x, double dof);
// The upper tail P(chi^2_dof > x), accurate where it is tiny: the p-value of a chi-square.
double chi_square_p_value(double x, double dof);
// x with P(chi^2_dof <= x) = probability, probability in [0, 1).
double chi_square_quantile(double probability, double dof);
// Half-axis scale of the ellipsoid that holds `probability` of a normal distribution in `dimensions`:
// sqrt(chi_square_quantile(probability, dimensions)); 2.795 for 95 % in three dimensions.
double ellipsoid_scale(double probability, int dimensions);
// lambda = sqrt(2) erf^-1(probability), the two-sided normal quantile of the paper's step 4.
double two_sided_normal_quantile(double probability);
// log of the standard normal cdf, finite for any x (asymptotic series far in the lower tail).
double log_normal_cdf(double x);

}  // namespace patchlab
