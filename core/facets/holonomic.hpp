// The constraints phi(q, t) = 0 of a canonical system with Hamiltonian H(q, p, t), as methods and
// formulations see them, for one scalar.
//
// PositionConstraints is what methods use that keep the constraints themselves: phi, the linear maps B =
// dphi/dq and its transpose, and solves with S = B H_pp B^T. HolonomicConstraints adds what formulations use,
// which make equations of motion in the phase space (nguyen-turski section 4): v = H_p, the hidden
// constraints phi~ = {phi, H} + phi_t, h = {phi~, H} + phi~_t, T = dphi~/dq and P = dphi~/dp = B H_pp, and
// friction. Every operation is batched: one virtual call, whatever the number of constraints. An operation
// that places something evaluates it at a point and keeps it for the operations that follow. S is factored in
// its own structure, which the pattern reports. The object owns its buffers; no operation allocates.
//
// What each operation owes is stated as identities in core/facets/conformance/constraint_identities.hpp, with
// which the author of an evaluator tests it.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string_view>

#include <pfaff/core/errors/status.hpp>
#include <pfaff/core/facets/constrained_rates.hpp>
#include <pfaff/core/facets/scalar_units.hpp>
#include <pfaff/core/linear/symmetric_pattern.hpp>
#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/core/tape/recorder.hpp>

namespace pfaff {

/// The constraints of positions, and what methods need to find momenta that keep them.
template <class T>
class PositionConstraints {
 public:
  PositionConstraints() = default;
  PositionConstraints(const PositionConstraints&) = delete;
  PositionConstraints& operator=(const PositionConstraints&) = delete;
  virtual ~PositionConstraints() = default;

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
  /// -H_q, applied forces added, n numbers; without friction and without constraint forces.
  virtual void force(const T& t, In<T> q, In<T> p, Out<T> f) = 0;

  /// Places B and the factors of S at (q, p, t); S depends on p only where H is not quadratic in it.
  virtual Status linearise(const T& t, In<T> q, In<T> p) = 0;
  /// r = B u.
  virtual void apply(In<T> u, Out<T> r) const = 0;
  /// f = B^T x.
  virtual void apply_transpose(In<T> x, Out<T> f) const = 0;
  /// S x = r, as last placed; x may be r.
  virtual void solve(In<T> r, Out<T> x) const = 0;
  /// Solves for two right-hand sides at once: while the recurrence of one waits, that of the other goes on.
  virtual void solve(In<T> r1, Out<T> x1, In<T> r2, Out<T> x2) const {
    solve(r1, x1);
    solve(r2, x2);
  }
  /// r = P u and v = P^T x with P = B H_pp, as last placed.
  virtual void hidden_by_momentum(In<T> u, Out<T> r) const = 0;
  virtual void hidden_by_momentum_transpose(In<T> x, Out<T> v) const = 0;
};

/// Along which vectors of the phase space (q, p) the reactions of holonomic constraints point, and what
/// determines their sizes.
enum class Reactions {
  ideal,        // (0, B^T x), d'Alembert's: phi~' = 0
  two_level,    // (P^T x, B^T y): phi' = 0 and phi~' = 0
  hamiltonian,  // along the Hamiltonian fields of phi and phi~, (P^T x, -T^T x - B^T y): phi' = phi~' = 0
  other         // anything else
};

constexpr std::string_view to_string(Reactions reactions) {
  constexpr std::array<std::string_view, 4> names{"ideal", "two-level", "hamiltonian", "other"};
  return names[static_cast<std::size_t>(reactions)];
}

/// The constraints in the phase space: what formulations need to make equations of motion.
template <class T>
class HolonomicConstraints : public PositionConstraints<T> {
 public:
  /// Places B and the factors of S as linearise does and, at the same (q, p, t), T and what the next five
  /// members return.
  virtual Status place(const T& t, In<T> q, In<T> p) = 0;
  [[nodiscard]] virtual std::span<const T> residuals() const = 0;  // phi
  [[nodiscard]] virtual std::span<const T> hidden() const = 0;     // phi~
  /// h = {phi~, H} + phi~_t + P Q: the rates of phi~ by all but reactions and friction.
  [[nodiscard]] virtual std::span<const T> hidden_rates() const = 0;
  [[nodiscard]] virtual std::span<const T> velocities() const = 0;  // H_p
  [[nodiscard]] virtual std::span<const T> forces() const = 0;      // -H_q, applied forces added
  /// r = T u and f = T^T x with T = dphi~/dq.
  virtual void hidden_by_position(In<T> u, Out<T> r) const = 0;
  virtual void hidden_by_position_transpose(In<T> x, Out<T> f) const = 0;

  /// The motion with one kind of reactions as one operation, offered by evaluators that need fewer passes for
  /// it than the operations above together; null from all others. The object lives as long as this one: ask
  /// for it once and use it at every step.
  [[nodiscard]] virtual ConstrainedRates<T>* rates(Reactions /*reactions*/) { return nullptr; }

  /// The coefficients lambda >= 0 of friction, one for each momentum, at the state last placed. Where the
  /// system has no friction it is empty, and so even before anything is placed.
  [[nodiscard]] virtual std::span<const T> friction() const = 0;
  /// Factors S^D = P diag(lambda) P^T at the state last placed. S^D may be singular where some lambda are
  /// zero; solve_friction then expects right-hand sides in its range.
  virtual Status factor_friction() = 0;
  virtual void solve_friction(In<T> r, Out<T> x) const = 0;

  /// As rates(Reactions::ideal), offered by evaluators that also tell how the motion responds to forces; null
  /// from all others.
  [[nodiscard]] virtual IdealRates<T>* ideal_rates() { return nullptr; }
};

template <class T>
using HolonomicPointer = std::unique_ptr<HolonomicConstraints<T>>;

/// Makes the constraints of one system for every scalar.
class HolonomicFactory : public Maker<HolonomicPointer, FormulaScalars> {};

/// The factory that calls source->template constraint_evaluator<T>() for each scalar.
template <class Source>
class HolonomicFactoryOf final : public detail::MakerInUnits<HolonomicFactoryOf<Source>, HolonomicFactory> {
 public:
  explicit HolonomicFactoryOf(std::shared_ptr<const Source> source) : source_(std::move(source)) {}
  template <class T>
  [[nodiscard]] HolonomicPointer<T> made() const {
    return source_->template constraint_evaluator<T>();
  }

 private:
  std::shared_ptr<const Source> source_;
};

}  // namespace pfaff
