// Quadrilaterals and rectangles by maximum likelihood with a soft edge (method M7): points
// cover the shape evenly and are smeared by sigma, so the likelihood of a shape of area A is
//   -N ln A + sum_i w_i sum_e ln Phi(distance_ie / sigma),  w_i of sum N.
#pragma once

#include <optional>
#include <vector>

#include "engine/fit/edge_quad.h"

namespace patchlab {

struct SoftShape {
  EdgeVector edges;
  double inset = 0.0;                          // m: how far inside the true edges these lie, by the softening
  EdgeMatrix covariance = EdgeMatrix::Zero();  // inverse of the information; rank 5 for a rectangle
  double log_likelihood = 0.0;
};

enum class Corners { free, right };  // a convex quad, or a rectangle

// `weights` sum to 1; `used` is N; `lateral_variance` that of the points' noise in the plane, m^2. Nothing
// where the points do not tell four edges from fewer: those of a triangle, or of a line.
std::optional<SoftShape> fit_soft_edges(const std::vector<Vector2d>& points,
                                        const std::vector<double>& weights, double used,
                                        double lateral_variance, Corners corners);

}  // namespace patchlab
