// Problem: a model as a method sees it, for one scalar and one size.
//
// A problem owns the evaluators and their buffers, so each stepper has its own; the model behind it is
// shared. A member exists only where the problem offers its facet: by this the concepts at the end tell what
// a problem offers, and needs_of (core/integrator.hpp) what a method needs. A facet evaluation costs one
// indirect call.
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
/// Instantiated for StepScalars.
template <class T>
Evaluator<T> make_evaluator(const std::shared_ptr<const Model>& model, Formula formula);

/// The formula at W points side by side: the author's code for packs, or a replay with them. Without a call
/// where there is neither. Instantiated for W = 4 and 8, and for 32, for which tapes alone are replayed: code
/// that is compiled has no jumps for so many lanes to share.
template <int W>
Evaluator<Pack<W>> make_evaluator_in_lanes(const std::shared_ptr<const Model>& model, Formula formula);

/// InputError for a formula of facets that a model has and does not offer for its motion, as the force of a
/// system that has constraints.
void require_offered(const Model& model, Formula formula);

/// The work a method has done. StaticProblem, made for speed, does not count it.
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

  /// Makes an evaluator before the first step, so that no step allocates. Not inlined, so that this code,
  /// which runs once, does not swell every place that evaluates a formula. InputError for a formula that
  /// speaks of another motion than the model's: a step whose signature names a weaker concept than what it
  /// calls would move without constraints, friction or applied forces.
  [[gnu::noinline]] void prepare(Formula formula) const {
    require_offered(*model_, formula);
    evaluators_[index(formula)] = make_evaluator<T>(model_, formula);
  }

  /// The formula at W points side by side, one in each lane, with the bits that it has at each of them alone.
  /// Without a call where it has to be evaluated at one after the other. Evaluations are the caller's to
  /// count.
  template <int W>
  [[nodiscard]] Evaluator<Pack<W>> in_lanes(Formula formula) const requires std::is_same_v<T, double> {
    return make_evaluator_in_lanes<W>(model_, formula);
  }

  // One member for every formula that a facet offers, with the signature and the meaning of its row. Derived
  // formulas and those recorded from a bracket have the signature void name(t, z, out).
#define PFAFF_FORMULA(name, result, signature, call, ...)                                       \
  result name signature const requires(Facets.meets(row_of(Formula::name).traits.offered_by)) { \
    return evaluated<Formula::name> call;                                                       \
  }
#define PFAFF_DERIVED(name, ...)                                              \
  void name(const T& t, In<T> z, Out<T> out)                                  \
      const requires(Facets.meets(row_of(Formula::name).traits.offered_by)) { \
    evaluated<Formula::name>(t, z, out);                                      \
  }
#define PFAFF_BRACKET(name, ...) PFAFF_DERIVED(name)
#include <pfaff/core/facets/formula_rows.hpp>

  // What a facet offers beside its formulas.

  /// The rate nu in p' = -V_q - nu p.
  [[nodiscard]] T damping() const requires(Facets.has(Facet::conformal)) { return T(model_->damping()); }
  /// -dV/dq, friction left out.
  void undamped_force(const T& t, In<T> q, Out<T> f) const requires(Facets.has(Facet::conformal)) {
    evaluated<Formula::force>(t, q, f);
  }
  /// dT/dp.
  void undamped_velocity(const T& t, In<T> p, Out<T> v) const requires(Facets.has(Facet::conformal)) {
    evaluated<Formula::velocity>(t, p, v);
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
  /// All constraints at the level of velocities, A v + b = 0, with buffers of their own.
  [[nodiscard]] VelocityConstraints<T>& nonholonomic() const
      requires(Facets.has(Facet::velocity_constraints)) {
    if (velocity_ == nullptr) [[unlikely]]
      velocity_ = model_->velocity_constraints<T>();
    return *velocity_;
  }
  /// The parts of the field, and the one to be treated as the perturbation: the small part where the author
  /// names one, else the last.
  [[nodiscard]] std::size_t parts() const requires(Facets.has(Facet::exact_flows)) {
    return model_->part_names().size();
  }
  [[nodiscard]] std::size_t perturbation() const requires(Facets.has(Facet::exact_flows)) {
    return model_->small_part().value_or(parts() - 1);
  }
  /// change = phi_h(z) - z for the flow of a part (exact_flows.hpp). That of the perturbation counts as a
  /// right-hand side.
  Status part_flow(std::size_t part, const T& h, In<T> z, Out<T> change) const
      requires(Facets.has(Facet::exact_flows)) {
    if (flows_ == nullptr) [[unlikely]] {
      flows_ = model_->template exact_flows<T>();
      counted_ = perturbation();
    }
    if (part == counted_) ++counters_.fields;
    return flows_->change(part, h, z, change);
  }
  /// State after `elapsed` from z0 at t0: initial = (z0, t0), n + 1 numbers.
  void exact_solution(const T& elapsed, In<T> initial, Out<T> z) const
      requires(Facets.has(Facet::exact_solution)) {
    evaluated<Formula::exact_solution>(elapsed, initial, z);
  }

 private:
  template <Formula F>
  void evaluated(const T& t, In<T> x, Out<T> out) const {
    count<F>();
    use(F, t, x.data(), out.data());
  }
  template <Formula F>
  [[nodiscard]] T evaluated(const T& t, In<T> x) const {
    count<F>();
    T value;
    use(F, t, x.data(), &value);
    return value;
  }
  template <Formula F>
  void count() const {
    constexpr Counts counts = row_of(F).traits.counts;
    if constexpr (counts == Counts::field) ++counters_.fields;
    if constexpr (counts == Counts::jacobian) ++counters_.jacobians;
  }
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
  mutable std::shared_ptr<VelocityConstraints<T>> velocity_;
  mutable std::shared_ptr<ExactFlows<T>> flows_;
  mutable std::size_t counted_ = 0;  // the part whose flow counts as a right-hand side
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
concept HasVelocityConstraints = requires(const P& p, const Scalar<P>& t, State<P>& z) {
  p.velocity_constraints(t, z, z);
  p.velocity_offsets(t, z, z);
  p.nonholonomic();
};

template <class P>
concept HasExactFlows = requires(const P& p, const Scalar<P>& h, State<P>& z) {
  p.parts();
  p.perturbation();
  { p.part_flow(std::size_t{0}, h, z, z) } -> std::same_as<Status>;
};

template <class P>
concept HasGeneratingMap = HasFieldJacobian<P> && requires(const P& p) {
  p.field_tape();
  p.alpha_tape();
};

}  // namespace pfaff
