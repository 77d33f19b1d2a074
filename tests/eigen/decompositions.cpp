#include "decompositions.hpp"

#include <Eigen/Dense>
#include <Eigen/Sparse>

namespace pfaff::testing {

Eigen::MatrixXd solved_by_eigen(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.fullPivLu().solve(b);
}
Eigen::MatrixXd solved_with_partial_pivoting(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.partialPivLu().solve(b);
}
Eigen::MatrixXd solved_by_simplicial_ldlt(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(a.sparseView()).solve(b);
}
Eigen::VectorXd shortest_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, double threshold) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
  decomposition.setThreshold(threshold);
  return decomposition.compute(a).solve(b);
}
double condition_of(const Eigen::MatrixXd& a) { return a.norm() * a.inverse().norm(); }
Eigen::VectorXd singular_values_by_eigen(const Eigen::MatrixXd& a) { return a.jacobiSvd().singularValues(); }

}  // namespace pfaff::testing
