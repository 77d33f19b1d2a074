// Transformations alpha over any chart, linear and not, right and wrong, and their inverses.
#pragma once

#include <array>

#include <pfaff/core/numbers/functions.hpp>

#include "bent.hpp"

namespace pfaff::testing {

/// What alpha is. All but the last two satisfy (34) with factor 1.
enum class AlphaKind {
  standard,  // w^ = J (y' - y), w = (y' + y)/2
  mixed,     // and then w -> w + grad g(w^), g = w^_1^3/6 + sin(w^_2), odd: w stays even under exchange
  sheared,   // and then w^ -> w^ + grad s(w), s = w_1^2 w_2 + sin(w_1): w^ does not vanish on the diagonal
  negative,  // the standard one with the sign of w^ changed
  weighted   // the standard one with w_1 at a third of the way
};

/// The system of bent.hpp with an alpha in its own coordinates.
struct BentWithAlpha : Bent {
  AlphaKind kind = AlphaKind::standard;
  template <class T>
  void alpha(const T& t, const T& t0, In<T> new_z, In<T> old_z, Out<T> w_hat, Out<T> w) const {
    const T new_p = momentum<T>(t, new_z), old_p = momentum<T>(t0, old_z);
    w_hat[0] = new_p - old_p;
    w_hat[1] = old_z[0] - new_z[0];
    w[0] = (new_z[0] + old_z[0]) / 2;
    w[1] = (new_p + old_p) / 2;
    if (kind == AlphaKind::mixed) {
      w[0] = w[0] + w_hat[0] * w_hat[0] / 2;
      w[1] = w[1] + cos(w_hat[1]);
    } else if (kind == AlphaKind::sheared) {
      w_hat[0] = w_hat[0] + 2 * w[0] * w[1] + cos(w[0]);
      w_hat[1] = w_hat[1] + w[0] * w[0];
    } else if (kind == AlphaKind::negative) {
      w_hat[0] = -w_hat[0];
      w_hat[1] = -w_hat[1];
    } else if (kind == AlphaKind::weighted) {
      w[0] = (2 * new_z[0] + old_z[0]) / 3;
    }
  }
  /// (w^, w) -> (z', z) of the standard and the mixed kind.
  template <class T>
  void alpha_inverse(const T& t, const T& t0, In<T> w_hat, In<T> w, Out<T> new_z, Out<T> old_z) const {
    const bool mixes = kind == AlphaKind::mixed;
    const T q = mixes ? w[0] - w_hat[0] * w_hat[0] / 2 : w[0], p = mixes ? w[1] - cos(w_hat[1]) : w[1];
    const std::array<T, 2> after{q - w_hat[1] / 2, p + w_hat[0] / 2},
        before{q + w_hat[1] / 2, p - w_hat[0] / 2};
    chart_inverse<T>(t, after, new_z);
    chart_inverse<T>(t0, before, old_z);
  }
};

inline std::shared_ptr<const Model> bent_with(AlphaKind kind) {
  BentWithAlpha system;
  system.kind = kind;
  return make_model({.name = "bent", .title = "", .reference = "", .initial = {1, 0.5_r}}, system);
}

/// Two degrees of freedom, F = (P, 0) with P = e^{t/4} (p_1 (1 + q_2^2), p_2 + q_1^2 p_1): K depends on state
/// and time. No chart; alpha is the standard one of (q, P) and then w -> w + grad g(w^) with the odd
/// g = w^_1^2 w^_4/2 + w^_2 w^_3 w^_4.
struct Coupled {
  static constexpr int dimension = 4;
  template <class T>
  std::array<T, 2> momenta(const T& t, In<T> z) const {
    const T growth = exp(t / 4);
    return {growth * z[2] * (1 + z[1] * z[1]), growth * (z[3] + z[0] * z[0] * z[2])};
  }
  template <class T>
  T birkhoffian(const T& t, In<T> z) const {
    const auto p = momenta<T>(t, z);
    return (p[0] * p[0] + p[1] * p[1] + z[1] * z[1]) / 2 + z[0] * z[0] * z[0] * z[0] / 4 - cos(z[0] * z[1]) +
           z[0] * sin(t);
  }
  template <class T>
  void one_form(const T& t, In<T> z, Out<T> form) const {
    const auto p = momenta<T>(t, z);
    form[0] = p[0];
    form[1] = p[1];
  }
  template <class T>
  void alpha(const T& t, const T& t0, In<T> new_z, In<T> old_z, Out<T> w_hat, Out<T> w) const {
    const auto after = momenta<T>(t, new_z), before = momenta<T>(t0, old_z);
    for (std::size_t k = 0; k < 2; ++k) {
      w_hat[k] = after[k] - before[k];
      w_hat[2 + k] = old_z[k] - new_z[k];
      w[k] = (new_z[k] + old_z[k]) / 2;
      w[2 + k] = (after[k] + before[k]) / 2;
    }
    w[0] = w[0] + w_hat[0] * w_hat[3];
    w[1] = w[1] + w_hat[2] * w_hat[3];
    w[2] = w[2] + w_hat[1] * w_hat[3];
    w[3] = w[3] + w_hat[0] * w_hat[0] / 2 + w_hat[1] * w_hat[2];
  }
};

inline std::shared_ptr<const Model> coupled() {
  return make_model(
      {.name = "coupled", .title = "", .reference = "", .initial = {0.5_r, 0.3_r, 0.4_r, -0.2_r}}, Coupled{});
}

}  // namespace pfaff::testing
