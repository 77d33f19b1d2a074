// Self-adjointness of equations K zdot + D = 0: whether they have an action form (su-qin (8)).
#pragma once

#include <algorithm>
#include <initializer_list>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <pfaff/core/linear/vector.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

/// The largest residual of a condition's components, and the largest sum of absolute values of the terms of
/// one: residual / scale is of the order of round-off where the condition holds. Both are 0 where every term
/// is 0, as for a constant K, and NaN where a term is NaN.
template <class T>
struct Residual {
  T residual{0}, scale{0};

  void add(std::initializer_list<T> terms) {
    T sum(0), size(0);
    for (const T& term : terms) {
      sum = sum + term;
      size = size + abs(term);
    }
    residual = isnan(sum) || isnan(residual) ? sum + residual : std::max(residual, T(abs(sum)));
    scale = isnan(size) || isnan(scale) ? size + scale : std::max(scale, size);
  }
};

/// The conditions of self-adjointness at one point.
template <class T>
struct SelfAdjointness {
  Residual<T> skew;    // K_ij + K_ji
  Residual<T> closed;  // d_i K_jk + d_j K_ki + d_k K_ij
  Residual<T> time;    // d_t K_ij - d_j D_i + d_i D_j
};

/// Measures them for `structure` K: n -> n x n (row-major) and `covector` D: n -> n, by derivatives of the
/// tapes. Differentiates anew at every call.
template <class T>
SelfAdjointness<T> self_adjointness(const std::shared_ptr<const Tape>& structure, const Tape& covector,
                                    const T& t, In<T> z) {
  const std::size_t n = z.size();
  const int size = structure->inputs;
  const auto values = [&](std::shared_ptr<const Tape> tape) {
    std::vector<T> out(tape->outputs.size());
    Replay<T>(std::move(tape))(t, z.data(), out.data());
    return out;
  };
  const auto k = values(structure);
  const auto slope = values(std::make_shared<const Tape>(jacobian_tape(*structure)));  // [(i n + j) n + l]
  const auto d = values(std::make_shared<const Tape>(jacobian_tape(covector)));        // [i n + j]
  const auto rate = values(std::make_shared<const Tape>(
      record(size, size * size, [&](const Recorded& s, std::span<const Recorded> x, std::span<Recorded> out) {
        const auto timed = time_derivative(*structure, s, x);
        std::copy(timed.begin(), timed.end(), out.begin());
      })));
  SelfAdjointness<T> result;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      result.skew.add({k[i * n + j], k[j * n + i]});
      result.time.add({rate[i * n + j], -d[i * n + j], d[j * n + i]});
      for (std::size_t l = 0; l < n; ++l)
        result.closed.add(
            {slope[(j * n + l) * n + i], slope[(l * n + i) * n + j], slope[(i * n + j) * n + l]});
    }
  return result;
}

}  // namespace pfaff
