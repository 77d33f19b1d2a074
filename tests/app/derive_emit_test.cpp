// pfaff derive --emit LANGUAGE: equations as text, and what it refuses.
#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

Arguments derive(const std::string& form) {
  return {"derive", "humanoid", "--method", "ldl", "--emit", form};
}

TEST(DeriveEmit, EveryLanguageIsPrinted) {
  const std::vector<std::pair<std::string, std::string>> sayings{
      {"cpp", "extern \"C\" void humanoid_rates("},
      {"latex", "\\begin{align*}"},
      {"sympy", "def rates(t, state"},
      {"mathematica", "ratesofhumanoid[t_, {x0_, "},
      {"julia", "function humanoid_rates!(rates, state, parameters, t)"}};
  for (const auto& [language, saying] : sayings) {
    const Outcome outcome = run_pfaff(derive(language));
    EXPECT_EQ(outcome.status, 0) << language << outcome.err;
    EXPECT_NE(outcome.out.find(saying), std::string::npos) << language;
    EXPECT_EQ(outcome.err, "");
  }
}

TEST(DeriveEmit, UnknownFormsAreRefusedWithTheNearest) {
  expect_refused(derive("jula"), {"unknown --emit 'jula'", "did you mean 'julia'"});
  expect_refused(derive("cpp") + Arguments{"--json"}, {"--json is for --emit counts", "cpp without it"});
}

}  // namespace
