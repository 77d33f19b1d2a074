// Multistep methods for second order equations, read from tables: that steps satisfy the method's equation,
// that errors shrink as the order says, and that energies stay bounded; controls for each.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/core/system.hpp>
#include <pfaff/integrators/order_conditions/multistep_conditions.hpp>

#include "method_files.hpp"
#include "methods.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::expect_table_refused;
using pfaff::testing::Relativistic;
using pfaff::testing::shipped_tables;
using pfaff::testing::table_refusal;

const std::vector<std::string> symmetric{"quinlan-tremaine-8", "quinlan-tremaine-10", "quinlan-tremaine-12",
                                         "hairer-lubich-wanner-8"};

template <class T>
struct MultistepRun {
  std::vector<std::vector<T>> states;
  Status status = Status::converged;
};
// Kepler's motion at eccentricity 0.1, one state for each step.
template <class T>
MultistepRun<T> kepler_run(const MethodInstance& method, const T& h, int steps) {
  const auto model = systems().get("kepler", "system").make({});
  const std::vector<T> start{T(9) / T(10), T(0), T(0), sqrt(T(11) / T(9))};
  Integration<T> run(start_with(method, model, start, h, T(0)));
  MultistepRun<T> all{{start}};
  for (int n = 0; n < steps && all.status == Status::converged; ++n) {
    all.status = run.steps(1).status();
    all.states.emplace_back(run.state().begin(), run.state().end());
  }
  return all;
}

// sum_j rho_j q_{n+j} - h^2 sum_j sigma_j a(q_{n+j}), with a written down here once more, over the size of
// its largest term: round-off of quad, once no step among them is one of the starting method.
TEST(SecondOrderMultistep, StepsSatisfyTheEquationOfTheMethod) {
  for (const std::string& name : symmetric) {
    TableDocument document(shipped_tables + name + ".toml");
    const std::vector<Quad> rho = document.numbers("rho"), sigma = document.numbers("sigma");
    const Quad h = Quad(1) / Quad(32);
    const auto k = rho.size() - 1;
    const auto run = kepler_run<Quad>(*read_method_table(shipped_tables + name + ".toml")->make({}), h, 60);
    ASSERT_EQ(run.status, Status::converged) << name;
    double largest = 0;
    for (std::size_t n = k; n + k < run.states.size(); ++n)
      for (std::size_t c = 0; c < 2; ++c) {
        Quad sum(0);
        for (std::size_t j = 0; j <= k; ++j) {
          const auto& z = run.states[n + j];
          const Quad r = sqrt(z[0] * z[0] + z[1] * z[1]);
          sum += rho[j] * z[c] + h * h * sigma[j] * z[c] / (r * r * r);
        }
        largest = std::max(largest, static_cast<double>(abs(sum)));
      }
    // The coefficients of order 12 are up to 57 and cancel.
    EXPECT_LE(largest, 1e-30) << name;
  }
}

// Positions and momenta after the same time with h and h/2 differ from the closed form by errors in the ratio
// 2^order, within 0.5 of the exponent at these steps.
TEST(SecondOrderMultistep, ErrorsShrinkAsTheOrderSays) {
  const auto model = systems().get("kepler", "system").make({});
  const Problem<Quad> exact(model);
  for (const std::string& name : symmetric) {
    const auto table = read_method_table(shipped_tables + name + ".toml");
    const auto method = table->make({});
    std::vector<double> errors;
    for (const int steps : {128, 256}) {
      const Quad h = Quad(4) / Quad(steps);
      const auto run = kepler_run<Quad>(*method, h, steps);
      std::vector<Quad> initial = run.states.front(), end(4);
      initial.emplace_back(0);
      exact.exact_solution(Quad(4), initial, end);
      double error = 0;
      for (std::size_t c = 0; c < 4; ++c)
        error = std::max(error, static_cast<double>(abs(run.states.back()[c] - end[c])));
      errors.push_back(error);
    }
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), table->descriptor().order, 0.5) << name << " " << errors[1];
  }
}

// Over a thousand revolutions the error of the energy stays where it was after ten. The control: an explicit
// Adams method of order 4 loses energy at a rate that is seen a hundred times over in the same time.
TEST(SecondOrderMultistep, EnergiesStayBounded) {
  const auto largest_errors = [](const std::string& name, double h) {
    const auto run = kepler_run<double>(*read_method_table(shipped_tables + name + ".toml")->make({}), h,
                                        static_cast<int>(6300 / h));
    const auto energy = [](const std::vector<double>& z) {
      return (z[2] * z[2] + z[3] * z[3]) / 2 - 1 / std::hypot(z[0], z[1]);
    };
    double early = 0, late = 0;
    for (std::size_t n = 0; n < run.states.size(); ++n) {
      const double error = std::abs(energy(run.states[n]) - energy(run.states[0]));
      if (n < run.states.size() / 100) early = std::max(early, error);
      late = std::max(late, error);
    }
    return std::pair(early, late);
  };
  const auto [early, late] = largest_errors("hairer-lubich-wanner-8", 0.1);
  EXPECT_LE(late, 2 * early);
  EXPECT_LE(late, 1e-6);
  const auto [adams_early, adams_late] = largest_errors("adams-bashforth-4", 0.1);
  EXPECT_GE(adams_late, 10 * adams_early);
}

// Velocities that are momenta over masses, and velocities that are not: with a coupling both momenta add to
// both of them, which momenta of the same size do not show.
struct TwoSprings {
  static constexpr int dimension = 4;
  Real coupling = 0;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] + p[1] * p[1] / 6 + T(coupling) * (p[0] * p[1]);
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0] * q[0] / 2 + q[1] * q[1] * q[1] * q[1] / 4;
  }
};

TEST(SecondOrderMultistep, MassesMayBeOneForEachCoordinateOrAMatrix) {
  const auto method = read_method_table(shipped_tables + "quinlan-tremaine-8.toml")->make({});
  const auto gauss = integrators().get("gauss", "integrator").make({{"stages", "8"}});
  std::vector<std::vector<Quad>> ends;
  for (const Real& coupling : {Real(0), Real::fraction(1, 4)}) {
    TwoSprings springs;
    springs.coupling = coupling;
    const auto model = make_model(
        {.name = "two-springs", .title = "", .reference = "", .initial = {1, 0.5_r, 0.2_r, 0.3_r}}, springs);
    const Quad h = Quad(1) / Quad(64);
    const auto ours = pfaff::testing::after_steps(*method, model, h, 128),
               theirs = pfaff::testing::after_steps(*gauss, model, h, 128);
    for (std::size_t k = 0; k < 4; ++k)  // the error of order 8 at this step
      EXPECT_LT(static_cast<double>(abs(ours[k] - theirs[k])), 1e-12) << k;
    ends.push_back(ours);
  }
  EXPECT_GT(static_cast<double>(abs(ends[0][0] - ends[1][0])), 1e-2);  // the two are different motions
}

std::string multistep_table(const std::string& numbers) {
  return "name = \"table\"\nkind = \"second-order-multistep\"\nreference = \"none\"\n" + numbers + "\n";
}

TEST(SecondOrderMultistep, WrongTablesAreRefused) {
  EXPECT_EQ(table_refusal(multistep_table("order = 2\nrho = [1, -2, 1]\nsigma = [0, 1, 0]")),
            "accepted: table");  // Stoermer's
  expect_table_refused(multistep_table("order = 2\nrho = [1, -2, 1]\nsigma = [0, \"1 + 1/1000000000\", 0]"),
                       {"the sum of j^2 rho_j - 2 sigma_j = 0", "order 1"});
  expect_table_refused(multistep_table("order = 4\nrho = [1, -2, 1]\nsigma = [0, 1, 0]"),
                       {"a condition of order 3"});
  expect_table_refused(
      multistep_table("order = 4\nrho = [1, -2, 1]\nsigma = [\"1/12\", \"10/12\", \"1/12\"]"),  // Cowell's
      {"sigma", "expected an explicit method"});
  expect_table_refused(multistep_table("order = 1\nrho = [-1, 1]\nsigma = [1, 0]"),
                       {"rho", "3 to 25 numbers"});
  // (x - 1)^2 (x^2 + 1)^2: of order 2 with this sigma, and with double roots besides 1.
  expect_table_refused(
      multistep_table("order = 2\nrho = [1, -2, 3, -4, 3, -2, 1]\nsigma = [0, 0, 0, 4, 0, 0, 0]"),
      {"not zero-stable", "multiple root"});
}

TEST(SecondOrderMultistep, OtherKineticEnergiesAreRefused) {
  const auto model =
      make_model({.name = "sample", .title = "", .reference = "", .initial = {1, 1}}, Relativistic{});
  const auto table = read_method_table(shipped_tables + "quinlan-tremaine-8.toml");  // outlives its method
  const auto method = table->make({});
  EXPECT_NE(method->refuses(*model).find("quadratic in the momenta"), std::string::npos);
  EXPECT_EQ(method->refuses(*systems().get("kepler", "system").make({})), "");
}

}  // namespace
