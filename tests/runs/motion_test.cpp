// Which formulation moves a system with constraints: the one that is named, the default for methods and for
// whatever else needs the motion.
#include <gtest/gtest.h>

#include <pfaff/bench/runner/record.hpp>
#include <pfaff/runs/motion.hpp>

namespace {

using namespace pfaff;

const SystemPlugin& system_by_name(const char* name) { return systems().get(name, "system"); }
std::shared_ptr<const MethodInstance> method_named(const char* name) {
  return integrators().get(name, "integrator").make({});
}

TEST(Motion, OfWhatMovesIsTheModelItself) {
  for (const char* name : {"pendulum", "damped-pendulum", "free-rigid-body"}) {
    const auto model = system_by_name(name).make({});
    EXPECT_EQ(motion_of(model), model) << name;
  }
  const auto raw = system_by_name("spherical-pendulum").make({});
  EXPECT_FALSE(raw->moves());
  const auto motion = motion_of(raw);
  EXPECT_TRUE(motion->moves());
  EXPECT_EQ(motion->source().formulation, dirac_formulation().name());
  EXPECT_EQ(motion_of(motion), motion);
}

TEST(Motion, ForAMethodOnTheConstraintsIsTheModelItself) {
  const auto raw = system_by_name("spherical-pendulum").make({});
  EXPECT_EQ(motion_for(*method_named("rattle"), raw), raw);
  EXPECT_EQ(motion_for(*method_named("rk4"), raw)->source().formulation, dirac_formulation().name());
}

TEST(Motion, FormulationIsTheOneNamed) {
  const SystemPlugin& constrained = system_by_name("spherical-pendulum");
  EXPECT_EQ(formulation_for(constrained, ""), &dirac_formulation());
  EXPECT_EQ(formulation_for(constrained, "lmm")->name(), "lmm");
  EXPECT_EQ(formulation_for(system_by_name("pendulum"), ""), nullptr);
  EXPECT_THROW((void)formulation_for(constrained, "lmn"), InputError);
  EXPECT_THROW((void)formulation_for(system_by_name("pendulum"), "lmm"), InputError);
}

TEST(Motion, FormulationOfAModelIsThatOfItsSystem) {
  const auto constrained = system_by_name("spherical-pendulum").make({}),
             sleigh = system_by_name("sleigh").make({}), pendulum = system_by_name("pendulum").make({});
  EXPECT_EQ(formulation_asked_for(*constrained, "").plugin, &dirac_formulation());
  EXPECT_EQ(formulation_asked_for(*sleigh, "").plugin, &nonholonomic_formulation());
  EXPECT_EQ(formulation_asked_for(*constrained, "LMM").plugin->name(), "lmm");
  EXPECT_EQ(formulation_asked_for(*pendulum, "").plugin, nullptr);
  EXPECT_EQ(formulation_asked_for(*motion_of(constrained), "").plugin, nullptr);
  const AskedFormulation set = formulation_asked_for(*constrained, "lmm(friction-form=none)");
  EXPECT_EQ(set.plugin->name(), "lmm");
  EXPECT_EQ(set.parameters, (Assignments{{"friction-form", "none"}}));
  // What has no constraints is refused in the same words, by its name and as an object.
  const auto refusal = [](const auto& ask) -> std::string {
    try {
      (void)ask();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal([&] { return formulation_asked_for(*pendulum, "dirac").plugin; }),
            "--formulation: pendulum has no constraints; expected none");
  EXPECT_EQ(refusal([&] { return formulation_asked_for(*pendulum, "dirac").plugin; }),
            refusal([] { return formulation_for(system_by_name("pendulum"), "dirac"); }));
}

// The reference of a run on the constraints is the motion of its model: RATTLE approaches it with the step.
TEST(Motion, IsWhatRunsOnConstraintsAreComparedWith) {
  const auto error = [](const char* step) {
    RunSettings settings;
    settings.system = "spherical-pendulum";
    settings.integrator = "rattle";
    settings.step = step;
    settings.time = "1";
    const ResolvedRun run = resolve(settings);
    EXPECT_FALSE(run.model->moves());
    return *execute(run, reference_of(run).get()).error_max;
  };
  const double coarse = error("0.02"), fine = error("0.01");
  EXPECT_LT(coarse, 1e-2);
  EXPECT_NEAR(coarse / fine, 4, 0.2);
}

}  // namespace
