// Counterexamples as text: the model and the command that shows it.
#include <pfaff/core/numbers/formatted.hpp>
#include <pfaff/runs/asked_for.hpp>
#include <pfaff/verify/falsification/falsify.hpp>

namespace pfaff {

namespace {

std::string short_number(double x) { return formatted("%.3g", x); }

std::string set_options(const ClaimUnderTest& test) {
  std::string text;
  for (const auto& [key, value] : test.parameters) text += " --set " + shell_word(key + "=" + value);
  return text;
}

}  // namespace

std::string shell_word(const std::string& text) {
  constexpr const char* plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./=,:+-";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? "'\\''" : std::string(1, c);
  return word + "'";
}

std::string counterexample_name(const ClaimUnderTest& test) {
  return test.method->descriptor().name + "-not-" + in_small_letters(std::string(to_string(test.claim)));
}

PolynomialSystem named_system(const ClaimUnderTest& test, const Counterexample& counterexample) {
  PolynomialSystem system = counterexample.system;
  const std::string method = test.method->descriptor().name;
  system.title =
      "a system on which " + method + " does not keep the claim " + std::string(to_string(test.claim));
  system.name = counterexample_name(test);
  return system;
}

std::string showing_arguments(const ClaimUnderTest& test, const Counterexample& counterexample) {
  const JudgedStep& at = counterexample.at;
  std::string text = test.method->descriptor().name + set_options(test) + " --claim " +
                     std::string(to_string(test.claim)) + " --system " +
                     named_system(test, counterexample).name + ".toml --step " + to_string(at.step);
  if (at.count > 1) text += " --steps " + std::to_string(at.count);
  if (!at.time.is(0)) text += " --at " + to_string(at.time);
  return text;
}

std::string model_text_of(const ClaimUnderTest& test, const Counterexample& counterexample,
                          const std::string& command) {
  const Judgement& judgement = counterexample.judgement;
  std::vector<std::string> comment{
      "A system on which the integrator " + test.method->descriptor().name + " does not keep the claim " +
          std::string(to_string(test.claim)) + ":",
      std::string(claim_row(test.claim).meaning),
      "The residual from the initial state is " + short_number(judgement.residuals.front())};
  if (judged_by_long_runs(test.claim)) {
    comment.back() += ", in units of what is allowed, in long runs of many starts near it";
  } else {
    comment.back() += " with h = " + to_string(counterexample.at.step);
  }
  if (counterexample.at.count > 1)
    comment.back() += " in " + std::to_string(counterexample.at.count) + " steps in a row";
  const std::size_t count = judgement.residuals.size();
  if (count > 1) {
    comment.back() += ", " + short_number(judgement.residuals[1]) + " with h/2, and falls";
    comment.push_back("as a power of h with the exponent " + short_number(judgement.exponent) + ".");
  } else {
    comment.back() += ".";
  }
  if (!command.empty()) {
    comment.emplace_back();
    comment.push_back("  " + command);
  }
  return text_model(named_system(test, counterexample), comment);
}

}  // namespace pfaff
