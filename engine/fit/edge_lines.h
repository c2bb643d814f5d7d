// Where the lines of a quadrilateral meet, and its area: of doubles, or of numbers that carry derivatives.
#pragma once

#include <cmath>

#include "engine/fit/edge_quad.h"

namespace patchlab {

template <class T>
using Vector2 = Eigen::Matrix<T, 2, 1>;
template <class T>
using Edges = Eigen::Matrix<T, 8, 1>;

// Tangential coordinate, along edge a, of its meeting with edge b.
template <class T>
T meeting(const Edges<T>& edges, int a, int b) {
  using std::cos;
  using std::sin;
  const T turn = edges[2 * b] - edges[2 * a];
  return (edges[2 * b + 1] - edges[2 * a + 1] * cos(turn)) / sin(turn);
}

template <class T>
Vector2<T> corner(const Edges<T>& edges, int a, int b) {
  using std::cos;
  using std::sin;
  const T s = meeting<T>(edges, a, b), c = cos(edges[2 * a]), n = sin(edges[2 * a]), rho = edges[2 * a + 1];
  return {T(rho * c - s * n), T(rho * n + s * c)};
}

// Area and its gradient: an edge of length L moved out by d rho sweeps L d rho; turned by d phi it sweeps
// -(s_2^2 - s_1^2)/2 d phi.
template <class T>
struct Area {
  T value = T(0.0);
  Edges<T> gradient;
};
template <class T>
Area<T> area_of(const Edges<T>& edges) {
  Area<T> area;
  for (int e = 0; e < 4; ++e) {
    const T s_1 = meeting<T>(edges, e, (e + 3) % 4), s_2 = meeting<T>(edges, e, (e + 1) % 4);
    area.gradient[2 * e] = T(0.5) * (s_1 * s_1 - s_2 * s_2);
    area.gradient[2 * e + 1] = s_2 - s_1;
    area.value += T(0.5) * edges[2 * e + 1] * (s_2 - s_1);
  }
  return area;
}

}  // namespace patchlab
