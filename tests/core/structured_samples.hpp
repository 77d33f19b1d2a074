// Patterns of every structure, and matrices on them whose entries are small integers, exact in every scalar.
#pragma once

#include <algorithm>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <pfaff/core/linear/structured_ldlt.hpp>
#include <pfaff/core/linear/structured_lu.hpp>

namespace pfaff::testing {

using Couplings = std::vector<SymmetricPattern::Coupling>;

inline Couplings chain(std::size_t rows) {
  Couplings result;
  for (std::size_t k = 0; k + 1 < rows; ++k) result.emplace_back(k, k + 1);
  return result;
}
inline Couplings ring(std::size_t rows) {
  Couplings result = chain(rows);
  result.emplace_back(rows - 1, 0);
  return result;
}
/// Rods that share a vertex are coupled; a rod is a pair of vertices.
inline Couplings of_rods(const Couplings& rods) {
  Couplings result;
  for (std::size_t i = 0; i < rods.size(); ++i)
    for (std::size_t j = i + 1; j < rods.size(); ++j)
      if (rods[i].first == rods[j].first || rods[i].first == rods[j].second ||
          rods[i].second == rods[j].first || rods[i].second == rods[j].second)
        result.emplace_back(i, j);
  return result;
}
/// The twelve rods of a figure with head, trunk, arms and legs.
inline Couplings humanoid() {
  return of_rods(
      {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {1, 5}, {5, 6}, {6, 7}, {1, 8}, {8, 9}, {9, 10}, {8, 11}, {11, 12}});
}
inline Couplings lattice(std::size_t width, std::size_t height) {
  Couplings result;
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      if (x + 1 < width) result.emplace_back(y * width + x, y * width + x + 1);
      if (y + 1 < height) result.emplace_back(y * width + x, (y + 1) * width + x);
    }
  return result;
}
inline Couplings complete(std::size_t rows) {
  Couplings result;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = i + 1; j < rows; ++j) result.emplace_back(i, j);
  return result;
}
/// Every rod but the first hangs on an end of an earlier one, the parents no more than `reach` back.
inline Couplings random_tree_of_rods(std::size_t rods, std::size_t reach, std::mt19937_64& random) {
  // Rod k ends at vertex k + 1 and starts at the end of its parent, so that rods of one start are siblings.
  std::vector<std::vector<std::size_t>> at(rods + 1);
  Couplings result;
  for (std::size_t k = 0; k < rods; ++k) {
    std::size_t vertex = 0;
    do vertex = k - std::min<std::size_t>(k, random() % reach);
    while (at[vertex].size() > 3);
    for (const std::size_t other : at[vertex]) result.emplace_back(other, k);
    at[vertex].push_back(k);
    at[k + 1].push_back(k);
  }
  return result;
}

/// The same graph with rows numbered anew.
inline Couplings shuffled(std::size_t rows, Couplings couplings, std::mt19937_64& random) {
  std::vector<std::size_t> name(rows);
  std::iota(name.begin(), name.end(), std::size_t(0));
  std::shuffle(name.begin(), name.end(), random);
  for (auto& [i, j] : couplings) i = name[i], j = name[j];
  std::shuffle(couplings.begin(), couplings.end(), random);
  return couplings;
}

struct Sample {
  std::string name;
  MatrixStructure structure;
  std::shared_ptr<const SymmetricPattern> pattern;
};

/// All structures, in the given order of rows and in random ones.
inline std::vector<Sample> samples(std::mt19937_64& random) {
  std::vector<Sample> result;
  const auto add = [&](const std::string& name, MatrixStructure structure, std::size_t rows,
                       const Couplings& couplings) {
    result.push_back({name + " " + std::to_string(rows), structure,
                      std::make_shared<const SymmetricPattern>(rows, couplings)});
    result.push_back({"shuffled " + name + " " + std::to_string(rows), structure,
                      std::make_shared<const SymmetricPattern>(rows, shuffled(rows, couplings, random))});
  };
  using enum MatrixStructure;
  add("no couplings", diagonal, 5, {});
  for (const std::size_t rows : {2, 3, 4, 5, 8, 13, 24}) add("chain", tridiagonal, rows, chain(rows));
  add("two chains and a row", tridiagonal, 6, {{0, 1}, {2, 3}, {3, 4}});
  for (const std::size_t rows : {3, 4, 5, 8, 13, 24}) add("ring", cyclic, rows, ring(rows));
  add("star of rods", tree, 7, {{0, 1}, {0, 2}, {1, 2}, {0, 3}, {1, 4}, {2, 5}, {5, 6}});
  add("humanoid", tree, 12, humanoid());
  for (const std::size_t rows : {9, 20})
    add("tree of rods", tree, rows, random_tree_of_rods(rows, 3, random));
  add("two rings", sparse, 9, {{0, 1}, {1, 2}, {2, 3}, {0, 3}, {4, 5}, {5, 6}, {6, 7}, {7, 8}, {4, 8}});
  add("lattice", sparse, 30, lattice(6, 5));
  for (const std::size_t rows : {4, 9}) add("complete", dense, rows, complete(rows));
  Couplings nearly = complete(9);
  nearly.erase(nearly.begin() + 3);
  nearly.erase(nearly.begin() + 30);
  nearly.erase(nearly.begin() + 12);
  add("nearly complete", dense, 9, nearly);
  return result;
}

/// Integers of a matrix on a pattern: a_ii, a_ji and a_ij of the couplings (i, j), i < j.
struct Entries {
  std::vector<int> diagonal, lower, upper;

  static Entries random(const SymmetricPattern& pattern, int smallest_diagonal, std::mt19937_64& random) {
    std::uniform_int_distribution<int> number(-8, 8), more(0, 16);
    Entries e;
    for (std::size_t i = 0; i < pattern.rows(); ++i) e.diagonal.push_back(smallest_diagonal + more(random));
    for (std::size_t c = 0; c < pattern.couplings().size(); ++c) {
      e.lower.push_back(number(random));
      e.upper.push_back(number(random));
    }
    return e;
  }
  /// Symmetric with the entries of `lower`, diagonally dominant, so that it is positive definite.
  static Entries positive(const SymmetricPattern& pattern, std::mt19937_64& random) {
    Entries e = Entries::random(pattern, 1, random);
    e.upper = e.lower;
    for (std::size_t c = 0; c < e.lower.size(); ++c) {
      const auto& [i, j] = pattern.couplings()[c];
      e.diagonal[i] += std::abs(e.lower[c]);
      e.diagonal[j] += std::abs(e.lower[c]);
    }
    return e;
  }

  template <class T>
  void fill(StructuredLDLT<T>& matrix) const {
    for (std::size_t i = 0; i < diagonal.size(); ++i) matrix.diagonal()[i] = T(diagonal[i]);
    for (std::size_t c = 0; c < lower.size(); ++c) matrix.couplings()[c] = T(lower[c]);
  }
  template <class T>
  void fill(StructuredLU<T>& matrix) const {
    for (std::size_t i = 0; i < diagonal.size(); ++i) matrix.diagonal()[i] = T(diagonal[i]);
    for (std::size_t c = 0; c < lower.size(); ++c) {
      matrix.lower()[c] = T(lower[c]);
      matrix.upper()[c] = T(upper[c]);
    }
  }
  /// A x - b.
  template <class T>
  std::vector<T> residual(const SymmetricPattern& pattern, const std::vector<T>& x,
                          const std::vector<T>& b) const {
    std::vector<T> result(b.size());
    for (std::size_t i = 0; i < b.size(); ++i) result[i] = T(diagonal[i]) * x[i] - b[i];
    for (std::size_t c = 0; c < lower.size(); ++c) {
      const auto& [i, j] = pattern.couplings()[c];
      result[j] = result[j] + T(lower[c]) * x[i];
      result[i] = result[i] + T(upper[c]) * x[j];
    }
    return result;
  }
  [[nodiscard]] int largest() const {
    int result = 0;
    for (const auto* side : {&diagonal, &lower, &upper})
      for (const int x : *side) result = std::max(result, std::abs(x));
    return result;
  }
};

template <class T>
std::vector<T> random_integers(std::size_t count, std::mt19937_64& random) {
  std::uniform_int_distribution<int> number(-8, 8);
  std::vector<T> result;
  for (std::size_t i = 0; i < count; ++i) result.push_back(T(number(random)));
  return result;
}

}  // namespace pfaff::testing
