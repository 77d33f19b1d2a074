#include <pfaff/core/facets/sparse_tape.hpp>

#include <algorithm>

namespace pfaff {

SparseRecorded RecordedMatrix::sparse() const {
  SparseRecorded result;
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < columns; ++j)
      if (!structurally_zero((*this)(i, j))) result.push_back(j, (*this)(i, j));
    result.end_row();
  }
  return result;
}

SparseRows record_sparse(const SparseRecorded& matrix, std::vector<Recorded>& out) {
  append(out, matrix.entries);
  return matrix.where;
}

namespace {
/// One entry of a column: its row and its place among the entries of the matrix.
struct ColumnEntry {
  std::size_t row, entry;
};
std::vector<std::vector<ColumnEntry>> columns_of(const SparseRows& rows) {
  std::vector<std::vector<ColumnEntry>> columns;
  for (std::size_t i = 0; i < rows.rows(); ++i)
    for (std::size_t e = rows.begin[i]; e < rows.begin[i + 1]; ++e) {
      if (rows.columns[e] >= columns.size()) columns.resize(rows.columns[e] + 1);
      columns[rows.columns[e]].push_back({i, e});
    }
  return columns;
}
}  // namespace

std::shared_ptr<const SymmetricPattern> record_gram(const SparseRecorded& x, const SparseRecorded& y,
                                                    const std::vector<Recorded>& weight,
                                                    std::vector<Recorded>& out) {
  const std::size_t rows = x.where.rows();
  const auto columns = columns_of(y.where);
  std::vector<std::pair<std::size_t, std::size_t>> places;
  std::vector<Recorded> diagonal(rows), couplings, sums(rows);
  std::vector<std::size_t> met;  // the rows j >= i that have an entry in a column of row i
  std::vector<char> is_met(rows, 0);
  for (std::size_t i = 0; i < rows; ++i) {
    met.clear();
    for (std::size_t e = x.where.begin[i]; e < x.where.begin[i + 1]; ++e) {
      const std::size_t a = x.where.columns[e];
      if (a >= columns.size()) continue;
      const Recorded left = weight.empty() ? x.entries[e] : x.entries[e] * weight[a];
      for (const ColumnEntry& other : columns[a]) {
        if (other.row < i) continue;
        if (is_met[other.row] == 0) met.push_back(other.row);
        is_met[other.row] = 1;
        sums[other.row] = sums[other.row] + left * y.entries[other.entry];
      }
    }
    std::sort(met.begin(), met.end());
    for (const std::size_t j : met) {
      if (i == j) {
        diagonal[i] = sums[j];
      } else if (!structurally_zero(sums[j])) {
        places.emplace_back(i, j);
        couplings.push_back(sums[j]);
      }
      sums[j] = Recorded();
      is_met[j] = 0;
    }
  }
  append(out, diagonal);
  append(out, couplings);
  return std::make_shared<const SymmetricPattern>(rows, std::move(places));
}

}  // namespace pfaff
