// Evaluations of models that a program makes itself. Evaluations by the command line are tested with the
// program `pfaff`.
#include <gtest/gtest.h>

#include <pfaff/bench/evaluation/evaluation.hpp>
#include <pfaff/bench/runner/motion.hpp>

namespace {

using namespace pfaff;

TEST(Evaluation, OfConstraintsWithoutAFormulationHasNoMotion) {
  const auto raw = systems().get("spherical-pendulum", "system").make({});
  const auto evaluated = [&](const std::shared_ptr<const Model>& model) {
    EvaluationSettings settings;
    settings.at = {model, raw->initial(), Real(0)};
    return evaluation(settings);
  };
  const nlohmann::json without = evaluated(raw), with = evaluated(motion_of(raw));
  EXPECT_TRUE(without["rhs"].is_null());
  EXPECT_TRUE(without["energy_rate"].is_null());
  EXPECT_NE(without.value("reason", "").find("spherical-pendulum offers no vector field"), std::string::npos);
  // What is known of the constraints and of the energy does not hang on the motion.
  for (const char* key : {"constraints", "hidden_constraints", "W", "rank", "energy"})
    EXPECT_EQ(without[key], with[key]) << key;
  EXPECT_EQ(with["rhs"].size(), raw->initial().size());  // the control
  EXPECT_FALSE(with.contains("reason"));
}

}  // namespace
