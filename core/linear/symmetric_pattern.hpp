// SymmetricPattern: where a symmetric matrix has entries, and in which order it is best eliminated.
//
// The matrices of constrained mechanics, S = B M^-1 B^T, have a row for every constraint and couple two
// constraints that move a common particle. A chain of rods gives a tridiagonal matrix and a closed chain a
// cyclic one. A branching tree of rods gives a clique at every branching point and with it a chordal graph,
// in which elimination from the leaves inwards creates no new entries. The pattern finds out once which of
// these it is. Factorisations on it then run through lists of indices that are known beforehand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace pfaff {

/// What the graph of a symmetric matrix is, in the order of preference.
enum class MatrixStructure {
  diagonal,     // no couplings
  tridiagonal,  // one or more paths, after a permutation
  cyclic,       // one ring of three or more rows: a tridiagonal matrix with a border
  tree,         // chordal: an order without fill exists, such as leaf first for a tree of rods
  sparse,       // anything else, in an order of minimum degree
  dense         // nearly all couplings are there, or appear by elimination
};

constexpr std::string_view to_string(MatrixStructure structure) {
  switch (structure) {
    case MatrixStructure::diagonal:
      return "diagonal";
    case MatrixStructure::tridiagonal:
      return "tridiagonal";
    case MatrixStructure::cyclic:
      return "cyclic";
    case MatrixStructure::tree:
      return "tree";
    case MatrixStructure::sparse:
      return "sparse";
    case MatrixStructure::dense:
      return "dense";
  }
  return "unknown";
}

/// The order of an elimination and its lists of indices. Rows keep their own numbers throughout, so that
/// neither a matrix nor a right-hand side is ever permuted.
struct EliminationPlan {
  using Index = std::uint32_t;
  /// The row that is eliminated k-th; along the path or ring where the structure is one.
  std::vector<Index> order;
  /// True where order[k] = k and, for a tridiagonal matrix, coupling k is that of rows k and k + 1.
  bool natural = true;

  /// Tridiagonal and cyclic: the coupling of order[k] and order[k + 1] (of the last and the first for the
  /// last k of a ring); the number of couplings where there is none, as between two paths.
  std::vector<Index> link;

  /// Tree and sparse: the k-th row's couplings with rows eliminated later are the entries start[k] ..
  /// start[k + 1] - 1, in the order of elimination.
  std::vector<Index> start;
  /// The later row of an entry, and its coupling (the number of couplings for fill).
  std::vector<Index> row, coupling;
  /// The updates, in the order in which they are made: for the k-th row and each two of its entries a > b
  /// (b in the outer loop), the entry that couples the later row of a with the later row of b.
  std::vector<Index> target;
};

/// Where a symmetric matrix with K rows has entries: the diagonal, and couplings (i, j), i < j.
class SymmetricPattern {
 public:
  using Coupling = std::pair<std::size_t, std::size_t>;
  static constexpr std::size_t npos = std::numeric_limits<std::size_t>::max();

  /// Couplings in any order, either way round; duplicates are merged. Throws std::invalid_argument for a
  /// coupling of a row with itself or with one that is not there. O(K + couplings) for all structures but
  /// `sparse`, which takes the time of a symbolic elimination.
  SymmetricPattern(std::size_t rows, std::vector<Coupling> couplings);

  /// The pattern of a path 0 - 1 - ... - (rows - 1).
  static SymmetricPattern path(std::size_t rows);

  [[nodiscard]] std::size_t rows() const { return rows_; }
  /// Sorted, i < j.
  [[nodiscard]] const std::vector<Coupling>& couplings() const { return couplings_; }
  /// The index of the coupling of i and j, either way round; npos where there is none.
  [[nodiscard]] std::size_t coupling(std::size_t i, std::size_t j) const;
  [[nodiscard]] MatrixStructure structure() const { return structure_; }
  [[nodiscard]] const EliminationPlan& plan() const { return plan_; }
  /// Entries of the factor beyond the couplings.
  [[nodiscard]] std::size_t fill() const { return fill_; }

 private:
  std::size_t rows_;
  std::vector<Coupling> couplings_;
  MatrixStructure structure_ = MatrixStructure::diagonal;
  EliminationPlan plan_;
  std::size_t fill_ = 0;
};

}  // namespace pfaff
