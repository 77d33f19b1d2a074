// Reference solutions to 30 digits and more: the closed form where a system has one, otherwise Taylor series
// in quad.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/tape/taylor_expansion.hpp>

namespace pfaff {

/// The expansion in quad of the solutions of a model, of order 28, with a step for which the last terms are
/// below round-off.
class ReferenceExpansion : public TaylorExpansion<Quad> {
 public:
  explicit ReferenceExpansion(const Model& model);
  /// The largest step for which the truncated series is accurate to round-off, whatever the unit of time; 1
  /// where the last terms are zero.
  [[nodiscard]] Quad safe_step() const;
  /// Writes to `z` the value of the Taylor polynomial at time `s` after the point of expansion.
  void evaluate(Quad s, Quad* z) const;
};

/// Moves `z` from time `t` along the flow of a model over `elapsed`, which may be negative, by Taylor steps
/// in quad.
void taylor_flow(const Model& model, Quad t, Quad elapsed, std::vector<Quad>& z);

/// The solution of an initial value problem at any time of an interval. A Taylor solution is computed and
/// kept by the constructor; the object is immutable afterwards, so that threads can share it.
class ReferenceSolution {
 public:
  /// Solves from `initial` at `t0` to t0 + `duration` (> 0). Where the solution leaves the domain of the
  /// formulas before that, the series ends there.
  ReferenceSolution(std::shared_ptr<const Model> model, Quad t0, std::vector<Quad> initial, Quad duration);

  /// "exact" for a closed form, "30-digit" for the Taylor series.
  [[nodiscard]] std::string_view kind() const { return problem_ != nullptr ? "exact" : "30-digit"; }
  /// The state at time t, not before t0.
  [[nodiscard]] std::vector<Quad> at(Quad t) const;

 private:
  struct Piece {
    Quad begin;
    std::vector<Quad> coefficients;
  };
  std::shared_ptr<const Model> model_;
  Quad t0_;
  std::vector<Quad> initial_;
  std::shared_ptr<const Problem<Quad>> problem_;  // closed form only
  std::vector<Piece> pieces_;
};

}  // namespace pfaff
