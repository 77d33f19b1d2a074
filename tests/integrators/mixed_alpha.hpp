// Transformations alpha over any chart, linear and not, right and wrong, and their inverses.
#pragma once

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

}  // namespace pfaff::testing
