#include "engine/region/cell_camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/region/projector.h"

namespace patchlab {
namespace {

struct CellForms {
  Eigen::Matrix<double, 3, 4> view;
  Eigen::RowVector4d column, row, depth, one;  // of (q, 1); one: w
  Eigen::Vector2d shift;                       // cells
  double scale;                                // cells at unit depth, or a metre
};

// Bounds the error of column.q and row.q in cells times w and of depth.q in metre, by far: that of a point of
// the grid by offset + slope |depth|.
struct Rounding {
  double offset, slope;
};

// Each form sums four products: 6 roundings of 2^-24 of the sum of their sizes bound its error. A column is
// at most `side`, so the error of its division is that of column.q plus side times that of w. Twice all that
// is allowed for: a_metre |q| + offset. And |q| is the distance of the view from the origin and that of the
// point from the view, which its place in the grid bounds, where rounding put it there too.
Rounding rounding_of(const CellForms& forms, bool perspective, const PolygonMask::Grid& grid) {
  constexpr double allowed = 16.0 / (1 << 24);
  const auto size = [](const Eigen::RowVector4d& form) { return form.head<3>().norm(); };
  const Eigen::Vector2d cells(static_cast<double>(grid.columns), static_cast<double>(grid.rows));
  const double side = cells.maxCoeff();
  const double a_metre =
      allowed * (std::max(size(forms.column), size(forms.row)) + side * size(forms.one) + size(forms.depth));
  const double offset = allowed * (std::max(std::abs(forms.column[3]), std::abs(forms.row[3])) +
                                   side * std::abs(forms.one[3]) + std::abs(forms.depth[3]));
  const double spread =
      forms.shift.cwiseAbs().cwiseMax((cells - forms.shift).cwiseAbs()).norm() / forms.scale;
  const double metres =
      (2.0 + forms.shift.lpNorm<1>()) / forms.scale;  // that an error of one moves the point
  const double slope = a_metre * (perspective ? std::hypot(1.0, spread) : 1.0);
  if (!(metres * a_metre < 0.25 && slope < 0.25 * PolygonMask::margin))
    return {std::numeric_limits<double>::infinity(), 0.0};
  const double distance = forms.view.col(3).norm() + (perspective ? 0.0 : spread) + metres * offset;
  return {a_metre * distance + offset, slope};
}

struct Depths {
  double seen_from, seen_to, sure_from, sure_to;  // as CellCamera has them
};

// With twice the rounding, since the depth itself is a rounded one.
Depths sure_depths(const ViewCamera& camera, const Rounding& rounding) {
  constexpr double least = 1e-30, most = 1e30;  // far from what float32 holds
  const double e0 = 2.0 * rounding.offset, e1 = 2.0 * rounding.slope;
  const double near = camera.near_plane, far = std::min(camera.far_plane, std::numeric_limits<double>::max());
  const auto rounding_at = [&](double depth) { return (e0 + e1 * std::abs(depth)) / (1.0 - e1); };
  double limit = most;  // where it is a cell's margin
  if (!camera.perspective) limit = std::min(limit, (PolygonMask::margin - e0) / e1);
  const double nearest = camera.perspective ? std::max(least, e0 / (PolygonMask::margin - e1)) : -limit;
  return {near - rounding_at(near), camera.far_plane + rounding_at(far),
          std::max(near + rounding_at(near), nearest), std::min(far - rounding_at(far), limit)};
}

}  // namespace

CellCamera cell_camera(const ViewCamera& camera, const Eigen::Vector3d& origin,
                       const PolygonMask::Grid& grid) {
  const Projector projector(camera);
  CellForms forms;
  forms.view = projector.view_from(origin);
  forms.shift = grid.cells_a_pixel * (projector.centre() - grid.low);
  forms.scale = grid.cells_a_pixel * projector.pixels();
  forms.depth = forms.view.row(2);
  forms.one = camera.perspective ? forms.depth : Eigen::RowVector4d(0, 0, 0, 1);
  forms.column = forms.scale * forms.view.row(0) + forms.shift.x() * forms.one;
  forms.row = forms.scale * forms.view.row(1) + forms.shift.y() * forms.one;
  const auto narrow = [](const Eigen::RowVector4d& v) {
    const Eigen::RowVector4f f = v.cast<float>();
    return std::array<float, 4>{f[0], f[1], f[2], f[3]};
  };
  const Depths depths = sure_depths(camera, rounding_of(forms, camera.perspective, grid));
  return {narrow(forms.column),
          narrow(forms.row),
          narrow(forms.depth),
          static_cast<float>(depths.seen_from),
          static_cast<float>(depths.seen_to),
          static_cast<float>(depths.sure_from),
          static_cast<float>(depths.sure_to),
          camera.perspective};
}

}  // namespace patchlab
