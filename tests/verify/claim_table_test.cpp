// The table of claims: what it says of each claim, which systems a claim speaks of, and that its measure
// tells methods that keep something from methods that do not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/verify/check.hpp>
#include <pfaff/verify/claim_checks.hpp>
#include <pfaff/verify/method_on_model.hpp>

#include "../formula_values.hpp"

namespace pfaff {
namespace {

using testing::model_named;

using ::testing::HasSubstr;

// A claim about rounding is measured in double alone, every other one in quad too.
TEST(ClaimTable, EveryClaimHasItsMeasures) {
  for (const ClaimCheck& check : claim_checks()) {
    EXPECT_NE(check.measure.in_double, nullptr) << to_string(check.claim);
    EXPECT_EQ(check.measure.in_quad == nullptr, check.of_rounding) << to_string(check.claim);
  }
}

std::vector<Claim> all_claims() {
  std::vector<Claim> claims;
  for (const ClaimRow& row : claim_table) claims.push_back(row.claim);
  return claims;
}

// A method that no registry knows, with descriptor and code of its own.
template <class M>
class Local final : public MethodPlugin {
 public:
  explicit Local(MethodDescriptor descriptor)
      : MethodPlugin(std::move(descriptor), {}, typeid(M), std::source_location::current()) {}
  [[nodiscard]] std::unique_ptr<MethodInstance> make(const Assignments& /*none*/ = {}) const override {
    return std::make_unique<detail::Instance<M>>(*this, M());
  }
  [[nodiscard]] std::vector<Assignments> instances(bool /*full*/) const override { return {{}}; }
};

// Runge's method of order 2, which keeps nothing, neither symmetric nor symplectic.
struct Runge {
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, NoWork& /*none*/) const {
    using T = Scalar<P>;
    State<P> slope = p.make_state(), middle = z;
    p.field(t, z, slope);
    for (std::size_t k = 0; k < z.size(); ++k) middle[k] = z[k] + h / T(2) * slope[k];
    p.field(t + h / T(2), middle, slope);
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = z[k] + h * slope[k];
    return Status::converged;
  }
};

// The flow itself, which keeps everything that the motion keeps.
struct ExactFlow {
  template <class P>
  requires requires(const P& p, const Scalar<P>& t, State<P>& z) { p.exact_solution(t, z, z); }
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, NoWork& /*none*/) const {
    std::vector<Scalar<P>> start(z.begin(), z.end());
    start.push_back(t);
    p.exact_solution(h, start, z);
    return Status::converged;
  }
};

// The checks of those claims that the method makes on this model, by claim.
template <class M>
std::map<std::string, std::vector<Check>> checks_of_claims(const std::shared_ptr<const Model>& model,
                                                           const std::vector<Claim>& claims) {
  const Local<M> plugin({.name = "local", .title = "", .reference = "", .order = 1, .preserves = claims});
  std::map<std::string, std::vector<Check>> found;
  for (Check& check : check_method(*plugin.make(), {}, "local", model))
    if (check.in_scope) found[check.claim].push_back(std::move(check));
  return found;
}

TEST(ClaimTable, RowsSayWhatAndOfWhich) {
  std::set<std::string_view> names{"none"};
  for (const ClaimRow& row : claim_table) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_EQ(to_string(row.claim), row.name);
    EXPECT_EQ(&claim_row(row.claim), &row);
    EXPECT_GT(row.meaning.size(), 10U) << row.name;
    EXPECT_TRUE(row.meaning.ends_with('.')) << row.meaning;
    EXPECT_FALSE(row.scope.empty()) << row.name;
  }
  EXPECT_EQ(to_string(Claim::none), "none");
  EXPECT_FALSE(in_scope(Claim::none, *model_named("pendulum")));
}

TEST(ClaimTable, ScopesSpeakOfTheSystemsMeant) {
  const std::map<Claim, std::pair<std::vector<const char*>, std::vector<const char*>>> spoken{
      {Claim::symmetric, {{"pendulum", "lotka-volterra", "heavy-top"}, {}}},
      {Claim::symplectic, {{"pendulum", "kepler"}, {"damped-pendulum", "free-rigid-body"}}},
      {Claim::k_symplectic, {{"pendulum", "kepler", "damped-pendulum"}, {"free-rigid-body"}}},
      {Claim::poisson, {{"free-rigid-body", "heavy-top"}, {"pendulum", "damped-pendulum"}}},
      {Claim::quadratic_invariants, {{"kepler", "free-rigid-body"}, {"pendulum", "damped-pendulum"}}},
      {Claim::momentum_maps, {{"kepler", "spherical-pendulum"}, {"pendulum", "free-rigid-body"}}},
      {Claim::constraints, {{"spherical-pendulum", "n-pendulum"}, {"pendulum", "n-pendulum-angles"}}},
      {Claim::constrained_symplectic, {{"spherical-pendulum"}, {"pendulum"}}},
      {Claim::velocity_constraints, {{}, {"pendulum", "spherical-pendulum"}}},
      {Claim::nonholonomic_momentum, {{}, {"pendulum", "spherical-pendulum"}}},
      {Claim::conformal, {{"damped-pendulum", "damped-oscillator"}, {"pendulum", "driven-duffing"}}},
      {Claim::volume, {{"henon-heiles", "free-rigid-body"}, {"damped-pendulum", "lotka-volterra"}}},
      {Claim::reversible, {{"pendulum", "free-rigid-body"}, {"damped-pendulum", "lotka-volterra"}}},
      {Claim::energy, {{"pendulum", "heavy-top"}, {"damped-pendulum", "damped-rigid-body"}}},
      {Claim::casimirs, {{"free-rigid-body", "heavy-top"}, {"pendulum", "relaxing-rigid-body"}}},
      {Claim::entropy, {{"relaxing-rigid-body"}, {"damped-rigid-body", "free-rigid-body"}}},
      {Claim::unbiased_round_off,
       {{"pendulum", "kepler", "n-pendulum-angles"},
        {"damped-pendulum", "driven-duffing", "free-rigid-body", "spherical-pendulum"}}}};
  for (const auto& [claim, systems] : spoken) {
    for (const char* name : systems.first)
      EXPECT_TRUE(in_scope(claim, *model_named(name))) << to_string(claim) << ' ' << name;
    for (const char* name : systems.second)
      EXPECT_FALSE(in_scope(claim, *model_named(name))) << to_string(claim) << ' ' << name;
  }
}

TEST(ClaimTable, VelocityConstraintsAreASurfaceOfTheirOwn) {
  const auto blade = sliding_blade();
  EXPECT_TRUE(blade->restricted());
  EXPECT_TRUE(blade->moves());
  EXPECT_TRUE(in_scope(Claim::velocity_constraints, *blade));
  EXPECT_TRUE(in_scope(Claim::energy, *blade));  // A v = 0 does no work
  EXPECT_TRUE(in_scope(Claim::nonholonomic_momentum, *blade));
  for (const Claim claim : {Claim::constraints, Claim::volume, Claim::symplectic})
    EXPECT_FALSE(in_scope(claim, *blade)) << to_string(claim);
}

// Where a claim speaks of a system, its measure is shown there whoever makes it: K-symplecticity as
// symplecticity where the structure is the canonical one, momentum maps as quadratic invariants where there
// are no constraints.
TEST(ClaimTable, EveryScopeIsMeasured) {
  for (const SystemPlugin* system : systems().all()) {
    const auto model = system->make({});
    for (const ClaimCheck& row : claim_checks()) {
      if (row.of_rounding) continue;  // takes long runs, and is measured where it is claimed
      if (!in_scope(row.claim, *model) || row.shown_on == nullptr || row.shown_on(*model)) continue;
      EXPECT_TRUE((row.claim == Claim::k_symplectic && in_scope(Claim::symplectic, *model)) ||
                  (row.claim == Claim::momentum_maps && in_scope(Claim::quadratic_invariants, *model)))
          << to_string(row.claim) << ' ' << system->name();
    }
  }
}

TEST(ClaimTable, FalseOnesFail) {
  for (const ClaimCheck& row : claim_checks()) {
    if (row.of_rounding) continue;  // of Runge's method truncation hides what rounding does
    const FalseClaim& control = row.control;
    Assignments parameters;
    if (!control.key.empty()) parameters.emplace_back(control.key, control.value);
    auto model =
        control.model != nullptr ? control.model() : model_named(std::string(control.system), parameters);
    if (model->restricted() && !model->moves()) model = motion_of(model);
    const auto found = checks_of_claims<Runge>(model, {row.claim});
    const auto checks = found.find(std::string(to_string(row.claim)));
    ASSERT_NE(checks, found.end()) << to_string(row.claim);
    EXPECT_EQ(checks->second.size(), 2U);
    for (const Check& check : checks->second) {
      EXPECT_EQ(check.result, CheckResult::fail)
          << check.claim << ' ' << check.precision << ' ' << check.measured;
      EXPECT_EQ(check.reason, "");
      EXPECT_FALSE(good(check));
    }
  }
}

// One step of a control of rounding is like any other; the growth of its errors is not.
TEST(ClaimTable, PlainUpdatesAreNotARandomWalkOfIncrements) {
  const auto model = model_named("harmonic-oscillator");
  const auto residual = [&](const char* compensated) {
    const auto gauss = integrators().get("gauss", "").make({{"compensated", compensated}});
    MeasuredStep<double> step(*gauss, model, generic_state(*model), generic_time_of(*model), check_step);
    return round_off_residual(step);
  };
  EXPECT_LE(residual("yes"), 1);
  EXPECT_GT(residual("no"), 1.3);
}

// A method of low order cannot claim it: truncation is in sight at every step, and nothing is judged.
TEST(ClaimTable, RoundingBehindTruncationIsNotJudged) {
  const Local<Runge> plugin(
      {.name = "local", .title = "", .reference = "", .order = 1, .preserves = {Claim::unbiased_round_off}});
  int found = 0;
  for (const Check& check : check_method(*plugin.make(), {}, "local", model_named("pendulum"))) {
    if (check.claim != "unbiased-round-off") continue;
    ++found;
    EXPECT_EQ(check.result, CheckResult::skipped);
    EXPECT_THAT(check.reason, HasSubstr("truncation hides"));
  }
  EXPECT_EQ(found, 1);  // in double alone
}

// What the flow keeps passes, in both precisions. (Its round-off is that of closed forms, not of a step.)
TEST(ClaimTable, TrueOnesOfTheExactFlowPass) {
  const std::vector<std::pair<std::shared_ptr<const Model>, std::vector<Claim>>> flows{
      {model_named("harmonic-oscillator"),
       {Claim::symplectic, Claim::volume, Claim::symmetric, Claim::reversible, Claim::quadratic_invariants,
        Claim::energy}},
      {model_named("pendulum"),
       {Claim::symplectic, Claim::volume, Claim::symmetric, Claim::reversible, Claim::energy}},
      {model_named("free-rigid-body"),
       {Claim::poisson, Claim::volume, Claim::symmetric, Claim::reversible, Claim::quadratic_invariants,
        Claim::energy, Claim::casimirs}},
      {model_named("damped-oscillator"), {Claim::k_symplectic, Claim::conformal, Claim::symmetric}}};
  for (const auto& [model, kept] : flows) {
    const auto found = checks_of_claims<ExactFlow>(model, all_claims());
    for (const Claim claim : kept) {
      const auto checks = found.find(std::string(to_string(claim)));
      ASSERT_NE(checks, found.end()) << to_string(claim) << ' ' << model->name();
      for (const Check& check : checks->second)
        EXPECT_EQ(check.result, CheckResult::pass)
            << check.claim << ' ' << model->name() << ' ' << check.precision << ' ' << check.measured;
    }
  }
}

// Where more entropy is produced than the method loses, none is seen to fall.
TEST(ClaimTable, EntropyMayGrow) {
  auto checks = checks_of_claims<Runge>(model_named("relaxing-rigid-body"), {Claim::entropy});
  ASSERT_FALSE(checks["entropy"].empty());
  for (const Check& check : checks["entropy"])
    EXPECT_EQ(check.result, CheckResult::pass) << check.precision << ' ' << check.measured;
}

TEST(ClaimTable, OrdersThatAreNotPositiveFail) {
  for (const int order : {0, -1, 2, 3}) {
    const Local<Runge> plugin(
        {.name = "runge", .title = "", .reference = "", .order = order, .preserves = {Claim::none}});
    const auto checks = check_method(*plugin.make(), {}, "pendulum", model_named("pendulum"));
    const auto check_of_order =
        std::find_if(checks.begin(), checks.end(), [](const Check& c) { return c.claim == "order"; });
    ASSERT_NE(check_of_order, checks.end());
    const Check& check = *check_of_order;
    EXPECT_EQ(check.result, order == 2 ? CheckResult::pass : CheckResult::fail) << order;
    EXPECT_EQ(check.reason.find("not positive") != std::string::npos, order <= 0) << check.reason;
  }
}

// The page's table is the list.
TEST(ClaimTable, TheDocumentationListsEachClaim) {
  std::ifstream in(PFAFF_GOLDEN "/../../docs/verification.md");
  ASSERT_TRUE(in);
  std::stringstream text;
  text << in.rdbuf();
  const std::string page = text.str();
  std::string table = "| claim | meaning | speaks of |\n|---|---|---|\n";
  for (const ClaimRow& row : claim_table)
    table += "| `" + std::string(row.name) + "` | " + std::string(row.meaning) + " | " +
             std::string(row.scope) + " |\n";
  EXPECT_NE(page.find("\n\n" + table + "\n"), std::string::npos)
      << "docs/verification.md: expected the list of claims as\n"
      << table;
}

}  // namespace
}  // namespace pfaff
