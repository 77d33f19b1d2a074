// Reference solutions to 30 digits: the closed form where a system has one, otherwise Taylor series in quad,
// whose remainder is measured at every step (core/tape/taylor_steps.hpp) and which are solved twice, by
// series of two orders with steps of their own. What both have in common is what is claimed.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/tape/taylor_expansion.hpp>

namespace pfaff {

/// The expansion in quad of the solutions of a model, of order 28.
class ReferenceExpansion : public TaylorExpansion<Quad> {
 public:
  explicit ReferenceExpansion(const Model& model);
  /// Writes to `z` the value of the Taylor polynomial at time `s` after the point of expansion.
  void evaluate(Quad s, Quad* z) const;
};

/// Thrown where a solution is asked for at a time to which it was not found. The message is one line, "the
/// solution was found up to t = ...", with the reason.
class SolutionEnds : public RunError {
 public:
  SolutionEnds(Quad t, const std::string& reason);
};

/// Moves `z` from time `t` along the flow of a model over `elapsed`, which may be negative, by Taylor steps
/// in quad. A step spends one of the budget of its thread (core/errors/budget.hpp), and at most a million are
/// taken. SolutionEnds where the solution leaves the domain of the formulas, where it blows up, and behind
/// the last step; BudgetSpent where the budget ends. Returns how many kinks of the field the motion meets.
std::int64_t taylor_flow(const Model& model, Quad t, Quad elapsed, std::vector<Quad>& z);

/// Whether a solution is found by two series, which show how many digits are right, or by one where it is a
/// path to look along, in half the time. Of one series no digit is shown: the kind is "0-digit".
enum class Certainty { by_two_series, not_shown };

/// The solution of an initial value problem at any time of an interval. A Taylor solution is computed and
/// kept by the constructor; the object is immutable afterwards, so that threads can share it.
class ReferenceSolution {
 public:
  /// Solves from `initial` at `t0` to t0 + `duration`, which goes back where it is negative, or to where the
  /// first of these is: the end of the domain of the formulas, a singularity, the time from which the two
  /// series agree in less than 20 digits, a million steps, 2^26 stored numbers (a gigabyte), the end of the
  /// budget of the thread, of which a step of either series spends one. BudgetSpent where that was asked to
  /// stop. A closed form is taken for it where the model has one that is finite at the end.
  ReferenceSolution(std::shared_ptr<const Model> model, Quad t0, std::vector<Quad> initial, Quad duration,
                    Certainty certainty = Certainty::by_two_series);

  /// Refuses (InputError) a closed form that is beyond doubt, from its value and its rate at the start, not
  /// the solution over such a duration: of a start on the constraints, for others a closed form need not
  /// hold.
  void check_closed_form(Quad duration) const;

  /// "exact" for a closed form; of Taylor series, in how many digits of each coordinate the two agree,
  /// "30-digit" at most and at the time where they agree least. A coordinate counts by the size of the
  /// numbers that its motion is made of.
  [[nodiscard]] std::string kind() const;
  /// Why the solution ends before it was asked to, with the time to which it was found, one line; empty where
  /// it does not.
  [[nodiscard]] const std::string& ended() const { return ended_; }
  /// True for the times from t0 on, in the direction of the duration, to which the solution was found; not t0
  /// alone.
  [[nodiscard]] bool covers(Quad t) const;
  /// The state at time t, which is t0 or lies in the direction of the duration. SolutionEnds where it does
  /// not cover t.
  [[nodiscard]] std::vector<Quad> at(Quad t) const;

 private:
  struct Piece {
    Quad begin;
    std::vector<Quad> coefficients;
  };
  void solve(Quad duration, Certainty certainty);
  // Whether the solution comes to time a before it comes to b.
  [[nodiscard]] bool precedes(Quad a, Quad b) const { return backwards_ ? b < a : a < b; }

  std::shared_ptr<const Model> model_;
  Quad t0_;
  std::vector<Quad> initial_;
  bool backwards_;
  bool exact_ = false;  // it is a closed form
  std::vector<Piece> pieces_;
  Quad end_;              // of the last piece
  Quad disagreement_{0};  // of the two series, relative; the largest
  std::string ended_;
};

}  // namespace pfaff
