#include <pfaff/core/facets/sparse_tape.hpp>

namespace pfaff {

SparseRows record_sparse(const RecordedMatrix& matrix, std::vector<Recorded>& out) {
  SparseRows result;
  for (std::size_t i = 0; i < matrix.rows; ++i) {
    result.begin.push_back(result.columns.size());
    for (std::size_t j = 0; j < matrix.columns; ++j) {
      const Recorded& x = matrix(i, j);
      if (structurally_zero(x)) continue;
      result.columns.push_back(j);
      out.push_back(x);
    }
  }
  result.begin.push_back(result.columns.size());
  return result;
}

std::shared_ptr<const SymmetricPattern> record_gram(const RecordedMatrix& x, const RecordedMatrix& y,
                                                    const std::vector<Recorded>& weight,
                                                    std::vector<Recorded>& out) {
  std::vector<std::pair<std::size_t, std::size_t>> places;
  std::vector<Recorded> diagonal, couplings;
  for (std::size_t i = 0; i < x.rows; ++i) {
    std::vector<std::size_t> entries;  // of row i, few where there are many rows
    for (std::size_t a = 0; a < x.columns; ++a)
      if (!structurally_zero(x(i, a))) entries.push_back(a);
    for (std::size_t j = i; j < x.rows; ++j) {
      Recorded sum(0);
      for (const std::size_t a : entries) {
        const Recorded& left = x(i, a);
        const Recorded& right = y(j, a);
        if (structurally_zero(right)) continue;
        sum = sum + (weight.empty() ? left * right : left * weight[a] * right);
      }
      if (i == j) {
        diagonal.push_back(sum);
      } else if (!structurally_zero(sum)) {
        places.emplace_back(i, j);
        couplings.push_back(sum);
      }
    }
  }
  append(out, diagonal);
  append(out, couplings);
  return std::make_shared<const SymmetricPattern>(x.rows, std::move(places));
}

}  // namespace pfaff
