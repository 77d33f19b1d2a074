// Errors of states against the solution of their problem.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/runs/support/reference.hpp>

namespace pfaff {

/// Compares states of a run in the scalar T with a solution, which must outlive it.
template <class T>
class SolutionErrors {
 public:
  SolutionErrors(const std::shared_ptr<const Model>& model, const ReferenceSolution& solution);

  [[nodiscard]] const ReferenceSolution& solution() const { return solution_; }
  /// Compares a state with that of the solution at the same time, which is without rounding: n steps lead to
  /// t0 + n h, and the solution moves on in half a unit in the last place of t. The distance of the two over
  /// the size of the solution.
  Quad operator()(const Quad& exact_time, std::span<const T> state);
  /// Which invariants change along motions: what is conserved has its drift for an error.
  [[nodiscard]] const std::vector<std::size_t>& changing() const { return changing_; }
  /// Of these, by how much `invariants`, those of the state that was compared last, are off.
  [[nodiscard]] std::vector<Quad> of_invariants(std::span<const T> invariants);

 private:
  const ReferenceSolution& solution_;
  std::vector<std::size_t> changing_;
  std::optional<Problem<Quad>> problem_;  // where some change
  Quad time_{0};
  std::vector<Quad> exact_;  // the solution at that time
};

extern template class SolutionErrors<double>;
extern template class SolutionErrors<Quad>;

}  // namespace pfaff
