// Runs backwards in time: against closed forms, against the runs forwards from reversed states, and forth and
// back again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <pfaff/bench/runner/config_file.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/bench/runner/record.hpp>
#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/runs/motion.hpp>

#include "../temporary_directory.hpp"
#include "kept_samples.hpp"
#include "run_settings.hpp"

namespace {

using namespace pfaff;
using pfaff::testing::complaint;
using pfaff::testing::settings_of;

RunSettings back(const std::string& system, const std::string& integrator, const std::string& initial) {
  RunSettings s = settings_of(system, "0.1", "-10", {{"initial", initial}});
  s.integrator = integrator;
  return s;
}
pfaff::testing::RecordWithSamples made(const RunSettings& settings) {
  const ResolvedRun run = resolve(settings);
  return pfaff::testing::execute_and_keep(run, reference_asked_for(run).get());
}

// The largest difference of coordinates of two samples, one of them with the momenta times `sign`.
double difference(const Sample<Quad>& a, const Sample<Quad>& b, double sign) {
  double largest = 0;
  for (std::size_t k = 0; k < a.state.size(); ++k) {
    const double of_b = static_cast<double>(b.state[k]) * (k < a.state.size() / 2 ? 1 : sign);
    largest = std::max(largest, std::abs(static_cast<double>(a.state[k]) - of_b));
  }
  return largest;
}

// r'' + 0.3 r' + r = 0 grows as e^{0.15 |t|} on the way back. The numbers are those of the matrix
// exponential, by mpmath; gauss of order 4 with h = 0.1 leaves h^4/720 of a state of size 4 in each unit of
// time, 6e-6 over ten of them.
TEST(Backwards, DampedOscillatorGrows) {
  const ResolvedRun run = resolve(back("damped-oscillator", "gauss", "1,0.5"));
  EXPECT_EQ(run.step, -*Real::parse("0.1"));
  const pfaff::testing::RecordWithSamples record =
      pfaff::testing::execute_and_keep(run, reference_asked_for(run).get());
  ASSERT_EQ(record.status, Status::converged) << record.message;
  const Sample<Quad>& last = record.samples.back();
  EXPECT_EQ(static_cast<double>(last.t), -10);
  EXPECT_NEAR(static_cast<double>(last.state[0]), -2.698119825057866753661, 1e-5);
  EXPECT_NEAR(static_cast<double>(last.state[1]), -4.178261159989996890851, 1e-5);
  EXPECT_LT(record.error_max.value(), 3e-6);
  EXPECT_GT(record.error_max.value(), 1e-8);
  for (std::size_t k = 1; k < record.samples.size(); ++k)
    EXPECT_LT(record.samples[k].t, record.samples[k - 1].t);
  // The energy falls with time, and so it is to rise here; it may fall by what the error of the state allows.
  const nlohmann::json j = summary(run, record);
  EXPECT_EQ(j["time"], "-10");
  EXPECT_EQ(j["step"], "-0.1");
  EXPECT_EQ(j["invariants"][1]["expected"], "increasing");
  EXPECT_LT(j["invariants"][1]["largest_fall"].get<double>(), 1e-5);
}

// The motion of the oscillator is a rotation, (q, p) = (cos t, -sin t) from (1, 0). Methods that choose their
// steps allow 1e-9 in each of some tens of steps.
TEST(Backwards, MethodsThatChooseTheirSteps) {
  for (const char* method : {"taylor", "extrapolation", "odeint-dopri5", "odeint-bulirsch-stoer"}) {
    RunSettings settings = back("harmonic-oscillator", method, "1,0");
    settings.step.clear();
    settings.tolerance = "1e-9";
    const pfaff::testing::RecordWithSamples record = made(settings);
    ASSERT_EQ(record.status, Status::converged) << method << ": " << record.message;
    const Sample<Quad>& last = record.samples.back();
    EXPECT_EQ(static_cast<double>(last.t), -10) << method;
    EXPECT_NEAR(static_cast<double>(last.state[0]), std::cos(10.0), 1e-6) << method;
    EXPECT_NEAR(static_cast<double>(last.state[1]), std::sin(10.0), 1e-6) << method;
    EXPECT_LT(record.error_max.value(), 1e-6) << method;
  }
}

// Without an exact solution the Taylor series go back too: twice as fine a step of a method of order 4 leaves
// a sixteenth of the error, and a solution of another motion would leave all of it.
TEST(Backwards, TaylorReferences) {
  const auto error = [](const char* step) {
    RunSettings settings = back("henon-heiles", "gauss", "0.3,0.1,0.2,0.1");
    settings.step = step;
    settings.reference = ErrorsAgainst::solution;
    const pfaff::testing::RecordWithSamples record = made(settings);
    EXPECT_EQ(record.reference, "30-digit");
    EXPECT_EQ(record.reference_ended, "");
    return record.error_max.value();
  };
  EXPECT_NEAR(error("0.1") / error("0.05"), 16, 1);
}

// A motion that blows up on its way back has a solution up to there: v' = v^2 - 1 from v = -2 is -coth(t + c)
// with coth c = 2, infinite at t = -c = -log(3)/2.
TEST(Backwards, TaylorReferencesEndWhereTheMotionDoes) {
  const pfaff::testing::TemporaryDirectory directory;
  const std::string file = directory / "blowing.toml";
  write_file(file, "name = \"blowing\"\ncoordinates = [\"v\"]\nfield = [\"v^2 - 1\"]\ninitial = [-2]\n");
  RunSettings settings = settings_of(file, "0.05", "-2");
  settings.reference = ErrorsAgainst::solution;
  const ResolvedRun run = resolve(settings);
  const auto solution = reference_asked_for(run);
  EXPECT_EQ(solution->ended().find("the solution was found up to t = -0.5493061"), 0U) << solution->ended();
  EXPECT_TRUE(solution->covers(Quad(-0.5)));
  EXPECT_FALSE(solution->covers(Quad(-0.6)));
}

// Closed forms hold for times before the start: they are compared with Taylor series in quad, of which 20
// digits are known in any case.
TEST(Backwards, ExactSolutionsOfAllSystems) {
  int compared = 0;
  for (const SystemPlugin* plugin : systems().all())
    for (const Assignments& parameters : plugin->instances(false)) {
      const auto model = plugin->make(parameters);
      if (!model->facets().has(Facet::exact_solution)) continue;
      std::vector<Quad> z;
      for (const Real& x : model->initial()) z.push_back(x.quad());
      const std::vector<Quad> closed = ReferenceSolution(model, Quad(0), z, Quad(-1)).at(Quad(-0.75));
      taylor_flow(*motion_of(model), Quad(0), Quad(-0.75), z);
      for (std::size_t k = 0; k < z.size(); ++k)
        EXPECT_LE(static_cast<double>(abs(closed[k] - z[k]) / (Quad(1) + abs(z[k]))), 1e-20) << model->name();
      ++compared;
    }
  EXPECT_GE(compared, 10);
}

// The pendulum backwards from (q, p) is the pendulum forwards from (q, -p) with the momenta reversed, and so
// is every method that is made of its forces or its energy. What differs is rounding: a hundred steps of it,
// and what iterations leave, which end near round-off.
TEST(Backwards, ARunBackwardsIsTheReversedRunForwards) {
  int compared = 0;
  for (const MethodPlugin* plugin : integrators().all())
    for (const Assignments& parameters : plugin->instances(false)) {
      // Generating functions about a plane that the reversal does not keep are other methods backwards.
      if (is_set(parameters, "normal")) continue;
      const auto method = plugin->make(parameters);
      if (!method->refuses(*motion_for(*method, systems().get("pendulum", "system").make({}))).empty())
        continue;
      RunSettings settings = back("pendulum", plugin->name(), "1,0.5");
      for (const auto& [key, value] : parameters) settings.set.emplace_back("integrator." + key, value);
      settings.structure_residuals = false;
      settings.time = "-5";
      settings.step = "0.05";
      const pfaff::testing::RecordWithSamples there = made(settings);
      settings.time = "5";
      settings.set.front().second = "1,-0.5";
      const pfaff::testing::RecordWithSamples here = made(settings);
      const std::string name = called(plugin->name(), parameters);
      ASSERT_EQ(there.samples.size(), here.samples.size()) << name << ": " << there.message << here.message;
      for (std::size_t k = 0; k < there.samples.size(); ++k) {
        ASSERT_EQ(there.samples[k].t, -here.samples[k].t) << name;
        ASSERT_LE(difference(there.samples[k], here.samples[k], -1), 1e-12) << name << " at sample " << k;
      }
      // Control: without the reversal it is another motion.
      EXPECT_GT(difference(there.samples.back(), here.samples.back(), 1), 0.1) << name;
      ++compared;
    }
  EXPECT_GT(compared, 40);
}

// Methods with many earlier steps, whose tables stand in files, make the same errors both ways.
TEST(Backwards, MethodsThatRememberSteps) {
  const std::string tables = std::string(PFAFF_GOLDEN) + "/../../examples/tables/";
  for (const std::string& method : {std::string("leap-frog"), tables + "quinlan-tremaine-8.toml",
                                    tables + "quinlan-tremaine-12.toml", tables + "adams-bashforth-4.toml"}) {
    RunSettings settings = back("pendulum", method, "1,0.5");
    settings.step = "0.02";
    const double there = made(settings).error_final.value();
    settings.time = "10";
    settings.set.front().second = "1,-0.5";
    const double here = made(settings).error_final.value();
    EXPECT_LE(std::abs(there - here), 1e-6 * here + 1e-12) << method;  // a hundred roundings for small ones
    EXPECT_LT(there, 1e-3) << method;
  }
}

// Symmetric methods come back to the start but for rounding: some hundred steps of it, which the pendulum
// lets grow no faster than time. RK4 is not symmetric and misses the start by its error.
TEST(Backwards, ForthAndBackAgain) {
  const auto missed = [](const char* method) {
    RunSettings settings = settings_of("pendulum", "0.1", "10", {{"initial", "1,0.5"}});
    settings.integrator = method;
    const pfaff::testing::RecordWithSamples forth = made(settings);
    settings.t0 = "10";
    settings.time = "-10";
    settings.set.clear();
    for (const Quad& x : forth.samples.back().state) settings.initial.push_back(to_string(x, 36));
    const pfaff::testing::RecordWithSamples again = made(settings);
    EXPECT_EQ(static_cast<double>(again.samples.back().t), 0);
    return difference(again.samples.back(), forth.samples.front(), 1);
  };
  EXPECT_LT(missed("verlet"), 1e-13);
  EXPECT_LT(missed("gauss"), 1e-13);
  EXPECT_GT(missed("rk4"), 1e-8);
}

// The slope of a drift is one over time: the energy of RK4 moves the same way on both ways, so that its slope
// has the other sign. The class is the same.
TEST(Backwards, Drift) {
  RunSettings settings = back("pendulum", "rk4", "1,0.5");
  settings.time = "-200";
  const Drift there = made(settings).invariants().drift.front();
  settings.time = "200";
  settings.set.front().second = "1,-0.5";
  const Drift here = made(settings).invariants().drift.front();
  EXPECT_EQ(there.drift_class, here.drift_class);
  EXPECT_NEAR(there.slope / here.slope, -1, 1e-6);
  EXPECT_NEAR(there.maximum / here.maximum, 1, 1e-6);
}

// Residuals of constraints grow along the run, whichever way it goes.
TEST(Backwards, Constraints) {
  RunSettings settings = settings_of("n-pendulum", "0.01", "-5");
  const pfaff::testing::RecordWithSamples record = made(settings);
  ASSERT_EQ(record.status, Status::converged) << record.message;
  ASSERT_TRUE(record.constraints().growth.front().has_value());
  EXPECT_GT(record.constraints().growth.front()->exponent, 0);
}

TEST(Backwards, StructureOfAStep) {
  const ResolvedRun run = resolve(back("pendulum", "verlet", "1,0.5"));
  EXPECT_LT(pfaff::testing::execute_and_keep(run, nullptr).structure_residual.value(), 1e-14);
  EXPECT_GT(pfaff::testing::execute_and_keep(resolve(back("pendulum", "rk4", "1,0.5")), nullptr)
                .structure_residual.value(),
            1e-9);
}

TEST(Backwards, StepsAreSizesOrHaveTheSignOfTheDuration) {
  RunSettings settings = settings_of("pendulum", "-0.1", "-10");
  EXPECT_EQ(resolve(settings).step, -*Real::parse("0.1"));
  EXPECT_EQ(resolve(settings).steps, 100);
  settings.time = "-10.05";
  EXPECT_EQ(resolve(settings).steps, 100);
  EXPECT_EQ(complaint(settings_of("pendulum", "-0.1", "10")),
            "--step: expected a number > 0 beside the duration 10, which goes forwards, got '-0.1'; a run "
            "backwards has a --time < 0");
  EXPECT_EQ(complaint(settings_of("pendulum", "-20", "-10")),
            "--step: expected at most the duration -10, got '-20'");
  EXPECT_EQ(complaint(settings_of("pendulum", "0.1", "0")),
            "--time: expected a duration other than 0, got '0'");
  EXPECT_EQ(complaint(settings_of("pendulum", "1e-6", "-1e5")).find("--step: 1e-6 is too little beside"), 0U);
}

// A config.toml has the run again, to the last bit.
TEST(Backwards, AreMadeAgainFromTheirConfig) {
  const pfaff::testing::TemporaryDirectory directory;
  const ResolvedRun run = resolve(back("pendulum", "leap-frog", "1,0.5"));
  write_file(directory / "config.toml", config_text(run));
  const ResolvedRun again = resolve(read_config(directory / "config.toml").settings);
  EXPECT_EQ(settings_text(again), settings_text(run));
  EXPECT_EQ(pfaff::testing::series_csv(again), pfaff::testing::series_csv(run));
}

}  // namespace
