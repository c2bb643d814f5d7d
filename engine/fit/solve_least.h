// Normal equations that may leave some direction open.
#pragma once

#include <Eigen/Core>

namespace patchlab {

// The least x with A x = b. Precondition: A symmetric and positive semidefinite, b in its range.
Eigen::VectorXd solve_least(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

}  // namespace patchlab
