#include <pfaff/core/facets/taped_parts.hpp>

#include <cstddef>

namespace pfaff {

void record_linear(const SparseRecorded& rows, const SparseRecorded& by_momentum, LinearTapes& tapes,
                   std::vector<Recorded>& out) {
  tapes.rows = record_sparse(rows, out);
  tapes.by_momentum = record_sparse(by_momentum, out);
  tapes.pattern = record_gram(rows, by_momentum, {}, out);
}

std::vector<Recorded> flow_of(const Tape& gradient, const Recorded& t, const std::vector<Recorded>& z) {
  const std::vector<Recorded> slopes = evaluate(gradient, t, z);
  const std::size_t n = slopes.size() / 2;
  std::vector<Recorded> flow(slopes.begin() + static_cast<std::ptrdiff_t>(n), slopes.end());
  for (std::size_t k = 0; k < n; ++k) flow.push_back(-slopes[k]);
  return flow;
}

}  // namespace pfaff
