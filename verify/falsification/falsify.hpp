// Searches random systems for one on which a claim fails, and shrinks it to the smallest of its kind.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pfaff/bench/studies/options.hpp>
#include <pfaff/verify/falsification/judgement.hpp>
#include <pfaff/verify/random_systems/recipe.hpp>

namespace pfaff {

/// A claim to be put to the test, whether the method makes it or not.
struct ClaimUnderTest {
  std::shared_ptr<const MethodInstance> method;
  Assignments parameters;  // those that were set
  Claim claim = Claim::none;
  /// True where the method makes the claim; it is then searched only on systems on which it makes it.
  bool made = true;
};

/// A system on which a claim fails.
struct Counterexample {
  Recipe recipe;
  PolynomialSystem system;  // of the recipe, without formulas that nobody asks for once it is shrunk
  JudgedStep at;
  Judgement judgement;
};

struct FalsificationResult {
  ClaimUnderTest test;
  int tried = 0;  // random systems in the scope of the claim
  std::optional<Counterexample> counterexample;
};

/// The claims of a method: all that it makes, or `claim` alone, made or not; with `parameters`, or where
/// these are empty with those that verification runs through and, for claims that it makes, two more sets
/// drawn by `seed`. InputError for parameters that do not fit.
std::vector<ClaimUnderTest> claims_under_test(const MethodPlugin& plugin, const Assignments& parameters,
                                              std::optional<Claim> claim, std::uint64_t seed = 1);

/// The same of a method that need not be registered and was made with the parameters; those that it makes
/// and, where that is asked for, `claim` if it does not make it.
std::vector<ClaimUnderTest> claims_under_test(const std::shared_ptr<const MethodInstance>& method,
                                              const Assignments& parameters, std::optional<Claim> claim,
                                              bool not_made_too = true);

/// The claim of that name; InputError with the nearest name, and for claims that have no check yet.
Claim claim_named(const std::string& name);

/// Tries one random system after the other on every claim, as long as the budget lasts. Each claim meets the
/// same sequence of systems whatever the budget, and what is found first is shrunk without regard to it, so
/// that a system found with a small budget is found with a larger one too.
std::vector<FalsificationResult> falsify(
    std::vector<ClaimUnderTest> tests, const FalsificationSettings& settings,
    const std::function<void(const std::string& what, double fraction)>& progress);

/// The smallest counterexample that is reached from this one by leaving out and simplifying.
Counterexample shrink(const ClaimUnderTest& test, Counterexample counterexample);

/// The name of a system on which the claim does not hold: rk4-not-symplectic.
std::string counterexample_name(const ClaimUnderTest& test);

/// The counterexample's system, of that name.
PolynomialSystem named_system(const ClaimUnderTest& test, const Counterexample& counterexample);

/// The command, beginning with the name of the method, that judges the claim on the counterexample's text
/// model in the working directory: "METHOD --claim C --system NAME.toml --step h ...".
std::string showing_arguments(const ClaimUnderTest& test, const Counterexample& counterexample);

/// The text as one word of a command, quoted where the shell would read anything else in it.
std::string shell_word(const std::string& text);

/// The counterexample as a text model, with the command that shows it in its opening comment.
std::string model_text_of(const ClaimUnderTest& test, const Counterexample& counterexample,
                          const std::string& command);

}  // namespace pfaff
