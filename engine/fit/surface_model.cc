#include "engine/fit/surface_model.h"

#include <array>

#include "engine/patch/patch_type.h"

namespace patchlab {
namespace {

enum Chart { k_1, k_2, w_x, w_y, w_z, t_x, t_y, t_z };

// Method M2: free parameters with the gauge fixed; p_eff of M5.
constexpr std::array<SurfaceModel, 6> models = {{
    {ModelKind::plane, SurfaceType::plane, 0, 3, false, 3, {w_x, w_y, t_z}},
    {ModelKind::sphere, SurfaceType::sphere, 1, 4, false, 4, {k_1, w_x, w_y, t_z}},
    {ModelKind::circular_cylinder, SurfaceType::circular_cylinder, 1, 5, false, 5, {k_1, w_x, w_y, w_z, t_z}},
    {ModelKind::circular_paraboloid,
     SurfaceType::circular_paraboloid,
     1,
     4,
     true,
     6,
     {k_1, w_x, w_y, t_x, t_y, t_z}},
    {ModelKind::cylindric_paraboloid,
     SurfaceType::cylindric_paraboloid,
     1,
     5,
     true,
     6,
     {k_1, w_x, w_y, w_z, t_y, t_z}},
    {ModelKind::paraboloid,
     SurfaceType::elliptic_paraboloid,
     2,
     6,
     true,
     8,
     {k_1, k_2, w_x, w_y, w_z, t_x, t_y, t_z}},
}};

}  // namespace

const SurfaceModel& surface_model(ModelKind kind) { return models[static_cast<std::size_t>(kind)]; }

SurfaceModel fixed_centre(const SurfaceModel& model) {
  SurfaceModel fixed = model;
  fixed.vertex_prior = false;
  fixed.free_size = 0;
  for (const int index : model.free_indices()) {
    if (index != t_x && index != t_y) fixed.free[static_cast<std::size_t>(fixed.free_size++)] = index;
  }
  return fixed;
}

Vector3d k3(const SurfaceModel& model, const Vector2d& k) {
  const PatchTypeRow& row = *find_patch_type(model.surface, default_boundary(model.surface));
  return row.B * k.head(model.curvatures);
}

Vector3d to_local(const SurfaceState& state, const Vector3d& q_world) {
  return state.R.transpose() * (q_world - state.c);
}

SurfaceState retract(const SurfaceState& state, const ChartVector& step) {
  const Vector3d w = step.segment<3>(w_x), t = step.segment<3>(t_x);
  SurfaceState moved;
  moved.k = state.k + step.head<2>();
  moved.R = state.R * exp_map(w);
  moved.c = state.c + state.R * (left_jacobian(w) * t);
  return moved;
}

ChartVector spread(const SurfaceModel& model, const StepVector& free) {
  ChartVector full = ChartVector::Zero();
  for (int i = 0; i < model.free_size; ++i) full[model.free[static_cast<std::size_t>(i)]] = free[i];
  return full;
}

ChartMatrix spread(const SurfaceModel& model, const StepMatrix& free) {
  ChartMatrix full = ChartMatrix::Zero();
  const auto indices = model.free_indices();
  for (int i = 0; i < model.free_size; ++i) {
    for (int j = 0; j < model.free_size; ++j) {
      full(indices[static_cast<std::size_t>(i)], indices[static_cast<std::size_t>(j)]) = free(i, j);
    }
  }
  return full;
}

StepVector reduced(const SurfaceModel& model, const ChartVector& full) {
  StepVector free(model.free_size);
  for (int i = 0; i < model.free_size; ++i) free[i] = full[model.free[static_cast<std::size_t>(i)]];
  return free;
}

}  // namespace patchlab
