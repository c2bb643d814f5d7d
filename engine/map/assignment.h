// One-to-one assignment of least total cost (the Hungarian method with potentials, O(n^3)).
#pragma once

#include <Eigen/Core>
#include <vector>

namespace patchlab {

// For each row of `cost` its column, or -1: a row may stay alone at cost `alone`, and so may every column at
// none. Infinite entries are never chosen.
std::vector<int> assign(const Eigen::MatrixXd& cost, double alone);

}  // namespace patchlab
