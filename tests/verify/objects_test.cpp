// Verification of objects: methods and models that need not be registered.
#include <gtest/gtest.h>

#include <set>

#include <pfaff/core/forwarding_instance.hpp>
#include <pfaff/verify/check.hpp>

namespace pfaff {
namespace {

std::shared_ptr<const MethodInstance> method_of(const std::string& name) {
  return integrators().get(name, "integrator").make({});
}
std::shared_ptr<const Model> model_of_system(const std::string& name) {
  return systems().get(name, "system").make({});
}

// A method that claims what its base does not.
class Boasting final : public ForwardingInstance<Boasting> {
 public:
  explicit Boasting(std::shared_ptr<const MethodInstance> base) : ForwardingInstance(std::move(base)) {}
  [[nodiscard]] std::vector<Claim> preserves(const Model& /*model*/) const override {
    return {Claim::symplectic};
  }
  template <class T>
  [[nodiscard]] StepperPointer<T> made(std::shared_ptr<const Model> model) const {
    return ForwardingInstance::made<T>(std::move(model));
  }
};

TEST(VerifyObjects, ASoundMethodIsFoundSoundOnTheModelsThatAreNamed) {
  const auto checks =
      verify({{method_of("verlet")}}, {}, {model_of_system("pendulum"), model_of_system("kepler")});
  std::set<std::string> on;
  for (const Check& check : checks) on.insert(check.system);
  EXPECT_EQ(on, (std::set<std::string>{"kepler", "pendulum"}));
  const Verdict verdict = verdict_of(checks);
  EXPECT_TRUE(verdict.ok) << verdict.line;
  EXPECT_TRUE(verdict.line.starts_with("ok: ")) << verdict.line;
}

TEST(VerifyObjects, AFalseClaimFails) {
  const auto checks =
      verify({{std::make_shared<Boasting>(method_of("rk4"))}}, {}, {model_of_system("henon-heiles")});
  const Verdict verdict = verdict_of(checks);
  EXPECT_FALSE(verdict.ok);
  EXPECT_TRUE(verdict.line.starts_with("NOT OK: ")) << verdict.line;
  for (const Check& check : checks)
    EXPECT_TRUE(good(check) || check.claim.starts_with("symplectic")) << check.claim;
}

// Where they are verified on registered systems, as by name.
TEST(VerifyObjects, CoefficientsOfMethodsHaveControls) {
  int noticed = 0;
  for (const Check& check : verify({{method_of("verlet")}}, {}, {})) {
    if (!check.control) continue;
    EXPECT_EQ(check.result, CheckResult::rejected) << check.claim;
    EXPECT_EQ(check.plugin, "verlet");
    ++noticed;
  }
  EXPECT_EQ(noticed, static_cast<int>(method_of("verlet")->coefficient_count()));
  EXPECT_GT(noticed, 0);
}

TEST(VerifyObjects, WithoutModelsAMethodIsTriedOnRandomOnesAndOnAllThatItFits) {
  std::set<std::string> on;
  for (const Check& check : verify({{method_of("symplectic-euler")}}, {}, {})) on.insert(check.system);
  EXPECT_TRUE(on.contains("kepler"));
  EXPECT_FALSE(on.contains("damped-pendulum"));  // which is not separable
  EXPECT_GT(on.size(), 5U);
}

TEST(VerifyObjects, AModelIsVerifiedItself) {
  const auto checks = verify({}, {model_of_system("pendulum")}, {});
  EXPECT_TRUE(verdict_of(checks).ok);
  for (const Check& check : checks) EXPECT_EQ(check.plugin, "pendulum");
}

TEST(VerifyObjects, AMethodThatDoesNotFitIsRefused) {
  EXPECT_THROW(verify({{method_of("verlet")}}, {}, {model_of_system("damped-pendulum")}), InputError);
}

TEST(Verdict, OfNothingIsThatNothingWasChecked) {
  const Verdict verdict = verdict_of({});
  EXPECT_FALSE(verdict.ok);
  EXPECT_FALSE(verdict.checked);
  EXPECT_TRUE(verdict.line.starts_with("NOT OK: nothing could be checked")) << verdict.line;
}

// A system whose formulas contradict nothing is as it should be; beside others it does not count.
TEST(Verdict, OfASystemThatStatesNothingIsOk) {
  const Verdict verdict = verdict_of({nothing_stated("forced")});
  EXPECT_TRUE(verdict.ok);
  EXPECT_FALSE(verdict.checked);
  EXPECT_TRUE(verdict.line.starts_with("ok: there is nothing to check of forced, because it states nothing"))
      << verdict.line;
  Check held, failed;
  held.result = CheckResult::pass;
  failed.result = CheckResult::fail;
  EXPECT_EQ(verdict_of({nothing_stated("forced"), held}).line, "ok: 1 checks hold");
  EXPECT_FALSE(verdict_of({nothing_stated("forced"), failed}).ok);
}

TEST(Verdict, CountsClaimsAndControlsApart) {
  Check held, failed, rejected, missed;
  held.result = CheckResult::pass;
  failed.result = CheckResult::fail;
  rejected.control = missed.control = true;
  rejected.result = CheckResult::rejected;
  missed.result = CheckResult::pass;
  EXPECT_EQ(verdict_of({held, rejected}).line, "ok: 1 checks hold, 1 of 1 false claims rejected");
  EXPECT_EQ(verdict_of({held, failed, rejected, missed}).line,
            "NOT OK: 1 of 2 checks fail, 1 hold, 1 of 2 false claims rejected");
  EXPECT_FALSE(verdict_of({held, missed}).ok);
}

}  // namespace
}  // namespace pfaff
