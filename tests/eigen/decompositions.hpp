// Eigen's decompositions, with which those of this project are compared: compiled once, for they take GCC
// seconds in every source that uses one.
#pragma once

#include <Eigen/Core>

namespace pfaff::testing {

/// The solution X of A X = B for a square A, by elimination with complete pivoting. A right-hand side of one
/// column is a vector.
Eigen::MatrixXd solved_by_eigen(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
/// The same by elimination with partial pivoting.
Eigen::MatrixXd solved_with_partial_pivoting(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
/// The same for a symmetric A, by a sparse factorisation L D L^T.
Eigen::MatrixXd solved_by_simplicial_ldlt(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
/// The shortest x that minimises |A x - b|, where pivots below `threshold` times the largest count as zero.
Eigen::VectorXd shortest_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, double threshold);
/// |A| |A^-1| in the norms of Frobenius.
double condition_of(const Eigen::MatrixXd& a);
/// From the largest on.
Eigen::VectorXd singular_values_by_eigen(const Eigen::MatrixXd& a);

}  // namespace pfaff::testing
