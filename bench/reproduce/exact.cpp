#include <pfaff/bench/reproduce/exact.hpp>

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
ExactMatrix dirac_tensor(const ExactMatrix& p, const ExactMatrix& a) {
  return p - p * a.transposed() * inverse(a * p * a.transposed()) * a * p;
}
ExactMatrix dirac_brackets(const ExactMatrix& g, std::size_t count) {
  const std::size_t rest = g.rows() - count;
  return g.block(count, count, rest, rest) - g.block(count, 0, rest, count) *
                                                 inverse(g.block(0, 0, count, count)) *
                                                 g.block(0, count, count, rest);
}
Rational minor_of(const ExactMatrix& f, const std::vector<std::size_t>& rows,
                  const std::vector<std::size_t>& columns) {
  ExactMatrix m(rows.size(), columns.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < columns.size(); ++j) m(i, j) = f(rows[i], columns[j]);
  return determinant(m);
}
std::vector<std::size_t> counted(std::size_t n, std::initializer_list<std::size_t> more) {
  std::vector<std::size_t> list;
  for (std::size_t k = 0; k < n; ++k) list.push_back(k);
  list.insert(list.end(), more);
  return list;
}

}  // namespace pfaff
