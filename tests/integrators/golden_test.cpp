// The generating-function scheme against reference values of 30 digits and more: transition matrices of the
// damped oscillator; one-step maps, Jacobians, coefficients and trajectories of the damped pendulum. The
// systems go through the same code as any other.
#include <gtest/gtest.h>

#include <fstream>
#include <pfaff/bench/runner/json.hpp>

#include <pfaff/core/system.hpp>
#include <pfaff/integrators/generating/generating_gradient.hpp>
#include <pfaff/runs/support/structure.hpp>

#include "../golden_numbers.hpp"

namespace pfaff {
namespace {

// One rounding is 1.1e-16 or 9.6e-35; a step makes a few dozen of them, a trajectory a few hundred.
constexpr double golden_in_double = 1e-14, golden_in_quad = 1e-30;

// A list of reference values, never empty.
std::vector<nlohmann::json> golden_entries(const std::string& file, const std::string& list) {
  const auto entries = testing::golden(file).at(list).get<std::vector<nlohmann::json>>();
  EXPECT_FALSE(entries.empty()) << file << ' ' << list;
  return entries;
}
std::string text(const nlohmann::json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}
template <class T>
T number(const nlohmann::json& value) {
  return T(*Real::parse(text(value)));
}

template <class T>
double error_of(const T& ours, const nlohmann::json& theirs) {
  const Quad reference = number<Quad>(theirs);
  return static_cast<double>(abs(Quad(ours) - reference) / std::max(Quad(1), abs(reference)));
}

std::unique_ptr<MethodInstance> paper_scheme(const std::string& order) {
  return integrators()
      .get("generating-function", "integrator")
      .make({{"order", order}, {"variant", "P"}, {"extra", "0"}});
}
std::shared_ptr<const Model> system_with(const std::string& name, const nlohmann::json& nu) {
  return systems().get(name, "system").make({{"nu", text(nu)}});
}

// The largest deviation of a step's state and Jacobian.
template <class T>
void expect_transition(const nlohmann::json& entry, double tolerance) {
  const auto model = system_with("damped-oscillator", entry["nu"]);
  for (const auto& [order, matrix] : entry["orders"].items()) {
    for (const double t0 : {0.0, 0.7}) {  // transition matrices do not depend on t0
      StepDifferentiator<T> differentiate(*paper_scheme(order), model);
      const auto step = differentiate(T(t0), number<T>(entry["tau"]), {T(1), T(0)});
      ASSERT_EQ(step.status, Status::converged);
      for (std::size_t k = 0; k < 4; ++k)
        EXPECT_LE(error_of(step.jacobian[k], matrix[k / 2][k % 2]), tolerance)
            << "nu " << entry["nu"] << " tau " << entry["tau"] << " order " << order << " entry " << k;
    }
  }
}

TEST(GoldenOscillator, TransitionMatricesOfOrders1To8) {
  for (const auto& entry : golden_entries("damped_oscillator", "transition")) {
    expect_transition<double>(entry, golden_in_double);
    expect_transition<Quad>(entry, golden_in_quad);
  }
}

TEST(GoldenOscillator, ImplicitMidpointIsTheEulerCentreScheme) {
  for (const auto& entry : golden_entries("damped_oscillator", "transition")) {
    const auto method = integrators().get("implicit-midpoint", "integrator").make({});
    StepDifferentiator<Quad> differentiate(*method, system_with("damped-oscillator", entry["nu"]));
    const auto step = differentiate(Quad(0), number<Quad>(entry["tau"]), {Quad(1), Quad(0)});
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_LE(error_of(step.jacobian[k], entry["euler_centre_107"][k / 2][k % 2]), golden_in_quad);
  }
}

TEST(GoldenOscillator, VariantSOfOrder2IsTheMidpointExpandedScheme) {
  for (const auto& entry : golden_entries("damped_oscillator", "transition")) {
    const auto method =
        integrators().get("generating-function", "").make({{"order", "2"}, {"variant", "S"}, {"extra", "0"}});
    StepDifferentiator<Quad> differentiate(*method, system_with("damped-oscillator", entry["nu"]));
    const auto step = differentiate(Quad(0), number<Quad>(entry["tau"]), {Quad(1), Quad(0)});
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_LE(error_of(step.jacobian[k], entry["time_symmetric_order2_midpoint_expanded"][k / 2][k % 2]),
                golden_in_quad);
  }
}

TEST(GoldenOscillator, MidpointInTheChartIsTheMidpointExpandedScheme) {
  for (const auto& entry : golden_entries("damped_oscillator", "transition")) {
    const auto model = system_with("damped-oscillator", entry["nu"]);
    const auto method = integrators().get("gauss-darboux", "").make({{"stages", "1"}});
    StepDifferentiator<double> in_doubles(*method, model);
    StepDifferentiator<Quad> in_quads(*method, model);
    const auto step = in_doubles(0.7, number<double>(entry["tau"]), {1, 0});
    const auto exact = in_quads(Quad(0.7), number<Quad>(entry["tau"]), {Quad(1), Quad(0)});
    double other = 0;  // control: the distance from the expansion at the start of the step
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& expected = entry["time_symmetric_order2_midpoint_expanded"][k / 2][k % 2];
      EXPECT_LE(error_of(step.jacobian[k], expected), golden_in_double);
      EXPECT_LE(error_of(exact.jacobian[k], expected), golden_in_quad);
      other = std::max(other, error_of(exact.jacobian[k], entry["orders"]["2"][k / 2][k % 2]));
    }
    if (number<double>(entry["nu"]) > 0) {
      EXPECT_GT(other, 1e-10);
    }
  }
}

// phi_w^(k) at w = (R, P) in the paper's coordinates: the chart's y = (R, -P), components (psi_p, psi_q).
std::vector<Quad> coefficient(const Model& model, Quad t0, int k, Quad r, Quad p) {
  GeneratingGradient<Quad> gradient(model.tape(Formula::chart_field), k, false, GeneratingForm::midpoint,
                                    gauss_coefficients((k + 1) / 2));
  gradient.set_step(t0, Quad(1));
  const std::vector<Quad> w{r, -p};
  std::vector<Quad> terms(gradient.term_count() * 2);
  gradient.terms(w.data(), terms.data());
  const auto at = static_cast<std::size_t>(2 * k);
  return {terms[at + 1], terms[at]};
}

TEST(GoldenOscillator, CoefficientsOfTheGeneratingGradient) {
  for (const auto& entry : golden_entries("damped_oscillator", "phi_k_numeric")) {
    const auto model = system_with("damped-oscillator", entry["nu"]);
    for (int k = 1; k <= 8; ++k) {
      const auto& n = entry["N"][static_cast<std::size_t>(k)];
      for (std::size_t column = 0; column < 2; ++column) {
        const auto ours = coefficient(*model, number<Quad>(entry["t0"]), k, Quad(column == 0 ? 1 : 0),
                                      Quad(column == 1 ? 1 : 0));
        EXPECT_LE(error_of(ours[0], n[0][column]), golden_in_quad) << "k " << k;
        EXPECT_LE(error_of(ours[1], n[1][column]), golden_in_quad) << "k " << k;
      }
    }
  }
}

TEST(GoldenPendulum, CoefficientsOfTheGeneratingGradient) {
  for (const auto& entry : golden_entries("damped_pendulum", "phi_w")) {
    const auto model = system_with("damped-pendulum", entry["nu"]);
    for (int k = 1; k <= 6; ++k) {
      const auto ours = coefficient(*model, number<Quad>(entry["t0"]), k, number<Quad>(entry["R"]),
                                    number<Quad>(entry["P"]));
      for (std::size_t i = 0; i < 2; ++i)
        EXPECT_LE(error_of(ours[i], entry["k0_to_6"][static_cast<std::size_t>(k)][i]), golden_in_quad)
            << "k " << k;
    }
  }
}

template <class T>
void expect_one_step(const nlohmann::json& entry, double tolerance) {
  const auto model = system_with("damped-pendulum", entry["nu"]);
  for (const auto& [order, expected] : entry["orders"].items()) {
    StepDifferentiator<T> differentiate(*paper_scheme(order), model);
    const auto step = differentiate(number<T>(entry["t0"]), number<T>(entry["tau"]),
                                    {number<T>(entry["r"]), number<T>(entry["p"])});
    ASSERT_EQ(step.status, Status::converged);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_LE(error_of(step.z[i], expected["z"][i]), tolerance) << "order " << order;
      for (std::size_t j = 0; j < 2; ++j)
        EXPECT_LE(error_of(step.jacobian[2 * i + j], expected["jacobian"][i][j]), tolerance)
            << "order " << order;
    }
  }
}

TEST(GoldenPendulum, OneStepMapsAndTheirJacobians) {
  for (const auto& entry : golden_entries("damped_pendulum", "one_step")) {
    expect_one_step<double>(entry, golden_in_double);
    expect_one_step<Quad>(entry, golden_in_quad);
  }
}

TEST(GoldenPendulum, AnotherOrderIsSeen) {  // control: the tolerance tells orders apart
  const auto entry = golden_entries("damped_pendulum", "one_step")[0];
  StepDifferentiator<double> differentiate(*paper_scheme("6"), system_with("damped-pendulum", entry["nu"]));
  const auto step = differentiate(number<double>(entry["t0"]), number<double>(entry["tau"]),
                                  {number<double>(entry["r"]), number<double>(entry["p"])});
  EXPECT_GT(error_of(step.z[1], entry["orders"]["5"]["z"][1]), 100 * golden_in_double);
}

template <class T>
void expect_trajectory(const nlohmann::json& entry, double tolerance) {
  const auto stepper =
      paper_scheme(text(entry["order"]))->stepper(system_with("damped-pendulum", entry["nu"]), T());
  std::vector<T> z{number<T>(entry["r0"]), number<T>(entry["p0"])};
  std::int64_t completed = 0;
  const std::int64_t steps = entry["steps"].get<std::int64_t>();
  ASSERT_EQ(stepper->advance(number<T>(entry["t0"]), 0, number<T>(entry["tau"]), steps, z, completed),
            Status::converged);
  EXPECT_EQ(completed, steps);
  EXPECT_LE(error_of(z[0], entry["r"]), tolerance);
  EXPECT_LE(error_of(z[1], entry["p"]), tolerance);
}

TEST(GoldenPendulum, TrajectoriesWithHistoryAndCompensation) {
  for (const auto& entry : golden_entries("damped_pendulum", "trajectories")) {
    expect_trajectory<double>(entry, golden_in_double);
    expect_trajectory<Quad>(entry, golden_in_quad);
  }
}

}  // namespace
}  // namespace pfaff
