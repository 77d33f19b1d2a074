// Solvers that find the coefficients c of W c = r: sharp_D(alpha) = sharp(alpha) - sum_i X_i c_i
// (nguyen-turski (1.2), (3.5)), for every bilinear bracket.
#pragma once

#include <memory>

#include <pfaff/brackets/dirac/dirac_data.hpp>
#include <pfaff/core/linear/lu.hpp>
#include <pfaff/core/linear/structured_ldlt.hpp>
#include <pfaff/core/linear/structured_lu.hpp>

namespace pfaff {

namespace detail {
/// result = sharp(alpha) - sum_i X_i c_i.
template <class T>
void subtract_sharps(const DiracData<T>& data, In<T> coefficients, Out<T> result) {
  const std::size_t n = data.dimension;
  for (std::size_t a = 0; a < n; ++a) result[a] = data.vector[a];
  if (!data.support_begin.empty()) {
    for (std::size_t i = 0; i < data.count; ++i)
      for (std::size_t e = data.support_begin[i]; e < data.support_begin[i + 1]; ++e) {
        const std::size_t a = data.support[e];
        result[a] = result[a] - data.sharps[i * n + a] * coefficients[i];
      }
    return;
  }
  for (std::size_t i = 0; i < data.count; ++i)
    for (std::size_t a = 0; a < n; ++a) result[a] = result[a] - data.sharps[i * n + a] * coefficients[i];
}
}  // namespace detail

/// W = L U with row pivoting, whatever W is. On the tape, the tape's own solve, which pivots when replayed.
struct DenseDirac {
  static constexpr const char* name = "dense";
  static constexpr bool wants_tensor = false;
  [[nodiscard]] bool applies(const DiracData<double>& /*data*/) const { return true; }

  template <class T>
  struct Work {
    Work(const DenseDirac& /*solver*/, std::size_t /*dimension*/, std::size_t count)
        : lu(count), coefficients(count) {}
    LU<T> lu;
    std::vector<T> coefficients;
  };
  template <class T>
  Status operator()(const DiracData<T>& data, Out<T> result, Work<T>& work) const {
    if constexpr (std::is_same_v<T, Recorded>) {
      work.coefficients = solve(data.gram, data.brackets);
    } else {
      for (std::size_t i = 0; i < data.count; ++i)
        for (std::size_t j = 0; j < data.count; ++j) work.lu(i, j) = data.gram[i * data.count + j];
      if (data.count > 0 && !work.lu.factor()) return Status::singular;
      if (data.count > 0) work.lu.solve(data.brackets.data(), work.coefficients.data());
    }
    detail::subtract_sharps<T>(data, work.coefficients, result);
    return Status::converged;
  }
};

/// (4.1) of nguyen-turski, for constraints in the order phi_1, phi~_1, phi_2, phi~_2, ... with {phi_i, phi_j}
/// = 0: with S_ij = {phi_i, phi~_j} (symmetric) and A_ij = {phi~_i, phi~_j}, the coefficients of phi~ are c~
/// = S^-1 r, those of phi S^-1 (A c~ - r~). S is factored on its own pattern: tridiagonal, tree, cyclic,
/// sparse or dense.
struct HolonomicDirac {
  static constexpr const char* name = "holonomic-blocks";
  static constexpr bool wants_tensor = false;
  std::shared_ptr<const SymmetricPattern> pattern;  // of S, and of A; K / 2 rows

  [[nodiscard]] bool applies(const DiracData<double>& data) const {
    const std::size_t half = data.count / 2;
    if (data.symmetry != Symmetry::skew || data.count % 2 != 0 || data.count == 0) return false;
    for (std::size_t i = 0; i < half; ++i)
      for (std::size_t j = 0; j < half; ++j) {
        const auto w = [&](std::size_t k, std::size_t l) { return data.gram[k * data.count + l]; };
        const double scale = abs(w(2 * i, 2 * i + 1)) + abs(w(2 * j, 2 * j + 1));
        if (!(abs(w(2 * i, 2 * j)) <= 1e-14 * scale)) return false;
        if (!(abs(w(2 * i, 2 * j + 1) - w(2 * j, 2 * i + 1)) <= 1e-13 * scale)) return false;
        if (pattern != nullptr && i < j && pattern->coupling(i, j) == SymmetricPattern::npos &&
            (w(2 * i, 2 * j + 1) != 0 || w(2 * i + 1, 2 * j + 1) != 0))
          return false;
      }
    return pattern == nullptr || pattern->rows() == half;
  }

  template <class T>
  struct Work {
    Work(const HolonomicDirac& solver, std::size_t /*dimension*/, std::size_t count)
        : ldlt(solver.pattern != nullptr ? solver.pattern : dense_pattern(count / 2)),
          first(count / 2),
          second(count / 2),
          coefficients(count) {}
    StructuredLDLT<T> ldlt;
    std::vector<T> first, second, coefficients;
  };
  template <class T>
  Status operator()(const DiracData<T>& data, Out<T> result, Work<T>& work) const {
    const std::size_t half = data.count / 2;
    const auto w = [&](std::size_t k, std::size_t l) -> const T& { return data.gram[k * data.count + l]; };
    const auto& couplings = work.ldlt.pattern().couplings();
    for (std::size_t i = 0; i < half; ++i) work.ldlt.diagonal()[i] = w(2 * i, 2 * i + 1);
    for (std::size_t c = 0; c < couplings.size(); ++c)
      work.ldlt.couplings()[c] = w(2 * couplings[c].first, 2 * couplings[c].second + 1);
    if (work.ldlt.factor() != Status::converged) return Status::singular;
    // Rows of phi: S c~ = r. Rows of phi~: -S c + A c~ = r~.
    for (std::size_t i = 0; i < half; ++i) work.first[i] = data.brackets[2 * i];
    work.ldlt.solve(work.first.data(), work.first.data());
    for (std::size_t i = 0; i < half; ++i) work.second[i] = -data.brackets[2 * i + 1];
    for (const auto& [i, j] : couplings) {  // A is skew, and has entries where S has
      const T& a = w(2 * i + 1, 2 * j + 1);
      work.second[i] = work.second[i] + a * work.first[j];
      work.second[j] = work.second[j] - a * work.first[i];
    }
    work.ldlt.solve(work.second.data(), work.second.data());
    for (std::size_t i = 0; i < half; ++i) {
      work.coefficients[2 * i] = work.second[i];
      work.coefficients[2 * i + 1] = work.first[i];
    }
    detail::subtract_sharps<T>(data, work.coefficients, result);
    return Status::converged;
  }

  /// Every pair coupled.
  static std::shared_ptr<const SymmetricPattern> dense_pattern(std::size_t rows) {
    std::vector<std::pair<std::size_t, std::size_t>> couplings;
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = i + 1; j < rows; ++j) couplings.emplace_back(i, j);
    return std::make_shared<const SymmetricPattern>(rows, std::move(couplings));
  }
};

/// W of a symmetric or general bracket on a pattern: tridiagonal, tree, cyclic or sparse, in O(K) where there
/// is no fill. Without row exchanges.
struct StructuredDirac {
  static constexpr const char* name = "structured";
  static constexpr bool wants_tensor = false;
  std::shared_ptr<const SymmetricPattern> pattern;  // of W; K rows

  [[nodiscard]] bool applies(const DiracData<double>& data) const {
    if (data.symmetry == Symmetry::skew || pattern == nullptr || pattern->rows() != data.count) return false;
    for (std::size_t i = 0; i < data.count; ++i)
      for (std::size_t j = i + 1; j < data.count; ++j)
        if (pattern->coupling(i, j) == SymmetricPattern::npos &&
            (data.gram[i * data.count + j] != 0 || data.gram[j * data.count + i] != 0))
          return false;
    return true;
  }

  template <class T>
  struct Work {
    Work(const StructuredDirac& solver, std::size_t /*dimension*/, std::size_t count)
        : lu(solver.pattern != nullptr ? solver.pattern : HolonomicDirac::dense_pattern(0)),
          coefficients(count) {}
    StructuredLU<T> lu;
    std::vector<T> coefficients;
  };
  template <class T>
  Status operator()(const DiracData<T>& data, Out<T> result, Work<T>& work) const {
    if (data.symmetry == Symmetry::skew || pattern == nullptr || pattern->rows() != data.count)
      return Status::singular;
    const auto& couplings = pattern->couplings();
    for (std::size_t i = 0; i < data.count; ++i) work.lu.diagonal()[i] = data.gram[i * data.count + i];
    for (std::size_t c = 0; c < couplings.size(); ++c) {
      const auto [i, j] = couplings[c];
      work.lu.upper()[c] = data.gram[i * data.count + j];
      work.lu.lower()[c] = data.gram[j * data.count + i];
    }
    if (work.lu.factor() != Status::converged) return Status::singular;
    work.lu.solve(data.brackets.data(), work.coefficients.data());
    detail::subtract_sharps<T>(data, work.coefficients, result);
    return Status::converged;
  }
};

/// W of a skew bracket whose graph is a forest, a path (tridiagonal) among them, in O(K): a leaf i on p has
/// the row w_ip c_p = r_i, which gives c_p; the row of p gives c_i once the rest is known.
struct SkewForestDirac {
  static constexpr const char* name = "skew-forest";
  static constexpr bool wants_tensor = false;
  std::vector<std::pair<std::size_t, std::size_t>> edges;  // where W has entries

  [[nodiscard]] bool applies(const DiracData<double>& data) const {
    if (data.symmetry != Symmetry::skew || data.count % 2 != 0) return false;
    for (std::size_t i = 0; i < data.count; ++i)
      for (std::size_t j = i + 1; j < data.count; ++j)
        if (data.gram[i * data.count + j] != 0 &&
            std::find(edges.begin(), edges.end(), std::pair(i, j)) == edges.end())
          return false;
    return pairs(data.count).size() * 2 == data.count;
  }
  /// Leaves with the constraint each is paired with, in the order of elimination; K / 2 pairs where the
  /// forest has a perfect matching, without which W is singular.
  [[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> pairs(std::size_t count) const {
    std::vector<std::vector<std::size_t>> neighbours(count);
    for (const auto& [i, j] : edges) {
      neighbours[i].push_back(j);
      neighbours[j].push_back(i);
    }
    std::vector<std::pair<std::size_t, std::size_t>> found;
    std::vector<bool> gone(count, false);
    std::vector<std::size_t> degree(count), open;
    for (std::size_t i = 0; i < count; ++i) {
      degree[i] = neighbours[i].size();
      if (degree[i] == 1) open.push_back(i);
    }
    while (!open.empty()) {
      const std::size_t leaf = open.back();
      open.pop_back();
      if (gone[leaf]) continue;
      const auto parent = std::find_if(neighbours[leaf].begin(), neighbours[leaf].end(),
                                       [&](std::size_t k) { return !gone[k]; });
      if (parent == neighbours[leaf].end()) break;
      found.emplace_back(leaf, *parent);
      gone[leaf] = gone[*parent] = true;
      for (const std::size_t k : neighbours[*parent])
        if (!gone[k] && --degree[k] == 1) open.push_back(k);
    }
    return found;
  }

  template <class T>
  struct Work {
    Work(const SkewForestDirac& solver, std::size_t /*dimension*/, std::size_t count)
        : pairs(solver.pairs(count)), neighbours(count), known(count), coefficients(count) {
      for (const auto& [i, j] : solver.edges) {
        neighbours[i].push_back(j);
        neighbours[j].push_back(i);
      }
    }
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    std::vector<std::vector<std::size_t>> neighbours;
    std::vector<char> known;
    std::vector<T> coefficients;
  };
  template <class T>
  Status operator()(const DiracData<T>& data, Out<T> result, Work<T>& work) const {
    if (work.pairs.size() * 2 != data.count) return Status::singular;
    const auto w = [&](std::size_t i, std::size_t j) -> const T& { return data.gram[i * data.count + j]; };
    std::fill(work.known.begin(), work.known.end(), char{0});
    // Solves a row for the one coefficient in it that is not known yet.
    const auto solve_row = [&](std::size_t row, std::size_t unknown) {
      if (!detail::usable_pivot(w(row, unknown))) return false;
      T sum = data.brackets[row];
      for (const std::size_t k : work.neighbours[row])
        if (work.known[k] != 0) sum = sum - w(row, k) * work.coefficients[k];
      work.coefficients[unknown] = sum / w(row, unknown);
      work.known[unknown] = 1;
      return true;
    };
    // The row of a leaf contains its partner and partners of earlier leaves, whose coefficients are known.
    for (const auto& [leaf, parent] : work.pairs)
      if (!solve_row(leaf, parent)) return Status::singular;
    for (std::size_t k = work.pairs.size(); k-- > 0;)
      if (!solve_row(work.pairs[k].second, work.pairs[k].first)) return Status::singular;
    detail::subtract_sharps<T>(data, work.coefficients, result);
    return Status::converged;
  }
};

}  // namespace pfaff
