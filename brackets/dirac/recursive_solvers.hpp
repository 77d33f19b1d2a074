// The recursion of Theorems 1 and 2 of nguyen-turski, in three forms: each step makes a new bracket of which
// one constraint (3.8), or a pair (3.15), is a Casimir.
//
// The order of elimination is the one given, which works where no pivot vanishes, or one that a
// classification found good at a point (`order`). Forms differ in what they carry from step to step: the
// tensor, the vectors X_j and sharp(alpha), or nothing but the definition.
#pragma once

#include <unordered_map>

#include <pfaff/brackets/dirac/dirac_data.hpp>

namespace pfaff {

namespace detail {
inline EliminationOrder order_or_plain(const EliminationOrder& order, std::size_t count, Symmetry symmetry) {
  return order.empty() ? plain_order(count, symmetry) : order;
}
template <class T>
T dot(std::size_t n, const T* a, const T* b) {
  T sum(0);
  for (std::size_t k = 0; k < n; ++k) sum = sum + a[k] * b[k];
  return sum;
}
}  // namespace detail

/// Carries the vectors X_j of the constraints that are left and sharp(alpha): O(n K^2).
struct RecursiveVectorsDirac {
  static constexpr const char* name = "recursive-vectors";
  static constexpr bool wants_tensor = false;
  EliminationOrder order;
  [[nodiscard]] bool applies(const DiracData<double>& /*data*/) const { return true; }

  template <class T>
  struct Work {
    Work(const RecursiveVectorsDirac& solver, std::size_t dimension, std::size_t count)
        : order(solver.order), count_made_for(count), sharps(dimension * count) {}
    EliminationOrder order;
    std::size_t count_made_for;
    std::vector<T> sharps;
  };
  template <class T>
  Status operator()(const DiracData<T>& data, Out<T> result, Work<T>& work) const {
    const std::size_t n = data.dimension;
    if (work.order.empty() && data.count > 0) work.order = plain_order(data.count, data.symmetry);
    std::copy(data.sharps.begin(), data.sharps.end(), work.sharps.begin());
    std::copy(data.vector.begin(), data.vector.end(), result.begin());
    for (std::size_t s = 0; s < work.order.size(); ++s) {
      const EliminationStep& step = work.order[s];
      const auto gradient = [&](std::size_t i) { return data.gradients.data() + i * n; };
      const auto sharp = [&](std::size_t j) { return work.sharps.data() + j * n; };
      const auto entry = [&](std::size_t i, std::size_t j) {
        return detail::dot<T>(n, gradient(i), sharp(j));
      };
      // vector -= X_columns G[rows, columns]^-1 G[rows, vector]
      const auto reduce = [&](T* vector) {
        detail::StepCoefficients<T> x;
        const auto right = [&](std::size_t i) { return detail::dot<T>(n, gradient(i), vector); };
        if (!detail::solve_step<T>(step, data.symmetry, entry, right, x)) return false;
        const T* first = sharp(step.columns[0]);
        for (std::size_t a = 0; a < n; ++a) vector[a] = vector[a] - first[a] * x.first;
        if (step.columns.size() == 2) {
          const T* second = sharp(step.columns[1]);
          for (std::size_t a = 0; a < n; ++a) vector[a] = vector[a] - second[a] * x.second;
        }
        return true;
      };
      if (!reduce(result.data())) return Status::singular;
      for (std::size_t later = s + 1; later < work.order.size(); ++later)
        for (const std::size_t j : work.order[later].columns)
          if (!reduce(sharp(j))) return Status::singular;
    }
    return Status::converged;
  }
};

/// Carries the whole tensor, n x n: O(K n^2). The tensor left at the end is that of the Dirac bracket.
struct RecursiveTensorDirac {
  static constexpr const char* name = "recursive-bivector";
  static constexpr bool wants_tensor = true;
  EliminationOrder order;
  [[nodiscard]] bool applies(const DiracData<double>& /*data*/) const { return true; }

  template <class T>
  struct Work {
    Work(const RecursiveTensorDirac& solver, std::size_t dimension, std::size_t /*count*/)
        : order(solver.order),
          tensor(dimension * dimension),
          right(2 * dimension),
          left(2 * dimension),
          scaled(2 * dimension) {}
    EliminationOrder order;
    std::vector<T> tensor, right, left, scaled;
  };
  template <class T>
  Status operator()(const DiracData<T>& data, Out<T> result, Work<T>& work) const {
    const std::size_t n = data.dimension;
    if (work.order.empty() && data.count > 0) work.order = plain_order(data.count, data.symmetry);
    std::copy(data.tensor.begin(), data.tensor.end(), work.tensor.begin());
    for (const EliminationStep& step : work.order) {
      const auto gradient = [&](std::size_t i) { return data.gradients.data() + i * n; };
      const std::size_t width = step.rows.size();
      // right_k = Pi dphi_column, left_k = Pi^T dphi_row
      for (std::size_t k = 0; k < width; ++k)
        for (std::size_t a = 0; a < n; ++a) {
          T column(0), row(0);
          for (std::size_t b = 0; b < n; ++b) {
            column = column + work.tensor[a * n + b] * gradient(step.columns[k])[b];
            row = row + work.tensor[b * n + a] * gradient(step.rows[k])[b];
          }
          work.right[k * n + a] = column;
          work.left[k * n + a] = row;
        }
      const auto entry = [&](std::size_t i, std::size_t j) {
        const std::size_t k = j == step.columns[0] ? 0 : 1;
        return detail::dot<T>(n, gradient(i), work.right.data() + k * n);
      };
      for (std::size_t b = 0; b < n; ++b) {
        detail::StepCoefficients<T> x;
        const auto right = [&](std::size_t i) { return work.left[(i == step.rows[0] ? 0 : n) + b]; };
        if (!detail::solve_step<T>(step, data.symmetry, entry, right, x)) return Status::singular;
        work.scaled[b] = x.first;
        work.scaled[n + b] = x.second;
      }
      for (std::size_t a = 0; a < n; ++a)
        for (std::size_t b = 0; b < n; ++b)
          for (std::size_t k = 0; k < width; ++k)
            work.tensor[a * n + b] = work.tensor[a * n + b] - work.right[k * n + a] * work.scaled[k * n + b];
    }
    for (std::size_t a = 0; a < n; ++a)
      result[a] = detail::dot<T>(n, work.tensor.data() + a * n, data.covector.data());
    return Status::converged;
  }
};

/// The definition, word for word: {f, g}^(k) from brackets of level k - 1, each computed once. A reference,
/// and what a symbolic program does; it allocates.
struct RecursiveLiteralDirac {
  static constexpr const char* name = "recursive-literal";
  static constexpr bool wants_tensor = false;
  EliminationOrder order;
  [[nodiscard]] bool applies(const DiracData<double>& /*data*/) const { return true; }

  template <class T>
  struct Work {
    Work(const RecursiveLiteralDirac& /*solver*/, std::size_t /*dimension*/, std::size_t /*count*/) {}
    // Elements: constraints 0 .. K - 1, coordinates K .. K + n - 1 on the left, alpha K on the right.
    std::unordered_map<std::size_t, T> known;
  };
  template <class T>
  Status operator()(const DiracData<T>& data, Out<T> result, Work<T>& work) const {
    work.known.clear();
    const Levels<T> levels{data, detail::order_or_plain(order, data.count, data.symmetry), work.known};
    bool works = true;
    for (std::size_t a = 0; a < data.dimension; ++a)
      result[a] = levels.bracket(levels.steps.size(), data.count + a, data.count, works);
    return works ? Status::converged : Status::singular;
  }

 private:
  template <class T>
  struct Levels {
    const DiracData<T>& data;
    EliminationOrder steps;
    std::unordered_map<std::size_t, T>& known;

    T bracket(std::size_t level, std::size_t left, std::size_t right, bool& works) const {
      const std::size_t count = data.count, n = data.dimension;
      if (level == 0) {
        if (left < count) return right < count ? data.gram[left * count + right] : data.brackets[left];
        return right < count ? data.sharps[right * n + left - count] : data.vector[left - count];
      }
      const std::size_t key = (level * (count + n) + left) * (count + 1) + right;
      if (const auto found = known.find(key); found != known.end()) return found->second;
      const EliminationStep& step = steps[level - 1];
      const auto before = [&](std::size_t i, std::size_t j) { return bracket(level - 1, i, j, works); };
      detail::StepCoefficients<T> x;
      T value = before(left, right);
      if (detail::solve_step<T>(
              step, data.symmetry, before, [&](std::size_t i) { return before(i, right); }, x)) {
        value = value - before(left, step.columns[0]) * x.first;
        if (step.columns.size() == 2) value = value - before(left, step.columns[1]) * x.second;
      } else {
        works = false;
      }
      known.emplace(key, value);
      return value;
    }
  };
};

}  // namespace pfaff
