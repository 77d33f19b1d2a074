// StaticProblem: the struct of a system's author as a problem whose type and size the compiler knows.
//
//   using P = StaticProblem<Kepler>;
//   const P problem;
//   const Verlet method;
//   Work<Verlet, P> work(method, problem);
//   advance(method, problem, t0, 0, h, steps, z, work, completed);
//
// No registry, no tape, no indirect call: formulas are inlined into the method's loop, which then costs what
// a hand-written one costs. Formulas that the author did not write are derived with dual numbers: forces and
// velocities as gradients of the energies, the field of a Hamiltonian as J grad H, Jacobians. For methods
// that expand the field in series it is recorded when they are set up; the Darboux chart of a canonical
// system is the identity.
//
// Limits: S::dimension has to be a constant, and only what dual numbers give cheaply is derived. Birkhoffian
// systems and those with a bracket of their own, a symmetric one among them, therefore have a field here only
// where their author wrote it. Systems with constraints have none, because a formulation makes their motion.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>

#include <pfaff/core/facets/compiled_series.hpp>
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/facets/written_formulas.hpp>
#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/numbers/pack.hpp>
#include <pfaff/core/tape/recorder.hpp>

namespace pfaff {

/// Counters that count nothing.
struct Uncounted {
  struct Nothing {
    constexpr void operator++() const {}
    constexpr void operator+=(std::int64_t /*amount*/) const {}
  };
  Nothing steps, fields, jacobians, iterations, factorisations;
};

namespace detail {

/// slope = the gradient at x of energy(t, x), a function of N numbers, in one pass of dual numbers.
template <int N, class T, class Energy>
void dual_gradient(const Energy& energy, const T& t, In<T> x, Out<T> slope) {
  using D = Dual<T, N>;
  Vector<D, N> point;
  for (int k = 0; k < N; ++k)
    point[static_cast<std::size_t>(k)] = D::variable(x[static_cast<std::size_t>(k)], k);
  const D value = energy(D(t), In<D>(point));
  for (std::size_t k = 0; k < N; ++k) slope[k] = value.derivative[k];
}

}  // namespace detail

/// The system S with states of T. A copy of the author's object lives inside.
template <class S, class T = double>
class StaticProblem {
 public:
  using Scalar = T;
  static constexpr int extent = S::dimension;
  using State = Vector<T, extent>;
  static constexpr bool constrained = detail::counts_constraints<S> || detail::counts_velocity_constraints<S>;
  // Where constraints, a second bracket or applied forces take part, the energy alone does not make the
  // motion.
  static constexpr bool alone = !constrained && !detail::writes<S, Formula::symmetric_tensor> &&
                                !detail::writes<S, Formula::applied_force>;
  static constexpr FormulaMembers members = detail::energy_members<S, T>();
  static constexpr bool conformal = alone && members.conformal(), separable = alone && members.separable(),
                        canonical = alone && members.canonical();
  template <Formula F, int W>
  static constexpr bool written_in_lanes = std::is_same_v<T, double>&& detail::writes<S, F, Pack<W>>;
  static constexpr bool has_field =
      canonical || conformal || (!constrained && detail::writes<S, Formula::field, T>);

  explicit StaticProblem(S system = {}) : system_(std::move(system)) {}

  [[nodiscard]] static constexpr std::size_t size() { return static_cast<std::size_t>(extent); }
  [[nodiscard]] State make_state() const { return {}; }
  [[nodiscard]] Uncounted counters() const { return {}; }
  [[nodiscard]] const S& system() const { return system_; }
  /// Nothing needs preparing.
  void prepare(Formula /*formula*/) const {}

  /// rate = X(z, t).
  void field(const T& t, In<T> z, Out<T> rate) const requires has_field { field_of<T>(t, z, rate); }
  /// matrix[i n + j] = dX_i / dz_j.
  void field_jacobian(const T& t, In<T> z, Out<T> matrix) const requires has_field {
    using D = Dual<T, extent>;
    Vector<D, extent> point, rate;
    for (std::size_t k = 0; k < size(); ++k) point[k] = D::variable(z[k], static_cast<int>(k));
    field_of<D>(D(t), point, rate);
    for (std::size_t i = 0; i < size(); ++i)
      for (std::size_t j = 0; j < size(); ++j) matrix[i * size() + j] = rate[i].derivative[j];
  }
  /// H(z, t).
  [[nodiscard]] T hamiltonian(const T& t, In<T> z) const requires canonical {
    return hamiltonian_of<T>(t, z);
  }
  /// -dV/dq.
  void force(const T& t, In<T> q, Out<T> f) const requires separable { force_of<T>(t, q, f); }
  /// dT/dp.
  void velocity(const T& t, In<T> p, Out<T> v) const requires separable { velocity_of<T>(t, p, v); }
  /// What of these the author writes, at several times and points side by side, one in each lane.
  template <int W>
  void force(const Pack<W>& t, In<Pack<W>> q, Out<Pack<W>> f) const
      requires(separable&& written_in_lanes<Formula::force, W>) {
    system_.force(t, q, f);
  }
  template <int W>
  void velocity(const Pack<W>& t, In<Pack<W>> p, Out<Pack<W>> v) const
      requires(separable&& written_in_lanes<Formula::velocity, W>) {
    system_.velocity(t, p, v);
  }
  template <int W>
  void field(const Pack<W>& t, In<Pack<W>> z, Out<Pack<W>> rate) const
      requires(has_field && (written_in_lanes<Formula::field, W> ||
                             ((separable || conformal) && written_in_lanes<Formula::force, W> &&
                              written_in_lanes<Formula::velocity, W>))) {
    field_of<Pack<W>>(t, z, rate);
  }

  /// The tape of the field.
  [[nodiscard]] std::shared_ptr<const Tape> field_tape() const requires has_field {
    return std::make_shared<const Tape>(
        record(extent, extent, [&](const Recorded& t, std::span<const Recorded> z, std::span<Recorded> rate) {
          field_of<Recorded>(t, z, rate);
        }));
  }
  /// The tape of the velocity.
  [[nodiscard]] std::shared_ptr<const Tape> velocity_tape() const requires separable {
    return std::make_shared<const Tape>(
        record(half, half, [&](const Recorded& t, std::span<const Recorded> p, std::span<Recorded> v) {
          velocity_of<Recorded>(t, p, v);
        }));
  }

  /// The rate nu in p' = -V_q - nu p.
  [[nodiscard]] T damping() const requires conformal { return T(Real(system_.damping())); }
  /// -dV/dq, friction left out.
  void undamped_force(const T& t, In<T> q, Out<T> f) const requires conformal { force_of<T>(t, q, f); }
  /// dT/dp.
  void undamped_velocity(const T& t, In<T> p, Out<T> v) const requires conformal { velocity_of<T>(t, p, v); }

  /// y = z: canonical coordinates are Darboux's.
  void chart(const T& /*t*/, In<T> z, Out<T> y) const requires canonical {
    std::copy(z.begin(), z.end(), y.begin());
  }
  void chart_inverse(const T& /*t*/, In<T> y, Out<T> z) const requires canonical {
    std::copy(y.begin(), y.end(), z.begin());
  }
  void chart_field(const T& t, In<T> y, Out<T> rate) const requires canonical { field_of<T>(t, y, rate); }
  void chart_field_jacobian(const T& t, In<T> y, Out<T> matrix) const requires canonical {
    field_jacobian(t, y, matrix);
  }
  [[nodiscard]] std::shared_ptr<const Tape> chart_field_tape() const requires canonical {
    return field_tape();
  }
  [[nodiscard]] BoundSeries chart_field_series() const requires canonical {
    if constexpr (detail::CompilesChartField<S>) return {&compiled_series<S>(), &system_};
    return {};
  }

 private:
  static constexpr int half = extent / 2;

  // The formulas with any scalar U: that of the states, or a dual or recording one.
  template <class U>
  U hamiltonian_of(const U& t, In<U> z) const {
    if constexpr (separable) {
      return system_.kinetic(t, z.subspan(half)) + system_.potential(t, z.first(half));
    } else {
      return system_.hamiltonian(t, z);
    }
  }
  template <class U>
  void force_of(const U& t, In<U> q, Out<U> f) const {
    if constexpr (detail::writes<S, Formula::force, U>) {
      system_.force(t, q, f);
    } else {
      detail::dual_gradient<half>([&]<class D>(const D& s, In<D> x) { return system_.potential(s, x); }, t, q,
                                  f);
      for (U& x : f) x = -x;
    }
  }
  template <class U>
  void velocity_of(const U& t, In<U> p, Out<U> v) const {
    if constexpr (detail::writes<S, Formula::velocity, U>) {
      system_.velocity(t, p, v);
    } else {
      detail::dual_gradient<half>([&]<class D>(const D& s, In<D> x) { return system_.kinetic(s, x); }, t, p,
                                  v);
    }
  }
  template <class U>
  void field_of(const U& t, In<U> z, Out<U> rate) const {
    if constexpr (detail::writes<S, Formula::field, U>) {
      system_.field(t, z, rate);
    } else if constexpr (separable || conformal) {
      velocity_of<U>(t, z.subspan(half), rate.first(half));
      force_of<U>(t, z.first(half), rate.subspan(half));
      if constexpr (conformal)
        for (std::size_t k = half; k < size(); ++k) rate[k] = rate[k] - U(Real(system_.damping())) * z[k];
    } else {  // J grad H
      Vector<U, extent> slope;
      detail::dual_gradient<extent>([&]<class D>(const D& s, In<D> x) { return hamiltonian_of<D>(s, x); }, t,
                                    z, slope);
      for (std::size_t k = 0; k < half; ++k) {
        rate[k] = slope[half + k];
        rate[half + k] = -slope[k];
      }
    }
  }

  S system_;
};

}  // namespace pfaff
