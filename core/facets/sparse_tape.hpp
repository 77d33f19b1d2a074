// Matrices on tapes: what is recorded of one are its entries that are not zero by construction, and from
// where they are follows the structure in which it is multiplied and factored.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <pfaff/core/linear/symmetric_pattern.hpp>
#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/recorder.hpp>

namespace pfaff {

/// Where a K x n matrix has entries, row by row: columns[begin[i]] ... columns[begin[i + 1] - 1].
struct SparseRows {
  std::vector<std::size_t> begin, columns;

  [[nodiscard]] std::size_t rows() const { return begin.size() - 1; }

  /// r = X u for the matrix X with these entries.
  template <class T>
  void multiply(const T* entries, In<T> u, Out<T> r) const {
    for (std::size_t i = 0; i < rows(); ++i) {
      T sum(0);
      for (std::size_t e = begin[i]; e < begin[i + 1]; ++e) sum = sum + entries[e] * u[columns[e]];
      r[i] = sum;
    }
  }
  /// f = X^T x.
  template <class T>
  void multiply_transpose(const T* entries, In<T> x, Out<T> f) const {
    for (T& value : f) value = T(0);
    for (std::size_t i = 0; i < rows(); ++i)
      for (std::size_t e = begin[i]; e < begin[i + 1]; ++e) f[columns[e]] = f[columns[e]] + entries[e] * x[i];
  }
};

/// A matrix on a tape, of which only the entries are kept that are not zero by construction.
struct SparseRecorded {
  SparseRows where{{0}, {}};
  std::vector<Recorded> entries;

  void push_back(std::size_t column, const Recorded& x) {
    where.columns.push_back(column);
    entries.push_back(x);
  }
  void end_row() { where.begin.push_back(where.columns.size()); }
};

/// A matrix on a tape, `rows` x `columns`, that stands in the columns from `first` of one with `stride`
/// columns.
struct RecordedMatrix {
  const std::vector<Recorded>& entries;
  std::size_t rows, columns, stride, first;

  [[nodiscard]] const Recorded& operator()(std::size_t i, std::size_t j) const {
    return entries[i * stride + first + j];
  }
  [[nodiscard]] SparseRecorded sparse() const;
};

/// Appends the entries of a matrix that are not zero by construction to `out`, and says where they are.
SparseRows record_sparse(const SparseRecorded& matrix, std::vector<Recorded>& out);
inline SparseRows record_sparse(const RecordedMatrix& matrix, std::vector<Recorded>& out) {
  return record_sparse(matrix.sparse(), out);
}

/// Appends the entries sum_a x_ia weight_a y_ja with j >= i to `out`, the diagonal first and the couplings,
/// those that are not zero by construction, after it. No weights are weights of one. Returns where the
/// couplings are. The time is that of the products that are made, whatever the sizes of the matrices.
std::shared_ptr<const SymmetricPattern> record_gram(const SparseRecorded& x, const SparseRecorded& y,
                                                    const std::vector<Recorded>& weight,
                                                    std::vector<Recorded>& out);
inline std::shared_ptr<const SymmetricPattern> record_gram(const RecordedMatrix& x, const RecordedMatrix& y,
                                                           const std::vector<Recorded>& weight,
                                                           std::vector<Recorded>& out) {
  return record_gram(x.sparse(), y.sparse(), weight, out);
}

/// A tape whose number of outputs is found while it is recorded: formula(t, z, out) appends them.
template <class F>
std::shared_ptr<const Tape> record_list(int inputs, F&& formula) {
  Recorder recorder(inputs);
  const std::vector<Recorded> x = recorder.inputs();
  std::vector<Recorded> out;
  formula(recorder.time(), x, out);
  return std::make_shared<const Tape>(recorder.finish(out));
}

inline void append(std::vector<Recorded>& out, const std::vector<Recorded>& more) {
  out.insert(out.end(), more.begin(), more.end());
}

}  // namespace pfaff
