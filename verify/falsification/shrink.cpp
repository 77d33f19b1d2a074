// Shrinks counterexamples: of all that is simpler in one respect, the first that still is a counterexample
// takes its place, until nothing simpler is one.
#include <array>

#include <pfaff/verify/falsification/falsify.hpp>

#include <pfaff/verify/falsification/trial.hpp>

namespace pfaff {

namespace {

// A residual that can be seen in double, far above rounding.
constexpr double visible = 1e-10;
// A bound on the work: a recipe has at most some hundred simpler ones, and few of them are taken.
constexpr int most_trials = 3000;

// Values of the number of steps, of their length and of the time, simplest first.
constexpr std::array simple_counts{1, 2};
const std::vector<Real>& simple_steps() {
  static const std::vector<Real> steps{1, Real::fraction(1, 2), Real::fraction(1, 10)};
  return steps;
}
const std::vector<Real>& simple_times() {
  static const std::vector<Real> times{0, 1};
  return times;
}

}  // namespace

Counterexample shrink(const ClaimUnderTest& test, Counterexample counterexample) {
  int trials = 0;
  const bool seen = counterexample.judgement.in_double > visible;
  const auto accept = [&](const Recipe& recipe, const JudgedStep& at) {
    if (++trials > most_trials) return false;
    auto smaller = counterexample_in(test, recipe, at);
    if (!smaller || (seen && !(smaller->judgement.in_double > visible))) return false;
    counterexample = std::move(*smaller);
    return true;
  };
  const auto simplify_number = [&](const auto& values, auto JudgedStep::*number) {
    for (const auto& value : values) {
      if (counterexample.at.*number == value) return false;
      JudgedStep at = counterexample.at;
      at.*number = value;
      if (accept(counterexample.recipe, at)) return true;
    }
    return false;
  };
  bool changed = true;
  while (changed && trials <= most_trials) {
    changed = simplify_number(simple_counts, &JudgedStep::count);
    changed = simplify_number(simple_times(), &JudgedStep::time) || changed;
    changed = simplify_number(simple_steps(), &JudgedStep::step) || changed;
    // After a success the list is made anew and gone on with where it was, since what failed before mostly
    // fails again; the next round tries that.
    std::vector<Recipe> list = simpler(counterexample.recipe);
    for (std::size_t k = 0; k < list.size();) {
      if (accept(list[k], counterexample.at)) {
        changed = true;
        list = simpler(counterexample.recipe);
      } else {
        ++k;
      }
    }
  }
  return without_spare_formulas(test, std::move(counterexample));
}

}  // namespace pfaff
