// Su & Qin, section 5 as printed: the damped oscillator r'' + nu r' + r = 0, z = (r, p), its alpha and its
// schemes. Misprints are formulas of their own, told from the corrected ones by a flag.
#pragma once

#include <pfaff/core/numbers/quad.hpp>
#include <pfaff/papers/printed/dense.hpp>

namespace pfaff::printed {

enum class Form { as_printed, corrected };

/// The oscillator with damping nu between the times t0 and t. Pairs are (w^, w) = (R^, P^, R, P) and (z^, z)
/// = (r^, p^, r, p).
class Oscillator {
 public:
  using Numbers = std::vector<Quad>;
  Oscillator(const Quad& nu, const Quad& t0, const Quad& t)
      : nu_(nu), tau_(t - t0), e_(exp(nu * t)), e0_(exp(nu * t0)) {}

  /// (92) as z' = (p, -nu p - r), and the right side of (93), which is grad B + F_t.
  [[nodiscard]] Numbers field(const Numbers& z) const { return {z[1], -(nu_ * z[1]) - z[0]}; }
  [[nodiscard]] Numbers right_side(const Numbers& z) const {
    return {nu_ * e0_ * z[1] + e0_ * z[0], e0_ * z[1]};
  }
  /// (94) at t0: K, its inverse, F and B; K at t.
  [[nodiscard]] Table<Quad> k0() const { return {{0, -e0_}, {e0_, 0}}; }
  [[nodiscard]] Table<Quad> k() const { return {{0, -e_}, {e_, 0}}; }
  [[nodiscard]] Table<Quad> k0_inverse() const { return {{0, 1 / e0_}, {-1 / e0_, 0}}; }
  [[nodiscard]] Numbers one_form(const Numbers& z) const { return {e0_ * z[1] / 2, -(e0_ * z[0] / 2)}; }
  [[nodiscard]] Quad birkhoffian(const Numbers& z, Form form) const {
    const Quad mixed = form == Form::as_printed ? z[0] * z[1] : nu_ * z[0] * z[1];
    return e0_ * (z[0] * z[0] + mixed + z[1] * z[1]) / 2;
  }
  /// diag(K, -K0) of (22).
  [[nodiscard]] Table<Quad> pair_structure() const {
    return {{0, -e_, 0, 0}, {e_, 0, 0, 0}, {0, 0, 0, e0_}, {0, 0, -e0_, 0}};
  }

  /// (95).
  [[nodiscard]] Numbers alpha(const Numbers& hat, const Numbers& z) const {
    return {e_ * hat[1] - e0_ * z[1], hat[0] - z[0], (hat[0] + z[0]) / 2, -(e_ * hat[1] + e0_ * z[1]) / 2};
  }
  /// The derivative of alpha in t at fixed states.
  [[nodiscard]] Numbers alpha_rate(const Numbers& hat) const {
    return {nu_ * e_ * hat[1], 0, 0, -(nu_ * e_ * hat[1]) / 2};
  }
  /// (96) and (98).
  [[nodiscard]] Table<Quad> alpha_jacobian() const {
    const Quad half = Quad(1) / 2;
    return {{0, e_, 0, -e0_}, {1, 0, -1, 0}, {half, 0, half, 0}, {0, -e_ / 2, 0, -e0_ / 2}};
  }
  [[nodiscard]] Table<Quad> alpha_inverse_jacobian() const {
    const Quad half = Quad(1) / 2;
    return {{0, half, 1, 0}, {half / e_, 0, 0, -1 / e_}, {0, -half, 1, 0}, {-half / e0_, 0, 0, -1 / e0_}};
  }
  /// (97).
  [[nodiscard]] Numbers alpha_inverse(const Numbers& w, Form form) const {
    const Quad front = form == Form::as_printed ? e0_ : 1 / e0_;
    return {w[1] / 2 + w[2], w[0] / (2 * e_) - w[3] / e_, w[2] - w[1] / 2, -(front * w[0] / 2) - w[3] / e0_};
  }
  /// (99): the rates of w^ and w as functions of (w^, w), with e^{-nu t} where the copy has e - nu t.
  [[nodiscard]] Numbers alpha_total_rate(const Numbers& w) const {
    return {-(e_ * w[1]) / 2 - e_ * w[2], w[0] / (2 * e_) - w[3] / e_, w[0] / (4 * e_) - w[3] / (2 * e_),
            e_ * w[1] / 4 + e_ * w[2] / 2};
  }
  /// The first form of dR^/dt in (99), where the second p^ carries a dot.
  [[nodiscard]] Quad first_rate(const Numbers& hat) const { return nu_ * e_ * hat[1] + e_ * field(hat)[1]; }

  /// (100) and (104): phi_w^(k) for k = 0, 1, 2 at w = (R, P).
  [[nodiscard]] Numbers coefficient(int k, const Numbers& w) const {
    if (k == 1) return {-(e0_ * w[0]), -(w[1] / e0_)};
    if (k == 2) return {-(nu_ / 2 * e0_ * w[0]), nu_ / 2 / e0_ * w[1]};
    return {0, 0};
  }
  /// sum_{k <= m} tau^k phi_w^(k), (87) and, for m = 1, (101).
  [[nodiscard]] Numbers gradient(int m, const Numbers& w) const {
    Numbers sum{0, 0};
    Quad power(1);
    for (int k = 1; k <= m; ++k) {
      power *= tau_;
      const Numbers term = coefficient(k, w);
      for (std::size_t i = 0; i < 2; ++i) sum[i] += power * term[i];
    }
    return sum;
  }
  /// z^ of the scheme (88) for m = 1 or 2, which is linear: alpha_1 - psi(alpha_2) vanishes.
  [[nodiscard]] Numbers step(int m, const Numbers& z) const {
    const auto residual = [&](const Numbers& hat) {
      const Numbers pair = alpha(hat, z), f = gradient(m, {pair[2], pair[3]});
      return Numbers{pair[0] - f[0], pair[1] - f[1]};
    };
    const Numbers at_zero = residual({0, 0}), first = residual({1, 0}), second = residual({0, 1});
    const Table<Quad> slope{{first[0] - at_zero[0], second[0] - at_zero[0]},
                            {first[1] - at_zero[1], second[1] - at_zero[1]}};
    return product(inverse(slope), Numbers{-at_zero[0], -at_zero[1]});
  }

  /// The Jacobian of the flow of (92), which is linear; underdamped.
  [[nodiscard]] Table<Quad> flow() const {
    const Quad w = sqrt(1 - nu_ * nu_ / 4), decay = exp(-(nu_ * tau_) / 2);
    const Quad c = decay * cos(w * tau_), s = decay * sin(w * tau_) / w;
    return {{c + nu_ / 2 * s, s}, {-s, c - nu_ / 2 * s}};
  }

  /// The transition matrices (102), (105) and (107) for the step tau.
  [[nodiscard]] Table<Quad> first_order() const {
    const Quad d = 4 + tau_ * tau_, e = exp(-(nu_ * tau_));
    return {{(4 - tau_ * tau_) / d, 4 * tau_ / d}, {-(4 * tau_ / d) * e, (4 - tau_ * tau_) / d * e}};
  }
  [[nodiscard]] Quad a() const { return 2 * tau_ - nu_ * tau_ * tau_; }  // (106)
  [[nodiscard]] Quad b() const { return 2 * tau_ + nu_ * tau_ * tau_; }
  [[nodiscard]] Table<Quad> second_order(Form form) const {
    const Quad e = exp(-(nu_ * tau_)), d = 16 + a() * b(), c = 16 - a() * b();
    return {{c / d, 8 * a() / d}, {-(8 * (form == Form::as_printed ? a() : b()) / d) * e, c / d * e}};
  }
  [[nodiscard]] Table<Quad> centre() const {
    const Quad square = tau_ * tau_, d = square + 2 * nu_ * tau_ + 4;
    return {{(4 + 2 * nu_ * tau_ - square) / d, 4 * tau_ / d},
            {-(4 * tau_) / d, (4 - 2 * nu_ * tau_ - square) / d}};
  }

 private:
  Quad nu_, tau_, e_, e0_;
};

/// sigma(M) = (A M + B)(C M + D)^-1 of (36) with the blocks of a 2n x 2n Jacobian.
struct Blocks {
  Table<Quad> a, b, c, d;
};
inline Blocks blocks_of(const Table<Quad>& jacobian) {
  const std::size_t n = jacobian.size() / 2;
  std::vector<std::size_t> first, last;
  for (std::size_t k = 0; k < n; ++k) {
    first.push_back(k);
    last.push_back(n + k);
  }
  return {part(jacobian, first, first), part(jacobian, first, last), part(jacobian, last, first),
          part(jacobian, last, last)};
}
inline Table<Quad> numerator(const Blocks& s, const Table<Quad>& m) { return sum(product(s.a, m), s.b); }
inline Table<Quad> denominator(const Blocks& s, const Table<Quad>& m) { return sum(product(s.c, m), s.d); }
inline Table<Quad> fractional(const Blocks& s, const Table<Quad>& m) {
  return product(numerator(s, m), inverse(denominator(s, m)));
}
/// M^T K M.
inline Table<Quad> congruent(const Table<Quad>& k, const Table<Quad>& m) {
  return product(transposed(m), product(k, m));
}

}  // namespace pfaff::printed
