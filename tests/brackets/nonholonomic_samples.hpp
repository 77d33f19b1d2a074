// Small systems with velocity constraints, and d'Alembert's principle with multipliers as an oracle of their
// motion that shares no code with brackets and tapes.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include <pfaff/core/linear/lu.hpp>
#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff::testing {

inline const SystemDescriptor descriptor{.name = "sample", .title = "", .reference = ""};

// w = dz - y dx, unit metric (pitanga-rodrigues 4.2).
struct ContactParticle {
  static constexpr int dimension = 6, velocity_constraint_count = 1;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> /*q*/) const {
    return T(0);
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = -q[1];
    rows[1] = T(0);
    rows[2] = T(1);
  }
};
// The sleigh by its centre of mass, J = 2, r = 3/4.
struct Sleigh : ContactParticle {
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2] / 2) / 2;
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = -sin(q[2]);
    rows[1] = cos(q[2]);
    rows[2] = -T(3) / T(4);
  }
};
// Four positions, two constraints, a potential, an inverse metric L L^T that depends on them, and a term
// linear in the momenta (the motion in a magnetic field).
struct Curved {
  static constexpr int dimension = 8, velocity_constraint_count = 2;
  int magnetic = 0, wind = 0;
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    const auto &x = z[0], &y = z[1], &u = z[2], &w = z[3];
    const T a = z[4] + T(magnetic) * y * w, b = z[5] - T(magnetic) * u * x, c = z[6],
            d = z[7] + T(magnetic) * x * x;
    const T first = a * (T(2) + sin(y)), second = b + a * u / 3, third = c * (T(1) + x * x / 4) + b * cos(w),
            fourth = d + a * x / 5 - c * y / 2;
    return (first * first + second * second + third * third + fourth * fourth) / 2 + sin(x) * u +
           y * y * w / 2;
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = q[1];
    rows[1] = T(1);
    rows[2] = -cos(q[3]);
    rows[3] = q[0] / 2;
    rows[4] = T(0);
    rows[5] = q[2] * q[3];
    rows[6] = T(2);
    rows[7] = T(1) + q[1];
  }
  template <class T>
  void velocity_offsets(const T& /*t*/, In<T> q, Out<T> b) const {
    b[0] = T(wind) * q[2];
    b[1] = T(wind) * q[0];
  }
};
// z = x y + const in disguise: y dx + x dy - dz.
struct Integrable : ContactParticle {
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = q[1];
    rows[1] = q[0];
    rows[2] = -T(1);
  }
};
struct NotQuadratic : ContactParticle {
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] * p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
  }
};

template <class T>
std::vector<T> values(const std::shared_ptr<const Tape>& tape, const std::vector<T>& x) {
  std::vector<T> out(tape->outputs.size());
  Replay<T> replay(tape);
  replay(T(0), x.data(), out.data());
  return out;
}
template <class T>
std::vector<T> state(std::size_t n, int shift) {
  std::vector<T> z;
  for (std::size_t k = 0; k < n; ++k)
    z.push_back(T(static_cast<int>(3 * k + 2) * (k % 2 == 0 ? 1 : -1) + shift) / T(10));
  return z;
}

// d'Alembert's principle with multipliers, all derivatives by duals of the author's struct: the rates of (q,
// p) at (q, p) with A v + b = 0 are (H_p, -H_q - A^T lambda) with d(A v + b)/dt = 0, one dense system in (p',
// lambda), [[I, A^T], [A H_pp, 0]].
template <class T, class S>
std::vector<T> dalembert(const S& system, const std::vector<T>& z) {
  const std::size_t n = z.size() / 2, m = static_cast<std::size_t>(S::velocity_constraint_count);
  using D = Dual<T, 1>;
  using DD = Dual<D, 1>;
  const auto energy = [&](const auto& at) {
    using X = std::decay_t<decltype(at[0])>;
    if constexpr (requires { system.template hamiltonian<X>(X(0), In<X>(at)); }) {
      return system.template hamiltonian<X>(X(0), In<X>(at));
    } else {
      const In<X> all(at);
      return system.template kinetic<X>(X(0), all.subspan(n)) +
             system.template potential<X>(X(0), all.first(n));
    }
  };
  // H_k at a point that moves in a direction: value and derivative.
  const auto slope = [&](std::size_t k, const std::vector<T>& direction) {
    std::vector<DD> x(2 * n);
    for (std::size_t i = 0; i < 2 * n; ++i) {
      x[i].value.value = z[i];
      x[i].value.derivative[0] = direction[i];
    }
    x[k].derivative[0].value = T(1);
    return energy(x).derivative[0];
  };
  const std::vector<T> still(2 * n);
  std::vector<T> v(n), force(n), along(2 * n);
  for (std::size_t k = 0; k < n; ++k) {
    v[k] = slope(n + k, still).value;
    force[k] = -slope(k, still).value;
    along[k] = v[k];  // q moves with v, p is held
  }
  // psi = A(q) v + b(q) where q moves with v and p is held, and A at the point.
  std::vector<D> q(n), rows(m * n), offsets(m);
  for (std::size_t k = 0; k < n; ++k) {
    q[k].value = z[k];
    q[k].derivative[0] = v[k];
  }
  system.template velocity_constraints<D>(D(0), In<D>(q), Out<D>(rows));
  if constexpr (requires { system.template velocity_offsets<D>(D(0), In<D>(q), Out<D>(offsets)); })
    system.template velocity_offsets<D>(D(0), In<D>(q), Out<D>(offsets));
  std::vector<T> right(n + m), solution(n + m);
  LU<T> lu(n + m);
  for (std::size_t k = 0; k < n; ++k) {
    lu(k, k) = T(1);
    right[k] = force[k];
  }
  for (std::size_t a = 0; a < m; ++a) {
    D rate = offsets[a];
    for (std::size_t k = 0; k < n; ++k) {
      const D moving = slope(n + k, along);
      rate = rate + rows[a * n + k] * moving;
      lu(k, n + a) = rows[a * n + k].value;
      for (std::size_t j = 0; j < n; ++j) {
        std::vector<T> unit(2 * n);
        unit[n + j] = T(1);
        lu(n + a, j) = lu(n + a, j) + rows[a * n + k].value * slope(n + k, unit).derivative[0];
      }
    }
    right[n + a] = -rate.derivative[0];
  }
  EXPECT_TRUE(lu.factor());
  lu.solve(right.data(), solution.data());
  std::vector<T> result = v;
  result.insert(result.end(), solution.begin(), solution.begin() + static_cast<std::ptrdiff_t>(n));
  return result;
}

}  // namespace pfaff::testing
