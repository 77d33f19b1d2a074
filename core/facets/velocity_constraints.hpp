// The constraints A(q, t) v + b(q, t) = 0 of the velocities v = H_p of a canonical system with Hamiltonian
// H(q, p, t), as methods and formulations see them, for one scalar.
//
// They are written psi(q, p, t) = A v + b. Where the system has holonomic constraints phi(q, t) = 0 as well,
// these stand first, at the level of velocities: their rows of A are dphi/dq, and their b is phi_t.
// Constraint forces are A^T x (d'Alembert). With P = dpsi/dp = A H_pp, the matrix S = P A^T is that of A
// M^-1 A^T for a kinetic energy with the mass matrix M; it is factored in its own structure, which the
// pattern reports.
//
// Every operation is batched: one virtual call, whatever the number of constraints. An operation that places
// something evaluates it at a point and keeps it for the operations that follow. The object owns its buffers;
// no operation allocates.
#pragma once

#include <memory>
#include <span>

#include <pfaff/core/errors/status.hpp>
#include <pfaff/core/facets/constrained_rates.hpp>
#include <pfaff/core/facets/scalars.hpp>
#include <pfaff/core/linear/symmetric_pattern.hpp>
#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

template <class T>
class VelocityConstraints {
 public:
  VelocityConstraints() = default;
  VelocityConstraints(const VelocityConstraints&) = delete;
  VelocityConstraints& operator=(const VelocityConstraints&) = delete;
  virtual ~VelocityConstraints() = default;

  /// The number of constraints, K, and of positions, n; momenta are as many.
  [[nodiscard]] virtual std::size_t count() const = 0;
  [[nodiscard]] virtual std::size_t degrees() const = 0;
  /// Where S has entries, and its structure.
  [[nodiscard]] virtual const SymmetricPattern& pattern() const = 0;

  /// psi(q, p, t) = A v + b, K numbers.
  virtual void values(const T& t, In<T> q, In<T> p, Out<T> psi) = 0;
  /// H_p, n numbers.
  virtual void velocity(const T& t, In<T> q, In<T> p, Out<T> v) = 0;
  /// -H_q, applied forces added, n numbers; without constraint forces.
  virtual void force(const T& t, In<T> q, In<T> p, Out<T> f) = 0;

  /// Places A, P and the factors of S at (q, p, t); P and S depend on p only where H is not quadratic in it.
  virtual Status linearise(const T& t, In<T> q, In<T> p) = 0;
  /// r = A u and f = A^T x, as last placed.
  virtual void apply(In<T> u, Out<T> r) const = 0;
  virtual void apply_transpose(In<T> x, Out<T> f) const = 0;
  /// S x = r, as last placed; x may be r.
  virtual void solve(In<T> r, Out<T> x) const = 0;
  /// r = P u and v = P^T x with P = A H_pp, as last placed.
  virtual void by_momentum(In<T> u, Out<T> r) const = 0;
  virtual void by_momentum_transpose(In<T> x, Out<T> v) const = 0;

  /// Places what linearise does and, at the same (q, p, t), what the next four members return.
  virtual Status place(const T& t, In<T> q, In<T> p) = 0;
  [[nodiscard]] virtual std::span<const T> residuals() const = 0;  // psi
  /// {psi, H} + psi_t + P Q: the rates of psi by all but reactions.
  [[nodiscard]] virtual std::span<const T> rates() const = 0;
  [[nodiscard]] virtual std::span<const T> velocities() const = 0;  // H_p
  [[nodiscard]] virtual std::span<const T> forces() const = 0;      // -H_q, applied forces added

  /// The motion with ideal reactions, q' = v and p' = -H_q - A^T x with psi' = 0, as one operation, offered
  /// by evaluators that need fewer passes for it than the operations above together; null from all others.
  /// The object lives as long as this one: ask for it once and use it at every step.
  [[nodiscard]] virtual ConstrainedRates<T>* ideal_rates() { return nullptr; }
};

template <class T>
using VelocityPointer = std::unique_ptr<VelocityConstraints<T>>;

/// Makes the velocity constraints of one system for every scalar.
class VelocityFactory : public Maker<VelocityPointer, FormulaScalars> {};

}  // namespace pfaff
