#include "engine/fit/edge_quad.h"

#include <array>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/AutoDiff>

#include "engine/fit/edge_lines.h"

namespace patchlab {
namespace {

using EdgeDual = Eigen::AutoDiffScalar<EdgeVector>;

double wrapped(double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); }

}  // namespace

EdgeVector moved_out(const EdgeVector& edges, double by) {
  EdgeVector moved = edges;
  for (int e = 0; e < 4; ++e) moved[2 * e + 1] += by;
  return moved;
}

EdgeQuad quad_of_edges(const EdgeVector& edges) {
  using std::acos;
  using std::atan2;
  using std::sqrt;
  Edges<EdgeDual> dual;
  for (int i = 0; i < 8; ++i) dual[i] = EdgeDual(edges[i], 8, i);
  std::array<Vector2<EdgeDual>, 4> v;
  for (int i = 0; i < 4; ++i) v[static_cast<std::size_t>(i)] = corner<EdgeDual>(dual, i, (i + 1) % 4);
  const Vector2<EdgeDual> a = v[2] - v[0], b = v[3] - v[1], across = v[1] - v[0];
  const EdgeDual denominator = a[0] * b[1] - a[1] * b[0];
  const EdgeDual share =
      (across[0] * b[1] - across[1] * b[0]) / denominator;  // the diagonals meet at v_1 + share a
  const Vector2<EdgeDual> centre = {EdgeDual(v[0][0] + share * a[0]), EdgeDual(v[0][1] + share * a[1])};
  EdgeQuad quad;
  const auto put = [&](int row, const EdgeDual& value) {
    quad.J_quad_edges.row(row) = value.derivatives().transpose();
    return value.value();
  };
  std::array<EdgeDual, 4> angle;
  for (int i = 0; i < 4; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const EdgeDual x = v[at][0] - centre[0], y = v[at][1] - centre[1];
    quad.d[i] = put(i, EdgeDual(sqrt(EdgeDual(x * x + y * y))));
    angle[at] = atan2(y, x);
  }
  const double offset = wrapped(angle[0].value() - angle[3].value()) - (angle[0].value() - angle[3].value());
  quad.d[4] = put(4, EdgeDual(0.5 * (angle[0] - angle[3] + offset)));  // gamma, Eq. (21)
  quad.turn = put(5, EdgeDual(angle[0] - 0.5 * (angle[0] - angle[3] + offset)));
  quad.centre = {put(6, centre[0]), put(7, centre[1])};
  return quad;
}

}  // namespace patchlab
