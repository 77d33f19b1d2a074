#include <pfaff/core/facets/taped_parts.hpp>

#include <cstddef>

namespace pfaff {

namespace {
using Numbers = std::vector<Recorded>;
}  // namespace

void record_linear(const Numbers& rows, const Numbers& slopes_of_psi, LinearTapes& tapes, Numbers& out) {
  const std::size_t count = tapes.count, n = tapes.degrees;
  const RecordedMatrix matrix{rows, count, n, n, 0}, by_momentum{slopes_of_psi, count, n, 2 * n, n};
  tapes.rows = record_sparse(matrix, out);
  tapes.by_momentum = record_sparse(by_momentum, out);
  tapes.pattern = record_gram(matrix, by_momentum, {}, out);
}

Numbers flow_of(const Tape& gradient, const Recorded& t, const Numbers& z) {
  const Numbers slopes = evaluate(gradient, t, z);
  const std::size_t n = z.size() / 2;
  Numbers flow(slopes.begin() + static_cast<std::ptrdiff_t>(n), slopes.end());
  for (std::size_t k = 0; k < n; ++k) flow.push_back(-slopes[k]);
  return flow;
}

}  // namespace pfaff
