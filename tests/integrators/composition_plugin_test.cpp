// The integrator `composition`: its base methods, the short names that stand for compositions, and what it
// refuses. composition_test.cpp tests that a composition is the sequence of its sub-steps.
#include <gtest/gtest.h>

#include <array>
#include <set>

#include <pfaff/bench/runner/config_file.hpp>
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/integrators/composition/composition_weights.hpp>
#include <pfaff/runs/motion.hpp>

#include "methods.hpp"

namespace pfaff {
namespace {

using testing::method_named;

std::string composition_refusal(const Assignments& parameters, const char* name = "composition") {
  try {
    (void)method_named(name, parameters);
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "accepted";
}

struct Short {
  const char *name, *scheme, *base, *system;
};
const std::vector<Short> shorts{{"yoshida", "yoshida", "midpoint-darboux", "damped-pendulum"},
                                {"suzuki", "suzuki", "midpoint-darboux", "damped-pendulum"},
                                {"kahan-li", "kahan-li", "midpoint-darboux", "damped-pendulum"},
                                {"yoshida-verlet", "yoshida", "verlet", "henon-heiles"},
                                {"suzuki-verlet", "suzuki", "verlet", "henon-heiles"},
                                {"kahan-li-verlet", "kahan-li", "verlet", "henon-heiles"},
                                {"yoshida-rattle", "yoshida", "rattle", "n-pendulum"},
                                {"suzuki-rattle", "suzuki", "rattle", "n-pendulum"},
                                {"kahan-li-rattle", "kahan-li", "rattle", "n-pendulum"},
                                {"suzuki-conformal", "suzuki", "conformal-splitting", "damped-pendulum"},
                                {"kahan-li-conformal", "kahan-li", "conformal-splitting", "damped-pendulum"}};

template <class T>
std::vector<T> steps_on(const MethodInstance& method, const char* system) {
  const auto model = systems().get(system, "system").make({});
  EXPECT_EQ(method.refuses(*model), "");
  return testing::after_steps(method, model, T(Real::fraction(1, 64)), 20);
}

TEST(Aliases, AreCompositionsInReportsUnlessTheyStepOnConstraints) {
  for (const Short& s : shorts)
    EXPECT_EQ(method_named(s.name, {})->family(),
              std::string(s.base) == "rattle" ? "constrained" : "splitting")
        << s.name;
  EXPECT_EQ(method_named("wisdom-holman", {})->family(), "splitting");
  EXPECT_EQ(method_named("leap-frog", {})->family(), "multistep");
}

TEST(Aliases, StepBitForBitLikeTheCompositionTheyName) {
  EXPECT_EQ(integrators().aliases().size(), shorts.size() + 2);  // and wisdom-holman and spark-lobatto
  for (const Short& s : shorts)
    for (const char* compensated : {"yes", "no"}) {
      const Assignments whole{
          {"scheme", s.scheme}, {"base", s.base}, {"order", "6"}, {"base.compensated", compensated}};
      const auto named = method_named(s.name, {{"order", "6"}, {"compensated", compensated}});
      EXPECT_EQ(steps_on<double>(*named, s.system),
                steps_on<double>(*method_named("composition", whole), s.system))
          << s.name;
      EXPECT_EQ(steps_on<Quad>(*named, s.system),
                steps_on<Quad>(*method_named("composition", whole), s.system))
          << s.name;
      // Control: another order is another map.
      EXPECT_NE(steps_on<Quad>(*named, s.system),
                steps_on<Quad>(*method_named(s.name, {{"order", "8"}}), s.system))
          << s.name;
    }
}

TEST(Aliases, KeepTheirNameAndTheirOwnParameters) {
  for (const Short& s : shorts) {
    const auto instance = method_named(s.name);
    const std::string lowest = s.scheme == std::string("kahan-li") ? "6" : "4";
    EXPECT_EQ(instance->descriptor().name, s.name);
    EXPECT_EQ(instance->parameters(), (Assignments{{"order", lowest}, {"compensated", "yes"}})) << s.name;
    EXPECT_NE(composition_refusal({{"scheme", "suzuki"}}, s.name).find("unknown parameter 'scheme'"),
              std::string::npos);
    EXPECT_NE(composition_refusal({{"compensate", "no"}}, s.name)
                  .find("did you mean 'compensated'? (of integrator " + std::string(s.name) + ")"),
              std::string::npos);
    const auto listed = integrators().names();
    EXPECT_EQ(std::count(listed.begin(), listed.end(), s.name), 0) << s.name;
    for (const Assignments& parameters : integrators().get(s.name, "").instances(true))
      EXPECT_EQ(parameters.size(), 1U) << s.name;
  }
  EXPECT_EQ(integrators().get("yoshida", "").instances(true).size(), 4U);
}

TEST(Aliases, ARefusalNamesTheAlias) {
  const auto model = systems().get("damped-pendulum", "system").make({});
  EXPECT_EQ(method_named("yoshida-verlet")->refuses(*model).find("yoshida-verlet needs separable; "), 0U);
  EXPECT_EQ(method_named("composition", {{"base", "verlet"}})
                ->refuses(*model)
                .find("composition of verlet needs separable; "),
            0U);
}

TEST(Composition, IsResolvedWithItsBase) {
  EXPECT_EQ(
      method_named("composition")->parameters(),
      (Assignments{{"scheme", "yoshida"}, {"order", "4"}, {"base", "midpoint-darboux(compensated=yes)"}}));
  const auto fine = method_named("composition", {{"base", "verlet(compensated=no)"}, {"scheme", "kahan-li"}});
  EXPECT_EQ(fine->parameters(),
            (Assignments{{"scheme", "kahan-li"}, {"order", "6"}, {"base", "verlet(compensated=no)"}}));
  EXPECT_EQ(method_named("composition", fine->parameters())->parameters(), fine->parameters());
  EXPECT_EQ(fine->coefficient_count(), kahan_li_weights(6).size());
}

TEST(Composition, TakesEveryBaseThatSaysHowItIsComposed) {
  const auto& plugin = integrators().get("composition", "integrator");
  EXPECT_EQ(range_of(plugin.parameters()[2]),
            "conformal-splitting|dla|implicit-midpoint|midpoint-darboux|rattle|verlet");
  std::set<std::string> verified;
  for (const Assignments& parameters : plugin.instances(false))
    verified.insert(parameters[0].second + " of " + parameters[2].second);
  EXPECT_EQ(verified.size(), 18U);  // three schemes of six bases
}

TEST(Composition, RefusesOtherBases) {
  const std::string expected =
      "; expected one of: conformal-splitting, dla, implicit-midpoint, midpoint-darboux, rattle, verlet";
  const auto because = [&](const char* base, const char* reason) {
    EXPECT_EQ(composition_refusal({{"base", base}}),
              "composition cannot have the base " + std::string(base) + ": " + reason + expected);
  };
  because("rk4", "it is not symmetric");
  because("symplectic-euler", "it is not symmetric");
  because("gauss", "it does not say how it is composed");
  because("composition", "it does not say how it is composed");
  because("yoshida-verlet", "it does not say how it is composed");
  because("odeint-dopri5", "it chooses its steps itself");
  EXPECT_EQ(composition_refusal({{"base", "verlte"}}), "unknown integrator 'verlte'; did you mean 'verlet'?");
  EXPECT_EQ(composition_refusal({{"base", "verlet(compensate=no)"}}),
            "unknown parameter 'compensate'; did you mean 'compensated'? (of integrator verlet)");
  EXPECT_EQ(composition_refusal({{"scheme", "kahan-li"}, {"order", "4"}}),
            "parameter 'order' of integrator composition: expected 6|8 with scheme=kahan-li, got '4'");
}

// What says of itself that it is of order 2 and not symmetric, or symmetric and of order 4; both composable.
struct Euler {
  std::array<Quad, 1> length{Quad(1)};
  std::span<Quad> coefficients() { return length; }
  template <class P>
  struct Work {
    State<P> rate;
    Work(const Euler& /*method*/, const P& p) : rate(p.make_state()) {}
  };
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    p.field(t, z, w.rate);
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = z[k] + h * w.rate[k];
    return Status::converged;
  }
};
struct Lopsided : Euler {
  using Composed = Composition<Euler>;
};
struct HighOrder : Euler {
  using Composed = Composition<Euler>;
};

TEST(Composition, RefusesComposableBasesOfAnotherKind) {
  // Registered for as long as the process lives: what is tested above does not list them, for they are unfit.
  static const Method<Lopsided> lopsided{
      {.name = "lopsided", .title = "a test", .reference = "su-qin", .order = 2, .preserves = {Claim::none}}};
  static const Method<HighOrder> high{{.name = "high",
                                       .title = "a test",
                                       .reference = "su-qin",
                                       .order = 4,
                                       .preserves = {Claim::symmetric}}};
  EXPECT_NE(composition_refusal({{"base", "lopsided"}}).find("base lopsided: it is not symmetric; "),
            std::string::npos);
  EXPECT_NE(composition_refusal({{"base", "high"}}).find("base high: its order is not 2; "),
            std::string::npos);
}

RunSettings run_of(const char* integrator, const Assignments& set) {
  RunSettings settings;
  settings.system = "henon-heiles";
  settings.integrator = integrator;
  settings.step = "0.1";
  settings.time = "1";
  settings.set = set;
  return settings;
}

TEST(Composition, ConfigurationsNameTheBaseWithItsParameters) {
  const std::string text =
      config_text(resolve(run_of("composition", {{"base", "verlet"}, {"base.compensated", "no"}})));
  EXPECT_NE(text.find("\"integrator.base\" = \"verlet(compensated=no)\"\n"), std::string::npos) << text;
  // The same text again from what it says.
  EXPECT_EQ(config_text(resolve(run_of("composition", {{"integrator.base", "verlet(compensated=no)"}}))),
            text);
  const std::string of_alias = config_text(resolve(run_of("yoshida-verlet", {{"compensated", "no"}})));
  EXPECT_NE(of_alias.find("integrator = \"yoshida-verlet\"\n"), std::string::npos);
  EXPECT_NE(of_alias.find("\"integrator.order\" = \"4\"\n\"integrator.compensated\" = \"no\"\n"),
            std::string::npos)
      << of_alias;
}

}  // namespace
}  // namespace pfaff
