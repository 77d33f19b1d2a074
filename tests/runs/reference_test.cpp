// Reference solutions: Taylor steps in quad agree with closed forms and golden values to 1e-30.
#include <gtest/gtest.h>

#include <fstream>

#include <pfaff/bench/runner/json.hpp>

#include <pfaff/core/system.hpp>
#include <pfaff/runs/motion.hpp>
#include <pfaff/runs/support/reference.hpp>

#include "../formula_values.hpp"

namespace {

using namespace pfaff;
using pfaff::testing::model_named;

std::vector<Quad> start_of(const Model& model) {
  std::vector<Quad> z;
  for (const Real& x : model.initial()) z.push_back(x.quad());
  return z;
}
// |a - b| <= epsilon max(1, |b|) componentwise, as a distance.
double componentwise_distance(const std::vector<Quad>& a, const std::vector<Quad>& b) {
  Quad worst(0);
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Quad d = abs(a[k] - b[k]) / std::max(Quad(1), abs(b[k]));
    if (!(d <= worst)) worst = d;
  }
  return static_cast<double>(worst);
}

// One series is the first of the two, and of it no digit is claimed.
TEST(Reference, OfOneSeriesIsTheSameAndShowsNoDigits) {
  const auto model = model_named("henon-heiles");
  const ReferenceSolution two(model, Quad(0), start_of(*model), Quad(5)),
      one(model, Quad(0), start_of(*model), Quad(5), Certainty::not_shown);
  EXPECT_EQ(two.kind(), "30-digit");
  EXPECT_EQ(one.kind(), "0-digit");
  EXPECT_EQ(one.ended(), "");
  for (const int t : {1, 3, 5}) EXPECT_EQ(one.at(Quad(t)), two.at(Quad(t)));
}

// The closed solution is that of ellipses; of other orbits series are taken, of which the energy is asked.
TEST(Reference, OfAHyperbolaIsASeries) {
  const auto kepler = model_named("kepler");
  const std::vector<Quad> start{Quad(1), Quad(0), Quad(0), Quad(2)};
  const ReferenceSolution open(kepler, Quad(0), start, Quad(1));
  EXPECT_EQ(open.kind(), "30-digit");
  const std::vector<Quad> z = open.at(Quad(1));
  const Quad energy = (z[2] * z[2] + z[3] * z[3]) / Quad(2) - Quad(1) / sqrt(z[0] * z[0] + z[1] * z[1]);
  EXPECT_LT(static_cast<double>(abs(energy - Quad(1))), 1e-29);
  EXPECT_EQ(ReferenceSolution(kepler, Quad(0), start_of(*kepler), Quad(1)).kind(), "exact");
}

TEST(Reference, TaylorFlowAgreesWithEveryExactSolution) {
  int systems_seen = 0;
  for (const SystemPlugin* plugin : systems().all()) {
    const auto model = motion_of(plugin->make({}));
    if (!model->facets().has(Facet::exact_solution)) continue;
    ++systems_seen;
    const Quad t0 = Quad(7) / Quad(10), elapsed = Quad(23) / Quad(10);
    for (const Quad& s : {elapsed, -elapsed}) {
      std::vector<Quad> z = start_of(*model), exact(z.size()), arguments = z;
      arguments.push_back(t0);
      const Problem<Quad> problem(model);
      problem.exact_solution(s, arguments, exact);
      taylor_flow(*model, t0, s, z);
      EXPECT_LE(componentwise_distance(z, exact), 1e-30) << plugin->name();
    }
  }
  EXPECT_GE(systems_seen, 3);
}

// An oscillator and what is said to be its solution.
enum class Closed { right, elsewhere, faster, in_doubles, rounded, none_at_zero };
template <Closed closed>
struct SaidToBeSolved {
  static constexpr int dimension = 2;
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return (z[0] * z[0] + z[1] * z[1]) / 2;
  }
  template <class T>
  void exact_solution(const T& elapsed, const T& /*t0*/, In<T> z0, Out<T> z) const {
    const T rate = closed == Closed::faster       ? T(1.001_r)
                   : closed == Closed::in_doubles ? T(1.0000000000000002_r)
                                                  : T(1);
    const T size = closed == Closed::elsewhere      ? T(1.001_r)
                   : closed == Closed::none_at_zero ? elapsed / elapsed
                                                    : T(1);
    const T c = cos(rate * elapsed), s = sin(rate * elapsed);
    z[0] = size * (z0[0] * c + z0[1] * s);
    z[1] = size * (z0[1] * c - z0[0] * s);
    if (closed == Closed::rounded) z[1] = z[1] + T(1e-24_r) * cos(T(1e18_r) * elapsed);
  }
};
template <Closed closed>
std::string refusal_of_solution(double duration) {
  const auto model = make_model({.name = "said",
                                 .title = "",
                                 .reference = "",
                                 .coordinates = {{"q", ""}, {"p", ""}},
                                 .initial = {1, 0}},
                                SaidToBeSolved<closed>());
  try {
    const ReferenceSolution solution(model, Quad(3), start_of(*model), Quad(duration));
    solution.check_closed_form(Quad(duration));
    return solution.kind();
  } catch (const InputError& error) {
    return error.what();
  }
}
TEST(Reference, AClosedFormOfAnotherMotionIsRefused) {
  for (const double duration : {1e-3, 20.0, -20.0, 1e7, 1e12}) {
    SCOPED_TRACE(duration);
    EXPECT_EQ(refusal_of_solution<Closed::right>(duration), "exact");
    EXPECT_EQ(refusal_of_solution<Closed::in_doubles>(duration), "exact");
    EXPECT_EQ(refusal_of_solution<Closed::rounded>(duration), "exact");
    EXPECT_EQ(refusal_of_solution<Closed::none_at_zero>(duration),
              "exact");  // what is no number is said later
    EXPECT_NE(refusal_of_solution<Closed::elsewhere>(duration).find("q is 1.001 instead of 1"),
              std::string::npos);
    EXPECT_NE(refusal_of_solution<Closed::faster>(duration).find(
                  "p changes by -1.001 a unit of time instead of -1"),
              std::string::npos);
  }
}

TEST(Reference, TaylorFlowAgreesWithTheGoldenFlow) {
  std::ifstream file(PFAFF_GOLDEN "/damped_pendulum.json");
  const auto golden = nlohmann::json::parse(file)["exact_flow"];
  ASSERT_FALSE(golden.empty());
  const auto number = [](const nlohmann::json& x) { return Real::parse(x.get<std::string>())->quad(); };
  for (const auto& g : golden) {
    SCOPED_TRACE(g.dump().substr(0, 200));
    const auto model = model_named("damped-pendulum", {{"nu", g["nu"]}});
    std::vector<Quad> z{number(g["r0"]), number(g["p0"])};
    taylor_flow(*model, Quad(0), number(g["t"]), z);  // autonomous in r and p
    EXPECT_LE(componentwise_distance(z, {number(g["r"]), number(g["p"])}), 1e-30);
  }
}

TEST(Reference, ThereAndBack) {
  for (const char* name : {"damped-pendulum", "henon-heiles", "kepler"}) {
    const auto model = model_named(name);
    std::vector<Quad> z = start_of(*model);
    taylor_flow(*model, Quad(0), Quad(5), z);
    EXPECT_GT(componentwise_distance(z, start_of(*model)), 1e-3) << name;
    taylor_flow(*model, Quad(5), Quad(-5), z);
    EXPECT_LE(componentwise_distance(z, start_of(*model)), 1e-29) << name;
  }
}

TEST(Reference, SolutionIsExactWhereThereIsAClosedForm) {
  const auto model = model_named("damped-oscillator", {{"nu", "0"}});
  const ReferenceSolution solution(model, Quad(0), {Quad(1), Quad(0)}, Quad(100));
  EXPECT_EQ(solution.kind(), "exact");
  for (const double t : {0.0, 1.0, 57.25, 100.0})
    EXPECT_LE(componentwise_distance(solution.at(Quad(t)), {cos(Quad(t)), -sin(Quad(t))}), 1e-30) << t;
}

TEST(Reference, SolutionByTaylorSeriesIsTheFlowAtEveryTime) {
  const auto model = model_named("damped-pendulum");
  const Quad t0 = Quad(1) / Quad(3);
  const std::vector<Quad> start{Quad(2), Quad(0)};
  const ReferenceSolution solution(model, t0, start, Quad(20));
  EXPECT_EQ(solution.kind(), "30-digit");
  EXPECT_EQ(componentwise_distance(solution.at(t0), start), 0);
  for (int k = 1; k <= 40; ++k) {
    const Quad elapsed = Quad(k) / Quad(2);
    std::vector<Quad> z = start;
    taylor_flow(*model, t0, elapsed, z);
    EXPECT_LE(componentwise_distance(solution.at(t0 + elapsed), z), 1e-30) << k;
  }
}

TEST(Reference, CoefficientsAreDerivativesOverFactorials) {
  const auto model = model_named("harmonic-oscillator");  // q' = p, p' = -q
  ReferenceExpansion expansion(*model);
  const std::vector<Quad> z{Quad(3), Quad(5)};
  expansion.expand(Quad(0), z.data());
  const auto& c = expansion.coefficients();
  const std::vector<Quad> expected{Quad(3),           Quad(5), Quad(5), Quad(-3), Quad(-3) / Quad(2),
                                   Quad(-5) / Quad(2)};
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_EQ(c[k], expected[k]) << k;
}

}  // namespace
