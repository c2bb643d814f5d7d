// An unbounded surface as the fit sees it: a state (k, R, c) and the local chart it is moved in (method
// M2).
//
// The chart has eight coordinates, in this order everywhere in the fit:
//   k_1 k_2   curvatures (columns of B of Table I), 1/m: k += dk
//   w         rotation about the body axes, rad:         R <- R R(w)
//   t         translation along the body axes, m:        c <- c + R Jl(w) t  (the screw; R t to first order)
// Each model frees some of them; the others are its gauge and stay fixed.
#pragma once

#include <Eigen/Core>
#include <span>

#include "engine/fit/least_squares.h"
#include "engine/patch/patch_type.h"
#include "engine/pose/rotation.h"

namespace patchlab {

inline constexpr int chart_size = 8;
using ChartVector = Eigen::Matrix<double, chart_size, 1>;
using ChartMatrix = Eigen::Matrix<double, chart_size, chart_size>;

enum class ModelKind {
  plane,
  sphere,
  circular_cylinder,
  circular_paraboloid,
  cylindric_paraboloid,
  paraboloid,  // elliptic or hyperbolic, by the signs of its curvatures
};

struct SurfaceModel {
  ModelKind kind;
  SurfaceType surface;       // the row of Table I that gives B (elliptic for `paraboloid`)
  int curvatures;            // number of k used
  int effective_parameters;  // p_eff of BIC: what the points can tell (method M5)
  bool vertex_prior;         // t_x, t_y ~ N(centroid, ...): method M4
  int free_size;
  std::array<int, chart_size> free;  // chart indices, first free_size entries

  std::span<const int> free_indices() const { return {free.data(), static_cast<std::size_t>(free_size)}; }
};
const SurfaceModel& surface_model(ModelKind kind);
// The same surface with its vertex held over a point: t_x and t_y are not free. Of the paraboloid it is the
// 2-jet there.
SurfaceModel fixed_centre(const SurfaceModel& model);

struct SurfaceState {
  Vector2d k = Vector2d::Zero();      // 1/m, the first `curvatures` entries are used
  Matrix3d R = Matrix3d::Identity();  // world_from_patch, columns x_l y_l z_l
  Vector3d c = Vector3d::Zero();      // m
};

Vector3d k3(const SurfaceModel& model, const Vector2d& k);
Vector3d to_local(const SurfaceState& state, const Vector3d& q_world);  // Eq. (4)
SurfaceState retract(const SurfaceState& state, const ChartVector& step);

// A full chart vector from the free entries (zero elsewhere), and the covariance likewise.
ChartVector spread(const SurfaceModel& model, const StepVector& free);
ChartMatrix spread(const SurfaceModel& model, const StepMatrix& free);
// The free entries of a full chart vector.
StepVector reduced(const SurfaceModel& model, const ChartVector& full);

}  // namespace patchlab
