// HolonomicConstraints: the constraints phi(q, t) = 0 of a canonical system with Hamiltonian H(q, p, t), as
// methods and formulations see them, for one scalar.
//
// Position level, for methods that keep the constraints themselves: phi, the linear maps B = dphi/dq and its
// transpose, and solves with S = B H_pp B^T. Phase space, for formulations (nguyen-turski section 4): also
// v = H_p, the hidden constraints phi~ = {phi, H}, h = {phi~, H}, T = dphi~/dq and P = dphi~/dp = B H_pp.
// Every operation is batched: one virtual call, whatever the number of constraints. S is factored in its own
// structure, which the pattern reports. The object owns its buffers; no operation allocates.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include <pfaff/core/facets/scalars.hpp>
#include <pfaff/core/linear/symmetric_pattern.hpp>
#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/core/solve/status.hpp>
#include <pfaff/core/tape/recorder.hpp>

namespace pfaff {

template <class T>
class HolonomicConstraints {
 public:
  HolonomicConstraints() = default;
  HolonomicConstraints(const HolonomicConstraints&) = delete;
  HolonomicConstraints& operator=(const HolonomicConstraints&) = delete;
  virtual ~HolonomicConstraints() = default;

  /// The number of constraints, K, and of positions, n; momenta are as many.
  [[nodiscard]] virtual std::size_t count() const = 0;
  [[nodiscard]] virtual std::size_t degrees() const = 0;
  /// Where S has entries, and its structure.
  [[nodiscard]] virtual const SymmetricPattern& pattern() const = 0;

  /// phi(q, t), K numbers.
  virtual void values(const T& t, In<T> q, Out<T> phi) = 0;
  /// phi~(q, p, t) = {phi, H} + phi_t, K numbers.
  virtual void hidden_values(const T& t, In<T> q, In<T> p, Out<T> hidden) = 0;
  /// H_p, n numbers.
  virtual void velocity(const T& t, In<T> q, In<T> p, Out<T> v) = 0;
  /// -H_q, n numbers; without friction and without constraint forces.
  virtual void force(const T& t, In<T> q, In<T> p, Out<T> f) = 0;

  /// Places B and the factors of S at (q, p, t); S depends on p only where H is not quadratic in it.
  virtual Status linearise(const T& t, In<T> q, In<T> p) = 0;
  /// r = B u.
  virtual void apply(In<T> u, Out<T> r) const = 0;
  /// f = B^T x.
  virtual void apply_transpose(In<T> x, Out<T> f) const = 0;
  /// S x = r, as last placed; x may be r.
  virtual void solve(In<T> r, Out<T> x) const = 0;
  /// Two of them at once, which hides the latency of recurrences.
  virtual void solve(In<T> r1, Out<T> x1, In<T> r2, Out<T> x2) const {
    solve(r1, x1);
    solve(r2, x2);
  }
  /// r = P u and v = P^T x with P = B H_pp, as last placed.
  virtual void hidden_by_momentum(In<T> u, Out<T> r) const = 0;
  virtual void hidden_by_momentum_transpose(In<T> x, Out<T> v) const = 0;

  /// Places all of that and, at (q, p, t), what the next five return and T.
  virtual Status place(const T& t, In<T> q, In<T> p) = 0;
  [[nodiscard]] virtual std::span<const T> residuals() const = 0;     // phi
  [[nodiscard]] virtual std::span<const T> hidden() const = 0;        // phi~
  [[nodiscard]] virtual std::span<const T> hidden_rates() const = 0;  // h = {phi~, H} + phi~_t
  [[nodiscard]] virtual std::span<const T> velocities() const = 0;    // H_p
  [[nodiscard]] virtual std::span<const T> forces() const = 0;        // -H_q
  /// r = T u and f = T^T x with T = dphi~/dq.
  virtual void hidden_by_position(In<T> u, Out<T> r) const = 0;
  virtual void hidden_by_position_transpose(In<T> x, Out<T> f) const = 0;

  /// Without friction, the rates of Dirac's formulation, nguyen-turski (4.2), or of Lagrange's multipliers,
  /// (A.5), for systems that have them in fewer passes than the operations above make; nullopt, with nothing
  /// written, from those that have not.
  virtual std::optional<Status> dirac_rates(const T& /*t*/, In<T> /*q*/, In<T> /*p*/, Out<T> /*q_rate*/,
                                            Out<T> /*p_rate*/) {
    return std::nullopt;
  }
  virtual std::optional<Status> multiplier_rates(const T& /*t*/, In<T> /*q*/, In<T> /*p*/, Out<T> /*q_rate*/,
                                                 Out<T> /*p_rate*/) {
    return std::nullopt;
  }

  /// The coefficients lambda >= 0 of friction, one for each momentum, at the state last placed; empty where
  /// there is none.
  [[nodiscard]] virtual std::span<const T> friction() const = 0;
  /// Factors S^D = P diag(lambda) P^T at the state last placed. It is singular where beads are without
  /// friction; solves are then on its range.
  virtual Status factor_friction() = 0;
  virtual void solve_friction(In<T> r, Out<T> x) const = 0;
};

/// Makes the constraints of one system for every scalar.
class HolonomicFactory {
 public:
  virtual ~HolonomicFactory() = default;
  [[nodiscard]] virtual std::unique_ptr<HolonomicConstraints<double>> make(double) const = 0;
  [[nodiscard]] virtual std::unique_ptr<HolonomicConstraints<Quad>> make(Quad) const = 0;
  [[nodiscard]] virtual std::unique_ptr<HolonomicConstraints<StepDual<double>>> make(
      StepDual<double>) const = 0;
  [[nodiscard]] virtual std::unique_ptr<HolonomicConstraints<StepDual<Quad>>> make(StepDual<Quad>) const = 0;
  [[nodiscard]] virtual std::unique_ptr<HolonomicConstraints<Recorded>> make(Recorded) const = 0;
};

/// The factory that calls source->template constraint_evaluator<T>() for each scalar.
template <class Source>
class HolonomicFactoryOf final : public HolonomicFactory {
 public:
  explicit HolonomicFactoryOf(std::shared_ptr<const Source> source) : source_(std::move(source)) {}
  [[nodiscard]] std::unique_ptr<HolonomicConstraints<double>> make(double /*scalar*/) const override {
    return source_->template constraint_evaluator<double>();
  }
  [[nodiscard]] std::unique_ptr<HolonomicConstraints<Quad>> make(Quad /*scalar*/) const override {
    return source_->template constraint_evaluator<Quad>();
  }
  [[nodiscard]] std::unique_ptr<HolonomicConstraints<StepDual<double>>> make(
      StepDual<double> /*scalar*/) const override {
    return source_->template constraint_evaluator<StepDual<double>>();
  }
  [[nodiscard]] std::unique_ptr<HolonomicConstraints<StepDual<Quad>>> make(
      StepDual<Quad> /*scalar*/) const override {
    return source_->template constraint_evaluator<StepDual<Quad>>();
  }
  [[nodiscard]] std::unique_ptr<HolonomicConstraints<Recorded>> make(Recorded /*scalar*/) const override {
    return source_->template constraint_evaluator<Recorded>();
  }

 private:
  std::shared_ptr<const Source> source_;
};

}  // namespace pfaff
