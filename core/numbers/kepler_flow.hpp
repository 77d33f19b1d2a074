// The flow of Kepler's problem, q'' = -mu q/|q|^3, from any state for any time, in universal variables
// (battin1999 section 4.5). Ellipses, parabolas and hyperbolas are one case.
//
// With ds = dt/r, beta = 2 mu/r0 - v0^2, eta = q0.v0 and the functions G_k(s) = s^k c_k(beta s^2) of Stumpff,
// c_k(x) = 1/k! - x/(k + 2)! + x^2/(k + 4)! - ..., time and distance are
//
//   h = r0 G_1 + eta G_2 + mu G_3,   r = r0 + eta G_1 + zeta G_2,   zeta = mu - beta r0 = r0 v0^2 - mu
//
// and the end of the flow is q = f q0 + g v0, v = f' q0 + g' v0 with
//
//   f - 1 = -mu G_2/r0,   g = r0 G_1 + eta G_2,   f' = -mu G_1/(r0 r),   g' - 1 = -mu G_2/r.
//
// What is computed is the change of the state, from f - 1, g - h and g' - 1: a short flow is wrong by
// round-off of the change and not of the state. Of the positions it is also given without the uniform motion,
// so that whoever adds uniform motions of several bodies can do so by themselves; where the attraction is the
// smaller part g - h = -mu G_3. Nothing is divided by beta where it is small: there the G_k are series, and
// so are short flows of every orbit.
//
// The equation for s has one root, since dh/ds = r > 0. Laguerre's method of degree 5 finds it (conway1986),
// inside a bracket that halves where a step would leave it, so that it converges from any state and time. Of
// ellipses whole periods are taken off the time first, N of them with N times the error of the period, which
// is therefore computed with twice the digits. The last digits are Newton's, in the scalar itself, which for
// a dual number gives the derivative of the root.
//
// Limits: a state that is rounded has another period, so that flows of N periods one after another, or of
// coordinates that were transformed, have phases wrong by N round-offs and more. A hyperbola of several times
// the speed of escape that comes in from afar and goes out again in one flow loses digits, as the product of
// both distances over the square of the smallest one.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <span>

#include <pfaff/core/errors/status.hpp>
#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/core/numbers/two_terms.hpp>

namespace pfaff {

/// The functions G_1, G_2 and G_3 at one s.
template <class T>
struct UniversalFunctions {
  T g1, g2, g3;
};

namespace detail {
/// 1/((2 k + first) (2 k + first + 1)), the ratios of the terms of Stumpff's series, k = 0, 1, ...
template <class V, std::size_t N>
constexpr std::array<V, N> stumpff_ratios(int first) {
  std::array<V, N> ratios{};
  for (std::size_t k = 0; k < N; ++k) {
    const int m = 2 * static_cast<int>(k) + first;
    ratios[k] = V(1) / V(m * (m + 1));
  }
  return ratios;
}
}  // namespace detail

/// G_1, G_2 and G_3 for any beta and s.
template <class T>
UniversalFunctions<T> universal_functions(const T& beta, const T& s) {
  using V = Value<T>;
  const T square = s * s, x = beta * square;
  // For |x| <= 1 the first term left out is below the round-off: 1/21! in double, 1/35! in quad.
  if (abs(value_of(x)) <= V(1)) {
    constexpr std::size_t terms = sizeof(V) > sizeof(double) ? 16 : 9;
    static constexpr std::array<V, terms> even = detail::stumpff_ratios<V, terms>(3),
                                          odd = detail::stumpff_ratios<V, terms>(4);
    T c2(1), c3(1);
    for (std::size_t k = terms; k-- > 0;) {
      c2 = T(1) - x * T(even[k]) * c2;
      c3 = T(1) - x * T(odd[k]) * c3;
    }
    c2 = c2 / T(2);
    c3 = c3 / T(6);
    return {s * (T(1) - x * c3), square * c2, s * square * c3};
  }
  if (value_of(x) > V(0)) {
    const T root = sqrt(beta);
    T sine, cosine;
    sine_cosine(T(root * s / T(2)), sine, cosine);
    const T g1 = T(2) * sine * cosine / root;
    return {g1, T(2) * sine * sine / beta, (s - g1) / beta};
  }
  const T root = sqrt(T(-beta)), growing = exp(T(root * s / T(2)));
  const T sinh = (growing - T(1) / growing) / T(2), cosh = (growing + T(1) / growing) / T(2);
  const T g1 = T(2) * sinh * cosh / root;
  return {g1, -(T(2) * sinh * sinh / beta), (s - g1) / beta};
}

namespace detail {

/// The root s > 0 of r0 G_1 + eta G_2 + mu G_3 = h for h > 0, to round-off, and in `g` the functions there;
/// `status` says where it was not found.
template <class V>
V universal_anomaly(const V& r0, const V& eta, const V& zeta, const V& mu, const V& beta, const V& h,
                    const V& largest, UniversalFunctions<V>& g, Status& status) {
  constexpr int most_iterations = 200;  // bisection alone takes 113 for a quad
  const V unit = unit_roundoff<V>();
  V low(0), high = largest;  // not bounded where `largest` is zero
  bool bounded = largest > V(0);
  V s = h / r0;
  // To the third order in h where that is near the first.
  const V bend0 = eta * s / (V(2) * r0), turn = zeta * s * s / (V(6) * r0);
  if (abs(bend0) + abs(turn) < V(0.25))
    s = s * (V(1) - bend0 + (V(2) * bend0 * bend0 - turn) + V(5) * bend0 * (turn - bend0 * bend0));
  if (bounded && !(s < high)) s = high / V(2);
  // Of hyperbolas time grows as the exponential of this.
  if (const V angle = beta < V(0) ? V(sqrt(-beta) * s) : V(0); angle > V(1))
    s = s * (V(1) + log(angle)) / angle;
  V last = std::numeric_limits<V>::infinity();
  for (int k = 0; k < most_iterations; ++k) {
    g = universal_functions(beta, s);
    const V a = r0 * g.g1, b = eta * g.g2, c = mu * g.g3;
    const V value = a + b + c - h, r = r0 + eta * g.g1 + zeta * g.g2,
            bend = eta * (V(1) - beta * g.g2) + zeta * g.g1;
    if (!isfinite(value)) {  // far beyond the root of a hyperbola
      high = s;
      bounded = true;
      s = (low + high) / V(2);
      continue;
    }
    // Round-off of the sum, and of s.
    if (abs(value) <= V(2) * unit * (a + abs(b) + abs(c) + h + abs(r) * s)) return s;
    (value > V(0) ? high : low) = s;
    bounded = bounded || value > V(0);
    const V newton = value / r,
            step = V(5) * newton / (V(1) + sqrt(abs(V(16) - V(20) * newton * (bend / r))));
    // What moves s by its last digits only, and no less than before, moves it for ever.
    if (abs(step) <= V(16) * unit * s && !(abs(step) < last)) return s;
    last = abs(step);
    V next = s - step;
    if (!(next > low) || (bounded && !(next < high))) next = bounded ? (low + high) / V(2) : V(2) * s;
    if (next == s) return s;
    s = next;
  }
  status = Status::not_converged;
  return s;
}

}  // namespace detail

/// h less `turns` periods of the ellipse through (q, v), rounded once.
template <class V>
V time_after_turns(const TwoTerms<V>& mu, const V& h, std::span<const TwoTerms<V>> q,
                   std::span<const TwoTerms<V>> v, const V& turns) {
  TwoTerms<V> distance, speed;
  for (std::size_t x = 0; x < q.size(); ++x) {
    distance = distance + q[x] * q[x];
    speed = speed + v[x] * v[x];
  }
  const TwoTerms<V> two(V(2)), beta = two * mu / sqrt(distance) - speed;
  const TwoTerms<V> period = two * TwoTerms<V>::pi() * mu / (beta * sqrt(beta));
  return (TwoTerms<V>(h) - TwoTerms<V>(turns) * period).high;
}

/// The flow of q'' = -mu q/|q|^3, mu >= 0, for the time h of either sign, in as many dimensions as q has: dq
/// and dv are the changes of q and v, and bend is what dq has beyond the uniform motion, dq - h v. The status
/// is `not_converged` where the root was not found or the time is more periods than a double counts, and
/// `non_finite` where the state has no orbit or ends in a collision. after_turns(N) is h less N periods as
/// rounded once; who has rounded mu, q or v itself knows the period better than these tell.
template <class T, class AfterTurns>
Status kepler_change(const T& mu, const T& h, std::span<const T> q, std::span<const T> v, std::span<T> dq,
                     std::span<T> bend, std::span<T> dv, const AfterTurns& after_turns) {
  using V = Value<T>;
  static const V pi(3.14159265358979323846264338327950288_r);
  T distance(0), eta(0), speed(0);
  for (std::size_t x = 0; x < q.size(); ++x) {
    distance = distance + q[x] * q[x];
    eta = eta + q[x] * v[x];
    speed = speed + v[x] * v[x];
  }
  const T r0 = sqrt(distance), zeta = r0 * speed - mu, beta = (mu - zeta) / r0;
  const V curve = value_of(beta);
  if (!(value_of(r0) > V(0)) || !isfinite(curve) || !isfinite(value_of(eta)) || !isfinite(value_of(h)))
    return Status::non_finite;
  T time = h;
  V largest(0);
  bool periods_off = false;
  if (curve > V(0)) {
    const T root = sqrt(beta), period = T(V(2) * pi) * mu / (beta * root);
    if (abs(value_of(h)) > value_of(period) / V(2)) {
      const double turns = std::nearbyint(static_cast<double>(value_of(h) / value_of(period)));
      // More turns than a double counts leave no phase.
      if (!(std::abs(turns) < 0x1p52)) return Status::not_converged;
      time = h - T(V(turns)) * period;
      time = time + T(after_turns(V(turns)) - value_of(time));
      periods_off = true;
    }
    largest = V(2) * pi / value_of(root);
  }
  T s = time / r0;  // to the first order, which is enough for the derivatives at time 0
  UniversalFunctions<T> u;
  if (value_of(time) == V(0)) {
    u = universal_functions(beta, s);
  } else {
    // A flow backwards is one forwards with the velocity turned.
    const V turned = value_of(time) < V(0) ? V(-1) : V(1);
    Status status = Status::converged;
    UniversalFunctions<V> found;
    const V root =
        detail::universal_anomaly<V>(value_of(r0), turned * value_of(eta), value_of(zeta), value_of(mu),
                                     curve, turned * value_of(time), largest, found, status);
    if (status != Status::converged) return status;
    if constexpr (std::is_same_v<T, V>) {
      u = {turned * found.g1, found.g2, turned * found.g3};
      // The iteration ends at one side of the root, by some round-off; the first order brings it there.
      const T ahead = r0 * u.g1 + eta * u.g2 + mu * u.g3 - time;
      const T step = ahead / (r0 + eta * u.g1 + zeta * u.g2);
      u = {u.g1 - (T(1) - beta * u.g2) * step, u.g2 - u.g1 * step, u.g3 - u.g2 * step};
    } else {
      s = T(turned * root);
      u = universal_functions(beta, s);
      s = s + (time - (r0 * u.g1 + eta * u.g2 + mu * u.g3)) / (r0 + eta * u.g1 + zeta * u.g2);
      u = universal_functions(beta, s);
    }
  }
  // Where the pull is the smaller part of the time, dq is made of h v and what the attraction adds.
  const T f = -(mu * u.g2 / r0), pull = mu * u.g3;
  const bool nearly_free = !periods_off && V(2) * abs(value_of(pull)) <= abs(value_of(time));
  const T g = r0 * u.g1 + eta * u.g2;
  T square(0);
  for (std::size_t x = 0; x < q.size(); ++x) {
    const T uniform = h * v[x];
    if (nearly_free) {
      bend[x] = f * q[x] - pull * v[x];
      dq[x] = uniform + bend[x];
    } else {
      dq[x] = f * q[x] + g * v[x];
      bend[x] = dq[x] - uniform;
    }
    square = square + (q[x] + dq[x]) * (q[x] + dq[x]);
  }
  const T r = sqrt(square), f_rate = -(mu * u.g1 / (r0 * r)), g_rate = -(mu * u.g2 / r);
  for (std::size_t x = 0; x < q.size(); ++x) dv[x] = f_rate * q[x] + g_rate * v[x];
  for (std::size_t x = 0; x < q.size(); ++x)
    if (!isfinite(value_of(bend[x])) || !isfinite(value_of(dv[x]))) return Status::non_finite;
  return Status::converged;
}

/// The same where mu, q and v, in up to three dimensions, are what is meant to the last digit.
template <class T>
Status kepler_change(const T& mu, const T& h, std::span<const T> q, std::span<const T> v, std::span<T> dq,
                     std::span<T> bend, std::span<T> dv) {
  using V = Value<T>;
  return kepler_change(mu, h, q, v, dq, bend, dv, [&](const V& turns) {
    std::array<TwoTerms<V>, 3> place, speed;
    for (std::size_t x = 0; x < q.size(); ++x) {
      place[x] = value_of(q[x]);
      speed[x] = value_of(v[x]);
    }
    return time_after_turns<V>(value_of(mu), value_of(h), std::span<const TwoTerms<V>>(place),
                               std::span<const TwoTerms<V>>(speed), turns);
  });
}

}  // namespace pfaff
