// Evaluations of models that a program makes itself. Evaluations by the command line are tested with the
// program `pfaff`.
#include <gtest/gtest.h>

#include <pfaff/bench/evaluation/evaluation.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/runs/motion.hpp>
#include <pfaff/runs/support/constraint_brackets.hpp>

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

// A point in the plane with its angular momentum and its distance from the origin given: their bracket is
// zero, but the two products that it is the difference of are rounded.
struct TurnedPoint {
  static constexpr int dimension = 4, constraint_count = 2;
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return (z[2] * z[2] + z[3] * z[3]) / 2;
  }
  template <class T>
  void constraints(const T& /*t*/, In<T> z, Out<T> phi) const {
    phi[0] = z[0] * z[3] - z[1] * z[2];
    phi[1] = (z[0] * z[0] + z[1] * z[1]) / 3;
  }
};

TEST(Evaluation, BracketsThatAreRoundOffOfTheirTermsAreZero) {
  const auto model = make_model({.name = "turned-point",
                                 .title = "",
                                 .reference = "",
                                 .coordinates = {{"x", ""}, {"y", ""}, {"px", ""}, {"py", ""}}},
                                TurnedPoint());
  int rounded = 0;
  for (int k = 1; k <= 20; ++k) {
    const auto found = constraint_brackets<double>(*model, 0.0, {0.1 * k, 1 / (0.3 * k), 0.7, -0.2 * k});
    rounded += found.brackets(0, 1) != 0;
    EXPECT_EQ(found.classes.rank(), 0U) << k;
  }
  EXPECT_GT(rounded, 2);
}

// A sleigh by its centre of mass: mass 1, J = 2, r = 1/2.
struct Sleigh {
  static constexpr int dimension = 6, velocity_constraint_count = 1;
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return (z[3] * z[3] + z[4] * z[4] + z[5] * z[5] / 2) / 2;
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = -sin(q[2]);
    rows[1] = cos(q[2]);
    rows[2] = -T(1) / T(2);
  }
};
struct Quartic : Sleigh {
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return z[3] * z[3] * z[3] * z[3] + z[4] * z[4] + z[5] * z[5];
  }
};
// Two constraints that are one where x = 0.
struct Crossing : Sleigh {
  static constexpr int velocity_constraint_count = 2;
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    for (std::size_t k = 0; k < 6; ++k) rows[k] = T(1);
    rows[3] = T(1) + q[0];
  }
};
const SystemDescriptor sledge{
    .name = "sledge",
    .title = "",
    .reference = "",
    .coordinates = {
        {"x", "m"}, {"y", "m"}, {"theta", ""}, {"px", "m/s"}, {"py", "m/s"}, {"ptheta", "m^2/s"}}};

// Numbers of the state's precision are texts in quad, relative residuals are not.
double value_of(const nlohmann::json& x) {
  return x.is_string() ? std::stod(x.get<std::string>()) : x.get<double>();
}

template <class S>
nlohmann::json evaluated_at(const S& system, const std::vector<Real>& state, Precision precision) {
  EvaluationSettings settings;
  settings.at = {motion_of(make_model(sledge, system)), state, Real(0)};
  settings.precision = precision;
  return evaluation(settings);
}

// At theta = 0 with u = 3, omega = 2: P = I - (0, 1, -r/J)(0, 1, -r) / (1 + r^2/J), the reaction is (omega u
// / S) (0, 1, -r), S = 9/8, and the momenta are p = (3, r omega, J omega).
TEST(Evaluation, OfVelocityConstraintsShowsTheNonholonomicBracket) {
  const std::vector<Real> state{0, 0, 0, 3, 1, 4};
  const auto j = evaluated_at(Sleigh{}, state, Precision::double_precision);
  EXPECT_EQ(j["constraints"], (nlohmann::json{0.0}));
  EXPECT_EQ(j["multipliers"].size(), 1U);
  const std::vector<double> force = j["constraint_forces"], expected{0, 6 * 8.0 / 9, -3 * 8.0 / 9};
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(force[k], expected[k], 1e-15) << k;
  const auto& bracket = j["nonholonomic"];
  const std::vector<std::vector<double>> p = bracket["P"],
                                         projector{{1, 0, 0}, {0, 1.0 / 9, 4.0 / 9}, {0, 2.0 / 9, 8.0 / 9}};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(p[i][k], projector[i][k], 1e-15) << i << k;
  EXPECT_EQ(bracket["bracket"].size(), 6U);
  EXPECT_EQ(bracket["rank"], 4);
  EXPECT_EQ(bracket["casimirs"], (nlohmann::json{"psi1"}));
  EXPECT_LE(bracket["casimir_residual"].get<double>(), 1e-15);
  EXPECT_LE(bracket["one_form_residual"].get<double>(), 1e-15);
  EXPECT_GT(std::abs(bracket["jacobiator"]["value"].get<double>()), 0.1);
  EXPECT_EQ(bracket["jacobiator"]["of"].size(), 3U);
  EXPECT_LE(bracket["flow_difference"].get<double>(), 1e-15);
  const auto quad = evaluated_at(Sleigh{}, state, Precision::quad);
  for (const char* key : {"casimir_residual", "one_form_residual", "flow_difference"})
    EXPECT_LE(value_of(quad["nonholonomic"][key]), 1e-32) << key;
}

// Controls: without a motion there is nothing to compare, and another one is told from the bracket's.
TEST(Evaluation, ComparesTheNonholonomicFlowWithTheMotion) {
  const auto raw = make_model(sledge, Sleigh{});
  const auto difference = [](const std::shared_ptr<const Model>& model) {
    EvaluationSettings settings;
    settings.at = {model, {1, 2, Real(1) / Real(3), 3, 1, 4}, Real(0)};
    settings.precision = Precision::quad;
    return evaluation(settings)["nonholonomic"]["flow_difference"];
  };
  EXPECT_TRUE(difference(raw).is_null());
  const auto moving = motion_of(raw);
  EXPECT_LE(value_of(difference(moving)), 1e-32);
  ModelSource source = raw->source();
  source.formulation = "by hand";
  source.given[index(Formula::field)] = std::make_shared<const Tape>(
      record(6, 6, [&](const Recorded& t, std::span<const Recorded> z, std::span<Recorded> rate) {
        const std::vector<Recorded> motion = evaluate(*moving->tape(Formula::field), t, z);
        for (std::size_t k = 0; k < 6; ++k) rate[k] = motion[k];
        rate[4] = rate[4] + Recorded(1) / 1000;
      }));
  const auto wrong = difference(std::make_shared<const Model>(std::move(source)));
  EXPECT_NEAR(value_of(wrong), 1e-3, 1e-12);
}

TEST(Evaluation, OfVelocityConstraintsSaysWhereThereIsNoBracket) {
  const std::vector<Real> state{0, 0, 0, 3, 1, 4};
  EXPECT_TRUE(evaluated_at(Quartic{}, state, Precision::double_precision)["nonholonomic"].is_null());
  const auto j = evaluated_at(Crossing{}, state, Precision::double_precision);
  EXPECT_TRUE(j["nonholonomic"].is_null());
  EXPECT_EQ(j["status"], "singular");
  EXPECT_NE(j["reason"].get<std::string>().find("psi2"), std::string::npos) << j["reason"];
}

}  // namespace
