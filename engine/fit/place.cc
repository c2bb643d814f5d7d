#include "engine/fit/place.h"

#include <cmath>

namespace patchlab {
namespace {

// Second moment about c along a pair of directions.
Dual moment(const Ingredients& from, const Dual3& c, const Dual3& a, const Dual3& b) {
  const Dual a_mean = dot(a, from.mean), b_mean = dot(b, from.mean), a_c = dot(a, c), b_c = dot(b, c);
  Dual sum = a_c * b_c - a_mean * b_c - a_c * b_mean;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) sum += a[i] * b[j] * from.second(i, j);
  }
  return sum;
}
Dual variance(const Ingredients& from, const Placed& placed, const Dual3& along) {
  return moment(from, placed.c, along, along);
}

Dual length(const Dual& variance, double factor) {
  return variance.value() > 0.0 ? Dual(factor * sqrt(variance)) : constant(0.0);
}

Placed as_fitted() {
  return {constant(Vector3d::UnitX()),
          constant(Vector3d::UnitY()),
          constant(Vector3d::UnitZ()),
          constant(Vector3d::Zero()),
          {constant(0.0), constant(0.0)}};
}

bool is_cylinder(const PatchPlan& plan) { return plan.type->surface == SurfaceType::circular_cylinder; }

void complete_frame(Placed& placed) {
  placed.x = normalised(difference(placed.x, scaled(placed.z, dot(placed.z, placed.x))));
  placed.y = cross(placed.z, placed.x);
}

// Method M6: the apex of a sphere or cylinder moves so that z_l passes through the
// centroid; w is from the centroid to the old apex, across the axis for the cylinder. No division by kappa.
void apex_over_centroid(Placed& placed, const Ingredients& from, const PatchPlan& plan) {
  const Dual& kappa = from.kappa;
  const Dual3 w = {is_cylinder(plan) ? constant(0.0) : Dual(-from.mean[0]), Dual(-from.mean[1]),
                   Dual(-from.mean[2])};
  const Dual3 towards = {Dual(kappa * w[0]), Dual(kappa * w[1]), Dual(1.0 + kappa * w[2])};  // z + kappa w
  const Dual squared = dot(towards, towards);
  if (squared.value() < 0.01) return;  // points all round: their centroid is at the centre
  const Dual n = sqrt(squared);
  const Dual along = (2.0 * w[2] + kappa * dot(w, w)) / (1.0 + n);
  placed.c = scaled({w[0], w[1], Dual(w[2] - along)}, Dual(-1.0 / n));
  placed.z = scaled(towards, Dual(1.0 / n));
  complete_frame(placed);
}

// Step 2 (ii): z_l from the plane of step 1, the apex moved to c + (z - z')/kappa so that the surface stays
// (errata F2, F3).
void apex_by_plane(Placed& placed, const Ingredients& from, const PatchPlan& plan) {
  const Dual3 normal = difference(from.plane_normal, cross(from.w, from.plane_normal));  // in the moving axes
  const Dual3 z = is_cylinder(plan) ? normalised({constant(0.0), normal[1], normal[2]}) : normal;
  if (from.kappa.value() != 0.0) placed.c = scaled(difference(placed.z, z), Dual(1.0 / from.kappa));
  placed.z = z;
  complete_frame(placed);
}

// The x and y axes of R([r_xy; 0]) for this normal, on which step 7's larger axis depends.
void axes_of_r_xy(Placed& placed, const Ingredients& from) {
  const Dual3 z = turned(from.R, sum(placed.z, cross(from.w, placed.z)));  // world
  const Dual share = z[0] / (1.0 + z[2]);
  const Dual3 x_world = {Dual(1.0 - z[0] * share), Dual(-z[1] * share), Dual(-z[0])};
  const Dual3 x = turned(from.R.transpose(), x_world);
  placed.x = difference(x, cross(from.w, x));
  placed.y = cross(placed.z, placed.x);
}

void turn_about_z(Placed& placed, const Dual& theta) {
  const Dual c = cos(theta), s = sin(theta);
  const Dual3 x = placed.x, y = placed.y;
  placed.x = sum(scaled(x, c), scaled(y, s));
  placed.y = difference(scaled(y, c), scaled(x, s));
}

void bound_rectangle(Placed& placed, const Ingredients& from, const PatchPlan& plan) {  // step 6
  const Dual along = dot(placed.x, difference(from.mean, placed.c));
  placed.c = sum(placed.c, scaled(placed.x, along));
  placed.d = {length(variance(from, placed, placed.x), plan.scale.rectangle),
              length(variance(from, placed, placed.y), plan.scale.rectangle)};
}

void bound_circle(Placed& placed, const Ingredients& from, const PatchPlan& plan) {  // step 7
  if (plan.scale.larger_axis) axes_of_r_xy(placed, from);
  const Dual v_x = variance(from, placed, placed.x), v_y = variance(from, placed, placed.y);
  const Dual larger = v_x.value() > v_y.value() ? v_x : v_y;
  placed.d[0] = length(plan.scale.larger_axis ? larger : Dual(0.5 * (v_x + v_y)), plan.scale.circle);
}

void bound_ellipse(Placed& placed, const Ingredients& from, const PatchPlan& plan) {  // step 8
  placed.d = {length(variance(from, placed, placed.x), plan.scale.ellipse),
              length(variance(from, placed, placed.y), plan.scale.ellipse)};
}

void bound_plane(Placed& placed, const Ingredients& from, const PatchPlan& plan) {  // step 9
  placed.c = {from.mean[0], from.mean[1], constant(0.0)};
  if (plan.direction) {
    turn_about_z(placed, constant(plan.direction->angle));
    placed.d = {length(variance(from, placed, placed.x), plan.scale.plane_rectangle),
                length(variance(from, placed, placed.y), plan.scale.plane_rectangle)};
    return;
  }
  const Dual alpha = variance(from, placed, placed.x), phi = variance(from, placed, placed.y);
  const Dual beta = 2.0 * moment(from, placed.c, placed.x, placed.y);
  const Dual apart = sqrt(Dual(beta * beta + (alpha - phi) * (alpha - phi) + 1e-300));  // Eq. (30)
  const Dual larger = 0.5 * (alpha + phi + apart), smaller = 0.5 * (alpha + phi - apart);
  if (plan.type->boundary == BoundaryType::circle) {
    placed.d[0] =
        length(plan.scale.larger_axis ? larger : Dual(0.5 * (alpha + phi)), plan.scale.plane_circle);
    return;
  }
  const bool ellipse = plan.type->boundary == BoundaryType::ellipse;
  const double factor = ellipse ? plan.scale.plane_ellipse : plan.scale.plane_rectangle;
  placed.d = {length(larger, factor), length(smaller, factor)};
  turn_about_z(placed, Dual(0.5 * atan2(beta, Dual(alpha - phi))));  // Eq. (32)
}

}  // namespace

Placed place(const Ingredients& from, const PatchPlan& plan) {
  Placed placed = as_fitted();
  const SurfaceType surface = plan.type->surface;
  if (surface == SurfaceType::plane) {
    bound_plane(placed, from, plan);
    return placed;
  }
  if (surface == SurfaceType::sphere || is_cylinder(plan)) {
    if (plan.apex == Apex::over_centroid) {
      apex_over_centroid(placed, from, plan);
    } else {
      apex_by_plane(placed, from, plan);
    }
  }
  switch (plan.type->boundary) {
    case BoundaryType::rectangle:
      bound_rectangle(placed, from, plan);
      break;
    case BoundaryType::circle:
      bound_circle(placed, from, plan);
      break;
    case BoundaryType::ellipse:
    case BoundaryType::convex_quad:
      bound_ellipse(placed, from, plan);
      break;
  }
  return placed;
}

}  // namespace patchlab
