// Jacobi's elliptic functions and the motion they solve, written as formulas: a fixed number of operations,
// no comparison but `select`, so that they can be recorded, differentiated and replayed with any scalar.
//
//   x' = y z,  y' = -x z,  z' = -x y;     x = k sn(t | m),  y = k cn(t | m),  z = dn(t | m),  m = k^2
//
// with the invariants x^2 + y^2 and x^2 + z^2. It is the pendulum (x, z the sine and cosine of half the
// angle, y half the angular velocity) and, scaled, the free rigid body. From any initial state the addition
// theorems (abramowitz-stegun1964 16.17) give the flow without inverting an elliptic integral. Written in
// x, y, z they contain no quotient by k, and their denominator 1 - m sn^2(u) sn^2(v) becomes
// cn^2(u) + sn^2(u) z^2.
//
// sn, cn, dn come by descending Landen transformations (abramowitz-stegun1964 16.12),
//
//   sn(u | m) = (1 + k_1) s/(1 + k_1 s^2),  s = sn(u/(1 + k_1) | k_1^2),  k_1 = (1 - k')/(1 + k'),
//
// until k_1^2 is below the quad round-off. The complement m' = k'^2 = 1 - m is an argument of its own: close
// to the separatrix, m' = 0, the functions are as good as m' is.
//
// Limits: a phase u that is wrong by d gives functions that are wrong by d, so errors grow as u times
// round-off, and near the separatrix, where the problem itself magnifies a change of the initial state, as
// e^u.
#pragma once

#include <array>

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// sn, cn and dn at one argument, and pi u/(2 K(m)), the mean part of the amplitude (0 on the separatrix).
template <class T>
struct JacobiFunctions {
  T sn, cn, dn, mean;
};

/// Below this complement of m the functions are expanded about the separatrix, sn = tanh u + O(m'). Errors of
/// the second order, m'^2 e^{2u}, are below 1e-35 up to u = 100.
inline Real smallest_complement() { return Real(Quad(1e-70)); }

/// Jacobi's functions of u for 0 <= m <= 1; `complement` is 1 - m.
template <class T>
JacobiFunctions<T> jacobi_functions(const T& u, const T& m, const T& complement) {
  // From k' = 1e-35 eleven steps lead to k = 6e-27, whose square is below the round-off of quad.
  constexpr std::size_t steps = 11;
  const T elliptic = complement - T(smallest_complement());  // positive: not the separatrix
  T prime = sqrt(select(elliptic, complement, T(smallest_complement())));
  std::array<T, steps> modulus, rest;  // k_1 and 1 - k_1 of every step
  T square = m, mean = u;
  for (std::size_t n = 0; n < steps; ++n) {
    const T sum = 1 + prime, root = sqrt(prime);
    modulus[n] = square / (sum * sum);
    rest[n] = 2 * prime / sum;
    mean = mean * sum / 2;
    square = modulus[n] * modulus[n];
    prime = 2 * root / sum;
  }
  T sn = sin(mean), cn = cos(mean), dn(1);
  for (std::size_t n = steps; n-- > 0;) {
    const T s2 = sn * sn, inverse = 1 / (1 + modulus[n] * s2);
    // (1 - k_1 s^2)/(1 + k_1 s^2) without the cancellation, and with c^2 + s^2 for 1 in numerator and
    // denominator. Otherwise the rounding errors in c^2 + s^2 = 1 would grow with every step.
    const T c2 = cn * cn, next = (c2 + rest[n] * s2) / (c2 + s2 + modulus[n] * s2);
    sn = (1 + modulus[n]) * sn * inverse;
    cn = cn * dn * inverse;
    dn = next;
  }
  // The separatrix, with the first order in m' (abramowitz-stegun1964 16.15), which its derivatives need.
  const T size = select(u, u, -u), decay = exp(-size), decay2 = decay * decay;
  const T secant = 2 * decay / (1 + decay2), tangent = (1 - decay2) / (1 + decay2);
  const T sinh = (1 / select(decay2, decay, T(1)) - decay) / 2;
  const T quarter = select(elliptic, T(0), complement / 4);
  const T tanh = tangent + quarter * (tangent - size * secant * secant);
  return {select(elliptic, sn, select(u, tanh, -tanh)),
          select(elliptic, cn, secant - quarter * tangent * (sinh - size * secant)),
          select(elliptic, dn, secant + quarter * tangent * (sinh + size * secant)),
          select(elliptic, mean, T(0))};
}

/// The angle of the vector (x, y) of length 1, in (-pi, pi], with an error of the order of the vector's.
template <class T>
T angle_of(const T& x, const T& y) {
  // Half the angle, from the larger of its cosine and sine; half again twice, until the series of the arcsine
  // is good to 1e-5; then Newton's method on the sine, which triples the digits: 1e-14, 1e-43.
  const T size = select(x, x, -x), height = select(y, y, -y);
  const T larger = sqrt((1 + size) / 2), smaller = height / (2 * larger);
  const T cosine = select(x, larger, smaller), sine = select(x, smaller, larger);
  const T cosine4 = sqrt((1 + cosine) / 2), sine4 = sine / (2 * cosine4);
  const T cosine8 = sqrt((1 + cosine4) / 2), s = sine4 / (2 * cosine8), s2 = s * s;
  const T series =
      1 + s2 * (Real::fraction(1, 6) + s2 * (Real::fraction(3, 40) + s2 * Real::fraction(15, 336)));
  T angle = select(y, 8 * s * series, -(8 * s * series));
  for (int iteration = 0; iteration < 2; ++iteration) angle = angle + (y * cos(angle) - x * sin(angle));
  return angle;
}

/// A state of x' = y z, y' = -x z, z' = -x y.
template <class T>
struct JacobiState {
  T x, y, z;
};

/// The state after a time. With x = r sin a, z = r cos a it shows the angle a only up to whole turns;
/// `revolving` and `mean` say how a grows.
template <class T>
struct JacobiFlow {
  JacobiState<T> state;
  T revolving;  // positive where y^2 > z^2: a grows or falls for ever
  T mean;       // there, its mean growth over the time; zero elsewhere
};

/// The flow of x' = y z, y' = -x z, z' = -x y from any state, equilibria included.
///
/// The equations are symmetric in y and z. The larger of the two in size takes the part of dn, which has no
/// zeros. Time is scaled by r, r^2 = x^2 + max(y^2, z^2), and m' = |y^2 - z^2|/r^2.
template <class T>
JacobiFlow<T> jacobi_flow(const T& t, const JacobiState<T>& start) {
  const T difference = (start.y - start.z) * (start.y + start.z);
  const T large = select(difference, start.y, start.z), small = select(difference, start.z, start.y);
  const T size = start.x * start.x + large * large;
  // At the equilibrium 0 the flow of another state, (0, 0, 1), is computed and not used.
  const T r = sqrt(select(size, size, T(1)));
  const T x = start.x / r, y = small / r, z = select(size, large, T(1)) / r;
  const T u = r * t;
  const JacobiFunctions<T> f = jacobi_functions(u, x * x + y * y, (z - y) * (z + y));
  // Vanishes only far along the separatrix from its unstable equilibrium, where the state is (1, 0, 0) to
  // round-off.
  const T sum = f.cn * f.cn + f.sn * f.sn * z * z;
  const T scale = r / select(sum, sum, T(1));
  const auto choose = [&](const T& moved, const T& unmoved) {
    return select(size, select(sum, scale * moved, unmoved), unmoved);
  };
  const T at = choose(x * f.cn * f.dn + f.sn * y * z, start.x);
  const T at_small = choose(y * f.cn - x * z * f.sn * f.dn, small);
  const T at_large = choose(z * f.dn - x * y * f.sn * f.cn, large);
  const T revolving = difference / (r * r) - T(smallest_complement());
  const JacobiState<T> moved{at, select(difference, at_large, at_small),
                             select(difference, at_small, at_large)};
  return {moved, revolving, select(revolving, select(start.y, f.mean, -f.mean), T(0))};
}

}  // namespace pfaff
