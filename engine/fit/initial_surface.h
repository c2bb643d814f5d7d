// Where the fits start: the plane of step 1 and a quadratic height field over it (method M1).
// Points count by their robust weight. Results are about the samples' origin.
#pragma once

#include <array>
#include <initializer_list>
#include <vector>

#include "engine/fit/samples.h"
#include "engine/fit/surface_model.h"

namespace patchlab {

// Plane by principal components (LLS, covariances ignored), through the mean, z_l towards the viewpoint.
SurfaceState initial_plane(const Samples& samples);

// z = a + b'u + u'H u / 2 by weighted linear least squares over a frame, re-framed once to the normal over
// the centroid. The state: c on the surface over the mean, axes along the principal curvatures, k = (k_x,
// k_y), |k_x| <= |k_y|.
SurfaceState height_field(const Samples& samples, const SurfaceState& frame);
// The same on a few points only, for RANSAC; one pass, axes not turned.
struct Quadric {
  SurfaceState frame;
  Eigen::Matrix<double, 6, 1> a;  // z = a0 + a1 x + a2 y + a3 x^2/2 + a4 xy + a5 y^2/2, in the frame
};
Quadric quadric_through(const Samples& samples, const SurfaceState& frame,
                        const std::vector<std::size_t>& points);
// Signed residual of a sample against a quadric, in standard deviations (Sampson).
double quadric_residual(const Quadric& quadric, const Samples& samples, std::size_t i);

// A few states, without a heap.
class Starts {
 public:
  Starts() = default;
  Starts(std::initializer_list<SurfaceState> states) {
    for (const SurfaceState& state : states) push_back(state);
  }
  void push_back(const SurfaceState& state) { states_[size_++] = state; }
  std::size_t size() const { return size_; }
  const SurfaceState* begin() const { return states_.data(); }
  const SurfaceState* end() const { return states_.data() + size_; }

 private:
  std::array<SurfaceState, 5> states_;
  std::size_t size_ = 0;
};

// The states from which a model's fit is tried; the lower exact cost is kept. Both axes for the cylindric
// ones (method M1), algebraic spheres and cylinders beside the height field for those.
Starts starts(const Samples& samples, const SurfaceModel& model, const SurfaceState& quadratic);

// Frame with z along `normal`, turned from R by the least rotation.
Matrix3d turned_to(const Matrix3d& R, const Vector3d& normal);

}  // namespace patchlab
