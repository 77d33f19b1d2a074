// Su & Qin, section 4 as printed: the coefficients of the generating function, (73)-(82), in closed form.
//
// Everything is a polynomial in the midpoints w = (w_0, w_1, ..) of the chart and in s = sin w_0, c = cos
// w_0, differentiated by the rules s' = c, c' = -s; time enters through numbers such as e^{nu t} alone, whose
// Taylor coefficients are known. With J = [[0, I], [-I, 0]], w^ = J (y^ - y) and w = (y^ + y)/2, the new
// state is y^ = w - J phi_w/2, and (61), with the sign corrected, is
//
//   d/dt phi_w = a(X, Y) = -H_y(y^, t) - Y J H_y(y^, t)/2,   X = phi_w, Y = phi_ww.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include <pfaff/core/numbers/quad.hpp>

namespace pfaff::printed {

/// sum of c w_0^i w_1^j w_2^k w_3^l s^m c^n.
class TrigonometricPolynomial {
 public:
  using Powers = std::array<int, 6>;
  static constexpr std::size_t sine_place = 4, cosine_place = 5;

  TrigonometricPolynomial() = default;
  TrigonometricPolynomial(const Quad& number) { add({}, number); }  // NOLINT(google-explicit-constructor)
  static TrigonometricPolynomial variable(std::size_t place) {
    TrigonometricPolynomial x;
    Powers powers{};
    powers[place] = 1;
    x.add(powers, 1);
    return x;
  }
  /// The derivative of sin w_0 of this order.
  static TrigonometricPolynomial sine(int order) {
    const auto function = variable(order % 2 == 0 ? sine_place : cosine_place);
    return order % 4 < 2 ? function : Quad(-1) * function;
  }

  friend TrigonometricPolynomial operator+(TrigonometricPolynomial a, const TrigonometricPolynomial& b) {
    for (const auto& [powers, number] : b.terms_) a.add(powers, number);
    return a;
  }
  friend TrigonometricPolynomial operator*(const TrigonometricPolynomial& a,
                                           const TrigonometricPolynomial& b) {
    TrigonometricPolynomial product;
    for (const auto& [left, x] : a.terms_)
      for (const auto& [right, y] : b.terms_) {
        Powers powers = left;
        for (std::size_t k = 0; k < powers.size(); ++k) powers[k] += right[k];
        product.add(powers, x * y);
      }
    return product;
  }
  friend TrigonometricPolynomial operator-(const TrigonometricPolynomial& a,
                                           const TrigonometricPolynomial& b) {
    return a + Quad(-1) * b;
  }

  [[nodiscard]] TrigonometricPolynomial slope(std::size_t place) const {
    TrigonometricPolynomial result = by(place);
    if (place != 0) return result;
    return result + by(sine_place) * variable(cosine_place) - by(cosine_place) * variable(sine_place);
  }
  [[nodiscard]] Quad at(const std::vector<Quad>& w) const {
    std::array<Quad, 6> values{};
    for (std::size_t k = 0; k < w.size(); ++k) values[k] = w[k];
    values[sine_place] = sin(w[0]);
    values[cosine_place] = cos(w[0]);
    Quad sum(0);
    for (const auto& [powers, number] : terms_) {
      Quad product = number;
      for (std::size_t k = 0; k < powers.size(); ++k)
        for (int power = 0; power < powers[k]; ++power) product *= values[k];
      sum += product;
    }
    return sum;
  }

 private:
  void add(const Powers& powers, const Quad& number) { terms_[powers] += number; }
  // The derivative by one of the six, the others held.
  [[nodiscard]] TrigonometricPolynomial by(std::size_t place) const {
    TrigonometricPolynomial result;
    for (const auto& [powers, number] : terms_) {
      if (powers[place] == 0) continue;
      Powers lower = powers;
      --lower[place];
      result.add(lower, Quad(powers[place]) * number);
    }
    return result;
  }

  std::map<Powers, Quad> terms_;
};

using Gradient = std::vector<TrigonometricPolynomial>;
/// sum_k tau^k coefficients_k, all of one length, beyond which it is cut off.
using TauSeries = std::vector<TrigonometricPolynomial>;

inline TauSeries operator+(TauSeries a, const TauSeries& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] = a[k] + b[k];
  return a;
}
inline TauSeries operator*(const TauSeries& a, const TauSeries& b) {
  TauSeries product(a.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; i + k < a.size(); ++k) product[i + k] = product[i + k] + a[i] * b[k];
  return product;
}
inline TauSeries operator*(const Quad& number, TauSeries a) {
  for (auto& x : a) x = number * x;
  return a;
}
inline Quad factorial(int k) {
  Quad product(1);
  for (int i = 2; i <= k; ++i) product *= Quad(i);
  return product;
}
/// The derivative of the sine of this order at w_0 + x, where x begins with tau.
inline TauSeries sine_at(const TauSeries& x, int order) {
  TauSeries sum(x.size()), power(x.size());
  power[0] = Quad(1);
  for (int k = 0; k < static_cast<int>(x.size()); ++k) {
    for (std::size_t i = 0; i < x.size(); ++i)
      sum[i] = sum[i] + (Quad(1) / factorial(k)) * TrigonometricPolynomial::sine(order + k) * power[i];
    power = power * x;
  }
  return sum;
}
/// e^{rate (t0 + tau)}.
inline TauSeries exponential(const Quad& rate, const Quad& t0, std::size_t length) {
  TauSeries series;
  Quad coefficient = exp(rate * t0);
  for (std::size_t k = 0; k < length; ++k) {
    series.emplace_back(coefficient);
    coefficient = coefficient * rate / Quad(static_cast<int>(k + 1));
  }
  return series;
}

/// phi^(0), .., phi^(degree) from phi_t = -energy, (73), (75) and (76): `energy` is what stands there as a
/// function of the new state y^ of the chart, given by what it differs from w.
inline std::vector<TrigonometricPolynomial> coefficients(
    std::size_t dimension, int degree,
    const std::function<TauSeries(const std::vector<TauSeries>& shift)>& energy) {
  const auto length = static_cast<std::size_t>(degree) + 1;
  const std::size_t half = dimension / 2;
  TauSeries phi(length);
  for (std::size_t k = 0; k + 1 < length; ++k) {
    std::vector<TauSeries> shift(dimension, TauSeries(length));  // y^ - w = -J phi_w/2
    for (std::size_t i = 0; i < half; ++i)
      for (std::size_t j = 0; j <= k; ++j) {
        shift[i][j] = (Quad(-1) / Quad(2)) * phi[j].slope(half + i);
        shift[half + i][j] = (Quad(1) / Quad(2)) * phi[j].slope(i);
      }
    phi[k + 1] = (Quad(-1) / Quad(static_cast<int>(k + 1))) * energy(shift)[k];
  }
  return phi;
}

/// How [tau^k] a is formed: by (82) with the total derivative, by (77) and (78) corrected, or as they are
/// printed.
enum class Expansion { total_derivative, corrected, as_77, as_78 };

/// phi_w^(k) of a damped system r'' + nu r' + V'(r) = 0 in its chart, H = e^{-nu t} y_1^2/2 + e^{nu t}
/// V(y_0), with V' = sin (the pendulum) or V'(r) = r (the oscillator).
class GeneratingGradient {
 public:
  GeneratingGradient(const Quad& nu, const Quad& t0, bool pendulum) : nu_(nu), t0_(t0), pendulum_(pendulum) {}

  /// phi_w^(0), .., phi_w^(degree).
  [[nodiscard]] std::vector<Gradient> terms(int degree, Expansion rule) const {
    std::vector<Gradient> phi{Gradient(2)};
    for (int k = 0; k < degree; ++k) {
      Gradient next = rule == Expansion::total_derivative ? along_series(phi, k)
                      : rule == Expansion::corrected      ? multilinear(phi, k)
                                                          : as_printed(phi, k, rule == Expansion::as_77);
      for (auto& x : next) x = (Quad(1) / Quad(k + 1)) * x;
      phi.push_back(std::move(next));
    }
    return phi;
  }

 private:
  using Lengths = std::vector<int>;
  static Gradient sum(Gradient a, const Quad& weight, const Gradient& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] = a[i] + weight * b[i];
    return a;
  }
  // V'(w_0) differentiated n times.
  [[nodiscard]] TrigonometricPolynomial force(int n) const {
    if (pendulum_) return TrigonometricPolynomial::sine(n);
    return n == 0 ? TrigonometricPolynomial::variable(0) : TrigonometricPolynomial(Quad(n == 1 ? 1 : 0));
  }
  // -H_y - Y J H_y/2, or its part linear in Y alone, for given H_y.
  static Gradient rate(const TrigonometricPolynomial& h0, const TrigonometricPolynomial& h1) {
    return {Quad(-1) * h0, Quad(-1) * h1};
  }
  static Gradient turned(const Gradient& phi, const TrigonometricPolynomial& h0,
                         const TrigonometricPolynomial& h1) {
    Gradient result(2);
    for (std::size_t i = 0; i < 2; ++i)
      result[i] = (Quad(-1) / Quad(2)) * (phi[i].slope(0) * h1 - phi[i].slope(1) * h0);
    return result;
  }
  // d_X^n d_Y^l d_t^m a in the directions phi_w^(h), phi_ww^(j), at X = Y = 0: a is linear in Y, and X moves
  // y^ by -J X/2.
  [[nodiscard]] Gradient derivative(const std::vector<Gradient>& phi, int m, const Lengths& h,
                                    const Lengths& j) const {
    if (j.size() > 1) return Gradient(2);
    TrigonometricPolynomial h0 = force(static_cast<int>(h.size())), h1 = TrigonometricPolynomial::variable(1);
    for (const int length : h) h0 = (Quad(-1) / Quad(2)) * h0 * phi[static_cast<std::size_t>(length)][1];
    if (h.size() == 1) h1 = (Quad(1) / Quad(2)) * phi[static_cast<std::size_t>(h.front())][0];
    if (h.size() > 1) h1 = {};
    Quad grown = exp(nu_ * t0_), decayed = exp(-(nu_ * t0_));
    for (int i = 0; i < m; ++i) {
      grown = nu_ * grown;
      decayed = -(nu_ * decayed);
    }
    h0 = grown * h0;
    h1 = decayed * h1;
    return j.empty() ? rate(h0, h1) : turned(phi[static_cast<std::size_t>(j.front())], h0, h1);
  }
  // Every way to write `total` as an ordered sum of n + l positive parts, the first n of them in h.
  static void compositions(int total, std::size_t n, std::size_t l, Lengths parts,
                           const std::function<void(const Lengths&, const Lengths&)>& take) {
    if (parts.size() == n + l) {
      const auto middle = parts.begin() + static_cast<std::ptrdiff_t>(n);
      if (total == 0) take({parts.begin(), middle}, {middle, parts.end()});
      return;
    }
    for (int part = 1; part <= total; ++part) {
      Lengths longer = parts;
      longer.push_back(part);
      compositions(total - part, n, l, longer, take);
    }
  }
  [[nodiscard]] Gradient sum_over(const std::vector<Gradient>& phi, int m, int n, int l, int total) const {
    Gradient all(2);
    compositions(total, static_cast<std::size_t>(n), static_cast<std::size_t>(l), {},
                 [&](const Lengths& h, const Lengths& j) { all = sum(all, 1, derivative(phi, m, h, j)); });
    return all;
  }
  [[nodiscard]] Gradient multilinear(const std::vector<Gradient>& phi, int k) const {
    Gradient all(2);
    for (int m = 0; m <= k; ++m)
      for (int n = 0; n <= k - m; ++n)
        for (int l = 0; n + l <= k - m; ++l)
          all =
              sum(all, Quad(1) / (factorial(m) * factorial(n) * factorial(l)), sum_over(phi, m, n, l, k - m));
    return all;
  }
  // 1/k! of D_t^k at t = t0 with the terms and weights that are printed. The third term has phi_ww in (77)
  // and phi_w in (78). The lengths in the last line of (78) have no meaning from k = 3 on, where those of
  // (77) are taken.
  [[nodiscard]] Gradient as_printed(const std::vector<Gradient>& phi, int k, bool third_in_hessian) const {
    if (k == 0) return derivative(phi, 0, {}, {});
    Gradient all = sum(derivative(phi, 0, {k}, {}), 1, derivative(phi, 0, {}, {k}));
    all = sum(all, 1, third_in_hessian ? derivative(phi, 1, {}, {k - 1}) : derivative(phi, 1, {k - 1}, {}));
    const auto binomial = [](int a, int b) { return factorial(a) / (factorial(b) * factorial(a - b)); };
    for (int m = 0; m <= k; ++m)
      for (int n = 1; n <= k - m; ++n)
        for (int l = 1; l <= k - m - n; ++l)
          all = sum(all, binomial(k, m) * binomial(k - m, n), sum_over(phi, m, n, l, k - m));
    for (auto& x : all) x = (Quad(1) / factorial(k)) * x;
    return all;
  }
  // [tau^k] a along the series that is known so far.
  [[nodiscard]] Gradient along_series(const std::vector<Gradient>& phi, int k) const {
    const auto length = static_cast<std::size_t>(k) + 1;
    TauSeries position(length), momentum(length);
    for (std::size_t i = 0; i < length; ++i) {
      position[i] = (Quad(-1) / Quad(2)) * phi[i][1];
      momentum[i] = (Quad(1) / Quad(2)) * phi[i][0];
    }
    TauSeries force = position;
    force[0] = force[0] + TrigonometricPolynomial::variable(0);
    if (pendulum_) force = sine_at(position, 0);
    momentum[0] = momentum[0] + TrigonometricPolynomial::variable(1);
    const TauSeries h0 = exponential(nu_, t0_, length) * force,
                    h1 = exponential(-nu_, t0_, length) * momentum;
    Gradient all = rate(h0[length - 1], h1[length - 1]);
    for (std::size_t i = 0; i < length; ++i)
      all = sum(all, 1, turned(phi[i], h0[length - 1 - i], h1[length - 1 - i]));
    return all;
  }

  Quad nu_, t0_;
  bool pendulum_;
};

}  // namespace pfaff::printed
