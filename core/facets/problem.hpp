// Problem: a model as a method sees it, for one scalar and one size.
//
// A problem owns the evaluators and their buffers, so each stepper has its own; the model behind it is
// shared. Its members exist facet by facet, which is what the concepts at the end, the registry's search for
// a method's needs and the erased path all rest on. A facet evaluation costs one virtual call.
#pragma once

#include <concepts>
#include <cstdint>
#include <memory>

#include <pfaff/core/facets/compiled_series.hpp>
#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/linear/vector.hpp>
#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// The author's compiled formula or program where there is one, else a replay of the tape.
/// Instantiated for double, Quad and the duals over them that step Jacobians use.
template <class T>
Evaluator<T> make_evaluator(const std::shared_ptr<const Model>& model, Formula formula);

/// The work a method has done. Counted outside the static path.
struct Counters {
  std::int64_t steps = 0;
  std::int64_t fields = 0;  // right-hand sides (one of a separable system: a force)
  std::int64_t jacobians = 0;
  std::int64_t iterations = 0;      // of implicit solves
  std::int64_t factorisations = 0;  // of matrices
};

/// A model seen through the facets `Facets`, with states of T and N components.
template <class T, int N = dynamic, FacetSet Facets = FacetSet::all()>
class Problem {
 public:
  using Scalar = T;
  using State = Vector<T, N>;
  static constexpr int extent = N;

  explicit Problem(std::shared_ptr<const Model> model)
      : model_(std::move(model)), size_(static_cast<std::size_t>(model_->dimension())) {}

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] State make_state() const { return State(size_); }
  [[nodiscard]] Counters& counters() const { return counters_; }
  [[nodiscard]] const std::shared_ptr<const Model>& model() const { return model_; }

  /// Makes an evaluator before the first step, so that no step allocates. Kept out of line, and out of every
  /// use.
  [[gnu::noinline]] void prepare(Formula formula) const {
    evaluators_[index(formula)] = make_evaluator<T>(model_, formula);
  }

  /// rate = X(z, t).
  void field(const T& t, In<T> z, Out<T> rate) const requires(Facets.has(Facet::vector_field)) {
    ++counters_.fields;
    use(Formula::field, t, z.data(), rate.data());
  }
  /// matrix[i n + j] = dX_i / dz_j.
  void field_jacobian(const T& t, In<T> z, Out<T> matrix) const requires(Facets.has(Facet::vector_field)) {
    ++counters_.jacobians;
    use(Formula::field_jacobian, t, z.data(), matrix.data());
  }
  /// H(z, t).
  [[nodiscard]] T hamiltonian(const T& t, In<T> z) const requires(Facets.has(Facet::hamiltonian)) {
    T value;
    use(Formula::hamiltonian, t, z.data(), &value);
    return value;
  }
  /// The Poisson tensor Pi(z, t), row-major, with X = Pi grad H.
  void poisson_tensor(const T& t, In<T> z, Out<T> matrix) const requires(Facets.has(Facet::hamiltonian)) {
    use(Formula::poisson_tensor, t, z.data(), matrix.data());
  }
  /// -dV/dq.
  void force(const T& t, In<T> q, Out<T> f) const requires(Facets.has(Facet::separable)) {
    ++counters_.fields;
    use(Formula::force, t, q.data(), f.data());
  }
  /// dT/dp.
  void velocity(const T& t, In<T> p, Out<T> v) const requires(Facets.has(Facet::separable)) {
    use(Formula::velocity, t, p.data(), v.data());
  }
  /// The rate nu in p' = -V_q - nu p.
  [[nodiscard]] T damping() const requires(Facets.has(Facet::conformal)) { return T(model_->damping()); }
  /// -dV/dq, friction left out.
  void undamped_force(const T& t, In<T> q, Out<T> f) const requires(Facets.has(Facet::conformal)) {
    ++counters_.fields;
    use(Formula::force, t, q.data(), f.data());
  }
  /// dT/dp.
  void undamped_velocity(const T& t, In<T> p, Out<T> v) const requires(Facets.has(Facet::conformal)) {
    use(Formula::velocity, t, p.data(), v.data());
  }
  /// B(z, t).
  [[nodiscard]] T birkhoffian(const T& t, In<T> z) const requires(Facets.has(Facet::birkhoffian)) {
    T value;
    use(Formula::birkhoffian, t, z.data(), &value);
    return value;
  }
  /// F(z, t).
  void one_form(const T& t, In<T> z, Out<T> f) const requires(Facets.has(Facet::birkhoffian)) {
    use(Formula::one_form, t, z.data(), f.data());
  }
  /// K(z, t), row-major. Constant and canonical, -J, for canonical systems.
  void structure(const T& t, In<T> z, Out<T> matrix) const
      requires(Facets.has(Facet::structure) || Facets.has(Facet::darboux_chart)) {
    use(Formula::structure, t, z.data(), matrix.data());
  }
  /// D(z, t) of K zdot + D = 0.
  void covector(const T& t, In<T> z, Out<T> d) const requires(Facets.has(Facet::structure)) {
    use(Formula::covector, t, z.data(), d.data());
  }
  /// y = chart(t, z), the structure there being constant: K_c = [[0, -I], [I, 0]].
  void chart(const T& t, In<T> z, Out<T> y) const requires(Facets.has(Facet::darboux_chart)) {
    use(Formula::chart, t, z.data(), y.data());
  }
  /// z = chart_inverse(t, y).
  void chart_inverse(const T& t, In<T> y, Out<T> z) const requires(Facets.has(Facet::darboux_chart)) {
    use(Formula::chart_inverse, t, y.data(), z.data());
  }
  /// dy/dt = Y(y, t).
  void chart_field(const T& t, In<T> y, Out<T> rate) const requires(Facets.has(Facet::darboux_chart)) {
    ++counters_.fields;
    use(Formula::chart_field, t, y.data(), rate.data());
  }
  /// matrix[i n + j] = dY_i / dy_j.
  void chart_field_jacobian(const T& t, In<T> y, Out<T> matrix) const
      requires(Facets.has(Facet::darboux_chart)) {
    ++counters_.jacobians;
    use(Formula::chart_field_jacobian, t, y.data(), matrix.data());
  }
  /// The tape of Y, for methods that expand it in series.
  [[nodiscard]] std::shared_ptr<const Tape> chart_field_tape() const
      requires(Facets.has(Facet::darboux_chart)) {
    return model_->tape(Formula::chart_field);
  }
  /// Y compiled for series, where its author wrote it.
  [[nodiscard]] BoundSeries chart_field_series() const requires(Facets.has(Facet::darboux_chart)) {
    return {model_->chart_field_series(), model_->system()};
  }
  /// The tapes of X and of alpha (generating_map.hpp), for methods that expand them in series.
  [[nodiscard]] std::shared_ptr<const Tape> field_tape() const requires(Facets.has(Facet::vector_field)) {
    return model_->tape(Formula::field);
  }
  [[nodiscard]] std::shared_ptr<const Tape> alpha_tape() const requires(Facets.has(Facet::generating_map)) {
    return model_->tape(Formula::alpha);
  }
  /// The constraints phi(q, t) = 0, with buffers of their own.
  [[nodiscard]] HolonomicConstraints<T>& holonomic() const requires(Facets.has(Facet::holonomic)) {
    if (holonomic_ == nullptr) [[unlikely]]
      holonomic_ = model_->holonomic_constraints<T>();
    return *holonomic_;
  }
  /// Values of the named invariants, in the model's order.
  void invariants(const T& t, In<T> z, Out<T> values) const requires(Facets.has(Facet::invariants)) {
    use(Formula::invariants, t, z.data(), values.data());
  }
  /// State after `elapsed` from z0 at t0: initial = (z0, t0), n + 1 numbers.
  void exact_solution(const T& elapsed, In<T> initial, Out<T> z) const
      requires(Facets.has(Facet::exact_solution)) {
    use(Formula::exact_solution, elapsed, initial.data(), z.data());
  }

 private:
  void use(Formula formula, const T& t, const T* arguments, T* results) const {
    const Evaluator<T>& evaluator = evaluators_[index(formula)];
    if (evaluator.call == nullptr) [[unlikely]]
      prepare(formula);
    evaluator.call(evaluator.context, t, arguments, results);
  }

  std::shared_ptr<const Model> model_;
  std::size_t size_;
  mutable std::array<Evaluator<T>, formula_count> evaluators_;
  mutable std::shared_ptr<HolonomicConstraints<T>> holonomic_;
  mutable Counters counters_;
};

/// The scalar and the state of a problem type.
template <class P>
using Scalar = typename P::Scalar;
template <class P>
using State = typename P::State;

// What a method may ask of a problem. P may be a Problem, a StaticProblem, or anything with these members.
template <class P>
concept HasVectorField = requires(const P& p, const Scalar<P>& t, State<P>& z) {
  p.field(t, z, z);
};
template <class P>
concept HasFieldJacobian = requires(const P& p, const Scalar<P>& t, State<P>& z) {
  p.field_jacobian(t, z, z);
};
template <class P>
concept HasSeparable = requires(const P& p, const Scalar<P>& t, State<P>& z) {
  p.force(t, z, z);
  p.velocity(t, z, z);
};
template <class P>
concept HasConformal = requires(const P& p, const Scalar<P>& t, State<P>& z) {
  p.undamped_force(t, z, z);
  p.undamped_velocity(t, z, z);
  { p.damping() } -> std::convertible_to<Scalar<P>>;
};
template <class P>
concept HasDarbouxChart = requires(const P& p, const Scalar<P>& t, State<P>& z) {
  p.chart(t, z, z);
  p.chart_inverse(t, z, z);
  p.chart_field(t, z, z);
  p.chart_field_tape();
};

template <class P>
concept HasHolonomic = requires(const P& p) {
  p.holonomic();
};

template <class P>
concept HasGeneratingMap = HasFieldJacobian<P> && requires(const P& p) {
  p.field_tape();
  p.alpha_tape();
};

}  // namespace pfaff
