// The bracket of a Birkhoffian system: {f, g} = grad f . K^-1 grad g with K_ij = d_i F_j - d_j F_i taken from
// its one-form F by differentiation (su-qin (5), (67)). Skew because K is, and a Poisson bracket because K is
// closed.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

/// K^-1 of a one-form, derived once and replayed with any scalar.
class BirkhoffianBracket {
 public:
  /// `one_form`: n -> n.
  explicit BirkhoffianBracket(const Tape& one_form)
      : sharp_(std::make_shared<const Tape>(
            record(2 * one_form.inputs, one_form.inputs,
                   [&](const Recorded& t, std::span<const Recorded> x, std::span<Recorded> out) {
                     const auto n = static_cast<std::size_t>(one_form.inputs);
                     const auto slope = jacobian(one_form, t, x.first(n));
                     std::vector<Recorded> structure(n * n);
                     for (std::size_t i = 0; i < n; ++i)
                       for (std::size_t j = 0; j < n; ++j)
                         structure[i * n + j] = slope[j * n + i] - slope[i * n + j];
                     const auto vector = solve(structure, x.subspan(n));
                     for (std::size_t k = 0; k < n; ++k) out[k] = vector[k];
                   }))) {}

  /// vector = K^-1(z, t) covector. Makes its own buffers; record it (as a registered bracket does) for
  /// repeated use.
  template <class T>
  void sharp(const T& t, In<T> z, In<T> covector, Out<T> vector) const {
    std::vector<T> x(z.begin(), z.end());
    x.insert(x.end(), covector.begin(), covector.end());
    Replay<T> replay(sharp_);
    replay(t, x.data(), vector.data());
  }

 private:
  std::shared_ptr<const Tape> sharp_;
};

}  // namespace pfaff
