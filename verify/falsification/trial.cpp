#include <pfaff/verify/falsification/trial.hpp>

#include <pfaff/runs/support/reference.hpp>
#include <pfaff/verify/check_budget.hpp>
#include <pfaff/verify/random_checks.hpp>

namespace pfaff {

std::shared_ptr<const Model> model_under_test(const ClaimUnderTest& test,
                                              const std::shared_ptr<const Model>& model) {
  return test.made ? model_claimed_on(*test.method, test.claim, model)
                   : model_in_scope(*test.method, test.claim, model);
}

namespace {

// The system judged at its initial state; nullopt where the claim holds or does not speak of it, where the
// motion ends before a method can follow it, and where the budget of a check is spent before that is known.
std::optional<Counterexample> judged(const ClaimUnderTest& test, const Recipe& recipe,
                                     PolynomialSystem system, const JudgedStep& at) {
  const auto model = model_under_test(test, model_of(system));
  if (model == nullptr) return std::nullopt;
  const JudgedStep here{model, system.initial, at.time, at.step, at.count};
  const Budget budget(limits_of_check);
  try {
    Judgement judgement = judge(*test.method, test.claim, here);
    if (!judgement.falsified) return std::nullopt;
    return Counterexample{recipe, std::move(system), here, std::move(judgement)};
  } catch (const BudgetSpent& spent) {
    if (spent.stopped()) throw;
    return std::nullopt;
  } catch (const SolutionEnds&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<Counterexample> counterexample_in(const ClaimUnderTest& test, const Recipe& recipe,
                                                const JudgedStep& at) {
  return judged(test, recipe, system_of(recipe), at);
}

Counterexample without_spare_formulas(const ClaimUnderTest& test, Counterexample counterexample) {
  using enum Formula;
  for (const std::vector<Formula>& spare :
       {std::vector{invariants}, {reversal}, {casimirs}, {alpha}, {chart, chart_inverse}}) {
    PolynomialSystem system = counterexample.system;
    std::size_t left_out = 0;
    for (const Formula formula : spare) left_out += system.formulas.erase(formula);
    if (left_out == 0) continue;
    if (!system.formulas.contains(invariants)) system.invariants.clear();
    if (!system.formulas.contains(chart)) system.chart_divisors.clear();
    if (auto less = judged(test, counterexample.recipe, std::move(system), counterexample.at))
      counterexample = std::move(*less);
  }
  for (std::size_t k = 0; k < counterexample.system.invariants.size();) {
    PolynomialSystem system = counterexample.system;
    const auto at = static_cast<std::ptrdiff_t>(k);
    system.invariants.erase(system.invariants.begin() + at);
    system.formulas[invariants].erase(system.formulas[invariants].begin() + at);
    if (system.invariants.empty()) break;
    if (auto less = judged(test, counterexample.recipe, std::move(system), counterexample.at)) {
      counterexample = std::move(*less);
    } else {
      ++k;
    }
  }
  return counterexample;
}

}  // namespace pfaff
