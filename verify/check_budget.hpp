// What a check may cost. A motion that blows up, or a method that takes smaller and smaller steps, would keep
// a check busy for ever. A check that has used up its budget has seen neither that a claim holds nor that it
// does not: it is not judged, and says so.
#pragma once

#include <pfaff/core/errors/budget.hpp>
#include <pfaff/runs/support/reference.hpp>
#include <pfaff/verify/check.hpp>

namespace pfaff {

/// Five times what the longest check of a plug-in of the tree takes but for those of the rounding in long
/// runs.
inline constexpr BudgetLimits limits_of_check{.steps = 400'000, .evaluations = 20'000'000};
/// The same of the rounding in long runs: two ensembles of half a million steps.
inline constexpr BudgetLimits limits_of_long_runs{.steps = 10'000'000, .evaluations = 1'000'000'000};

/// Moves `z` from time `t` along the flow of a model over `elapsed`, at most a few of the system's own times,
/// by Taylor steps in quad, some tens of them. SolutionEnds also where two thousand do not do it: towards a
/// singularity they become smaller and smaller. Returns how many kinks of the field the motion meets.
std::int64_t short_flow(const Model& model, const Quad& t, const Quad& elapsed, std::vector<Quad>& z);

/// The check, whose names are filled in, as one that was not judged because its budget was spent. Passes the
/// exception on where the work was asked to stop.
Check not_judged(Check check, const BudgetSpent& spent);
/// The same where the solution that it compares with ends before it is needed.
Check not_judged(Check check, const SolutionEnds& ends);

/// The same for any other reason, such as errors that round-off hides.
Check not_judged(Check check, const std::string& why);

/// A check of a method on a system that is wrong, which says nothing of the method.
Check not_judged_on_wrong(Check check, const std::string& system);

/// Why a claim about the size or the order of errors is not judged across a kink of the field.
inline constexpr const char* across_a_kink =
    "the motion meets a kink of the field, behind which errors are not those of a smooth motion";

/// True where a check was not judged, for whatever reason.
bool unjudged(const Check& check);

/// Returns judge(), a check, perhaps one or several; where it runs out of its budget, or of the solution that
/// it compares with, `check`, whose names are filled in, not judged.
template <class Judge>
auto within_budget(const Check& check, Judge&& judge, const BudgetLimits& limits = limits_of_check)
    -> decltype(judge()) {
  const Budget budget(limits);
  try {
    return judge();
  } catch (const BudgetSpent& spent) {
    return {not_judged(check, spent)};
  } catch (const SolutionEnds& ends) {
    return {not_judged(check, ends)};
  }
}

}  // namespace pfaff
