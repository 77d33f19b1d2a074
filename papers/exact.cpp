#include <pfaff/papers/exact.hpp>

namespace pfaff {

ExactMatrix kernel_columns(const ExactMatrix& a) {
  const std::size_t n = a.columns(), k = a.rows();
  const ExactMatrix lead = inverse(a.block(0, 0, k, k)) * a.block(0, k, k, n - k);
  ExactMatrix basis(n, n - k);
  for (std::size_t j = 0; j < n - k; ++j) {
    for (std::size_t i = 0; i < k; ++i) basis(i, j) = -lead(i, j);
    basis(k + j, j) = 1;
  }
  return basis;
}

}  // namespace pfaff
