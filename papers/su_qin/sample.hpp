// A polynomial Birkhoffian system of four dimensions whose structure depends on state and time, for the
// engine and for the printed formulas. The formulas of section 2 are tried on it, because a linear system
// would let some misprints pass.
#pragma once

#include <pfaff/core/system.hpp>
#include <pfaff/papers/printed/birkhoff.hpp>

namespace pfaff::su_qin {

struct SampleSystem {
  static constexpr int dimension = 4;
  template <class T>
  T birkhoffian(const T& t, In<T> z) const {
    return z[0] * z[0] + z[1] * z[1] * z[2] + t * z[3] * z[3] * z[3] + z[0] * z[1] * z[2] / 3;
  }
  template <class T>
  void one_form(const T& t, In<T> z, Out<T> form) const {
    form[0] = z[2] * (1 + z[0] * z[1]) + t * z[1] * z[2];
    form[1] = z[3] * (2 + z[1] * z[3]) + z[0] * z[2] * z[2];
    form[2] = t * t * z[0] * z[1];
    form[3] = z[1] * z[1] * z[0] / 3 + t * z[2];
  }
};

inline std::shared_ptr<const Model> polynomial_system() {
  return make_model({.name = "polynomial", .title = "", .reference = "su-qin (4)", .initial = {1, 1, 1, 1}},
                    SampleSystem{});
}
/// The same F and B for the printed formulas.
inline printed::BirkhoffSystem printed_system() {
  const auto z = [](std::size_t k) { return printed::Polynomial::variable(k); };
  const auto number = [](int above, int below = 1) {
    return printed::Polynomial(Rational(above) / Rational(below));
  };
  const printed::Polynomial t = z(4);
  return {{z(2) + z(0) * z(1) * z(2) + t * z(1) * z(2),
           number(2) * z(3) + z(1) * z(3) * z(3) + z(0) * z(2) * z(2), t * t * z(0) * z(1),
           number(1, 3) * z(0) * z(1) * z(1) + t * z(2)},
          z(0) * z(0) + z(1) * z(1) * z(2) + t * z(3) * z(3) * z(3) + number(1, 3) * z(0) * z(1) * z(2)};
}
inline const std::vector<Quad> sample_state{Quad(0.4), Quad(-0.7), Quad(0.9), Quad(0.3)};

}  // namespace pfaff::su_qin
