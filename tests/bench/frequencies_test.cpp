// Frequencies of the motion: the rate at which angles grow, and how wrong it is for a method.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include <pfaff/bench/experiment/case_frequencies.hpp>
#include <pfaff/bench/experiment/measured_runs.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/core/text/source.hpp>
#include <pfaff/runs/integrate.hpp>
#include <pfaff/runs/measuring.hpp>
#include <pfaff/runs/support/turning.hpp>

#include "../temporary_directory.hpp"

namespace {
using namespace pfaff;

// Vectors whose angle grows by `rate` and swings about that, at unequal distances from the origin.
std::vector<TurningVector> swinging(const std::vector<double>& times, double rate, double swing) {
  std::vector<TurningVector> vectors;
  for (const double t : times) {
    const double angle = 0.7 + rate * t + swing * std::sin(1 + 2.3 * t), size = 2 + std::cos(1.7 * t);
    vectors.push_back({size * std::cos(angle), size * std::sin(angle)});
  }
  return vectors;
}
std::vector<double> equal_times(double step, std::size_t count) {
  std::vector<double> times;
  for (std::size_t k = 0; k < count; ++k) times.push_back(step * static_cast<double>(k));
  return times;
}

// What the swing adds is that of the window at 70 of its periods, 1e-2 / 70^5 and less; without weights it
// would be 1e-5.
TEST(Turning, IsTheRateBehindOscillations) {
  const std::vector<double> times = equal_times(0.1, 2000);
  const TurningRate found = turning_rate(times, angles_of(swinging(times, 1.25, 0.1)));
  EXPECT_NEAR(found.rate, 1.25, 1e-10);
  EXPECT_NEAR(found.change, 0, 1e-8);
  const TurningRate back = turning_rate(times, angles_of(swinging(times, -3, 0.1)));
  EXPECT_NEAR(back.rate, -3, 1e-10);
  // One that speeds up: the rate is that of the middle, the change half of the whole.
  std::vector<double> angles;
  for (const double t : times) angles.push_back(0.01 * t * t);
  const TurningRate faster = turning_rate(times, angles);
  EXPECT_NEAR(faster.rate, 0.01 * times.back(), 1e-12);
  EXPECT_NEAR(faster.change, 0.01 * times.back(), 1e-12);
}

TEST(Turning, OfLinesAndParabolasIsExactAtUnequalTimes) {
  std::vector<double> times, line, parabola;
  for (int k = 0; k < 60; ++k) {
    const double t = 0.01 * k * k;
    times.push_back(t);
    line.push_back(3 + 0.5 * t);
    parabola.push_back(3 + 0.5 * t - 0.01 * t * t);
  }
  EXPECT_NEAR(turning_rate(times, line).rate, 0.5, 1e-14);
  EXPECT_NEAR(turning_rate(times, line).change, 0, 1e-14);
  EXPECT_NEAR(turning_rate(times, parabola).change, -0.01 * times.back(), 1e-13);
}

// The angle between two vectors has its own digits: a rate of 1e-11 beside one of 1.25, to 1e-4 of itself.
TEST(Turning, OfOneAheadOfAnotherKeepsItsDigits) {
  const std::vector<double> times = equal_times(0.1, 2000);
  const TurningRate ahead =
      turning_rate(times, angles_ahead(swinging(times, 1.25 + 1e-11, 0.1), swinging(times, 1.25, 0.1)));
  EXPECT_NEAR(ahead.rate, 1e-11, 1e-15);
  // Three turns ahead at the end.
  const TurningRate far =
      turning_rate(times, angles_ahead(swinging(times, 1.35, 0.1), swinging(times, 1.25, 0.1)));
  EXPECT_NEAR(far.rate, 0.1, 1e-10);
}

TEST(Turning, IsNotANumberWithoutAngles) {
  const std::vector<double> times = equal_times(0.1, 2000);
  std::vector<TurningVector> vectors = swinging(times, 1, 0);
  vectors[1000] = {0, 0};
  EXPECT_TRUE(std::isnan(turning_rate(times, angles_of(vectors)).rate));
  EXPECT_TRUE(std::isnan(turning_rate(times, angles_ahead(vectors, vectors)).rate));
  const std::vector<double> few = equal_times(0.1, 15);
  EXPECT_TRUE(std::isnan(turning_rate(few, angles_of(swinging(few, 1, 0))).rate));
}

struct FoundFrequency {
  double of_reference, error, change;
};

class Frequencies : public ::testing::Test {
 protected:
  Experiment read(const std::string& methods, const std::string& of_case) {
    write_file(files_ / "test.toml", "schema = 1\ntitle = \"A test\"\n" + methods + "[[case]]\n" + of_case);
    return read_experiment(files_ / "test.toml", false);
  }
  static std::vector<std::vector<FoundFrequency>> found(const Experiment& experiment) {
    std::vector<std::vector<FoundFrequency>> result;
    const auto runs = expand(experiment);
    for (const ExperimentRun& run : runs) {
      const auto measure = frequencies_of(*run.which, run.resolved.time);
      const Integration<double> start(start_of<double>(run.resolved));
      const auto table =
          measured(start, run.resolved.steps, {measure.get()}, solution_of(run.resolved).get()).front();
      std::vector<FoundFrequency>& of_run = result.emplace_back();
      for (const auto& line : table.lines) {
        const auto number = [&](std::size_t column) { return std::get<double>(line.cells[column]); };
        of_run.push_back({number(1), number(2), number(3)});
      }
    }
    return result;
  }

  pfaff::testing::TemporaryDirectory files_;
};

const std::string oscillators = R"([[method]]
label = "Verlet"
integrator = "verlet"
[[method]]
label = "midpoint"
integrator = "implicit-midpoint"
[[method]]
label = "RK4"
integrator = "rk4"
)";

// A step of either method turns the oscillator about an ellipse by an angle that is known.
TEST_F(Frequencies, OfTheOscillatorAreThoseOfTheSteps) {
  const Experiment experiment = read(oscillators, R"(name = "swing"
system = "harmonic-oscillator"
time = 200
steps = [0.2]
[[case.frequency]]
name = "phase"
x = "q"
y = "p"
)");
  const auto of = found(experiment);
  ASSERT_EQ(of.size(), 3U);
  const double h = 0.2, by_verlet = 2 / h * std::asin(h / 2), by_midpoint = 2 / h * std::atan(h / 2);
  for (const auto& one : of) EXPECT_NEAR(one[0].of_reference, -1, 1e-13);  // clockwise
  EXPECT_NEAR(of[0][0].error, 1 - by_verlet, 1e-10);    // the swings on the ellipse, see above
  EXPECT_NEAR(of[1][0].error, 1 - by_midpoint, 1e-13);  // a circle
  const double even = 1 - h * h / 2 + std::pow(h, 4) / 24, odd = h - h * h * h / 6;
  EXPECT_NEAR(of[2][0].error, 1 - std::atan2(odd, even) / h, 1e-13);
}

const std::string pericentre = R"toml([[case.frequency]]
name = "orbit"
x = "q1"
y = "q2"
[[case.frequency]]
name = "pericentre"
x = "p2*turn - q1/r"
y = "-p1*turn - q2/r"
let = { turn = "q1*p2 - q2*p1", r = "sqrt(q1^2 + q2^2)" }
)toml";

// The pericentre of the exact orbit stands still. A symplectic method turns it at a steady rate that falls
// with its order; that of RK4, which loses energy, grows with the time.
TEST_F(Frequencies, TheKeplerPericentreTurnsByTheOrderOfAMethod) {
  const Experiment experiment = read(oscillators, R"(name = "orbit"
system = "kepler"
set = { eccentricity = "0.3" }
time = 400
steps = [0.05, 0.025]
)" + pericentre);
  const auto of = found(experiment);
  ASSERT_EQ(of.size(), 6U);
  for (const auto& one : of) {
    EXPECT_NEAR(one[0].of_reference, 1, 1e-8);
    EXPECT_NEAR(one[1].of_reference, 0, 1e-13);
  }
  for (const std::size_t k : {std::size_t{0}, std::size_t{2}})
    for (const std::size_t which : {0, 1}) {
      EXPECT_NEAR(of[k][which].error / of[k + 1][which].error, 4, 0.1) << k << which;
      EXPECT_LT(std::abs(of[k][which].change), 0.03 * std::abs(of[k][which].error)) << k << which;
    }
  EXPECT_GT(std::abs(of[4][0].change), 0.3 * std::abs(of[4][0].error));
}

// A corrector is a change of variables near the identity, which lets a step begin on the torus of the motion:
// errors of the energy and of the mean motion fall by two orders of magnitude and more. The map on each torus
// is the same, and so is how fast it turns the pericentre.
TEST_F(Frequencies, ACorrectorLeavesTheSecularOnesAsTheyWere) {
  const Experiment experiment = read(R"toml([[method]]
label = "plain"
integrator = "wisdom-holman"
[[method]]
label = "corrected"
integrator = "exact-flow-splitting"
set = { scheme = "corrected-5" }
)toml",
                                     R"toml(name = "planets"
system = "n-body"
set = { central = "1000" }
initial = ["0.0013", "0.9", "-2.2", "0", "0", "0", "0", "0", "0", "-0.000464970", "0.001103293", "-0.000638323"]
time = 500
steps = [0.2]
[[case.frequency]]
name = "mean motion"
x = "x_2 - x_1"
y = "y_2 - y_1"
[[case.frequency]]
name = "pericentre"
x = "v*turn - x/r"
y = "-u*turn - y/r"
[case.frequency.let]
x = "x_2 - x_1"
y = "y_2 - y_1"
u = "whole*(px_2 - px_1/central)"
v = "whole*(py_2 - py_1/central)"
r = "sqrt(x^2 + y^2)"
turn = "(x*v - y*u)*whole/(central + 1)"
whole = "central + 2"
)toml");
  const auto runs = expand(experiment);
  const auto of = found(experiment);
  ASSERT_EQ(of.size(), 2U);
  EXPECT_NEAR(of[0][0].of_reference, 1.0005, 1e-4);
  EXPECT_NEAR(of[0][1].of_reference, 8.03e-5, 1e-7);
  EXPECT_GT(std::abs(of[0][0].error), 100 * std::abs(of[1][0].error));
  EXPECT_NEAR(of[1][1].error / of[0][1].error, 1, 0.15);  // to the next order of the perturbation
  const auto energy = [&](const ExperimentRun& run) {
    const RunRecord record = execute(run.resolved, nullptr);
    EXPECT_EQ(run.resolved.model->invariants()[0].name, "energy");
    return record.invariants().drift[0].maximum;
  };
  EXPECT_GT(energy(runs[0]), 100 * energy(runs[1]));
}

TEST_F(Frequencies, AreWrittenForEveryStepThatEndsWell) {
  const Experiment experiment = read(oscillators, R"(name = "orbit"
system = "kepler"
time = 60
steps = [0.2, 0.1]
methods = ["Verlet", "RK4"]
)" + pericentre);
  const auto runs = expand(experiment);
  std::vector<nlohmann::json> summaries(runs.size(), {{"status", "converged"}, {"checksum", "a"}});
  summaries[3]["status"] = "not_converged";
  References references;
  std::string notes;
  write_measures(files_.path(), experiment, runs, summaries, references, notes);
  EXPECT_EQ(notes, "");
  std::istringstream lines(text_in(files_.path() / "measures" / "frequency.csv").value_or(""));
  std::vector<std::string> begins;
  for (std::string line; std::getline(lines, line);) {
    std::size_t comma = 0;
    for (int k = 0; k < 5; ++k) comma = line.find(',', comma) + 1;
    begins.push_back(line.substr(0, comma));
  }
  EXPECT_EQ(begins, (std::vector<std::string>{"case,method,step,t,vector,", "orbit,Verlet,0.2,60,orbit,",
                                              "orbit,Verlet,0.2,60,pericentre,", "orbit,Verlet,0.1,60,orbit,",
                                              "orbit,Verlet,0.1,60,pericentre,", "orbit,RK4,0.2,60,orbit,",
                                              "orbit,RK4,0.2,60,pericentre,"}));
}

// With few samples a turn nobody knows how often it has turned.
TEST_F(Frequencies, OfVectorsThatTurnTooFarBetweenSamplesAreNotANumber) {
  const Experiment experiment = read(oscillators, R"(name = "swing"
system = "harmonic-oscillator"
set = { omega = 60 }
time = 5
steps = [0.05]
methods = ["midpoint"]
[[case.frequency]]
name = "phase"
x = "q"
y = "p"
)");
  EXPECT_TRUE(std::isnan(found(experiment)[0][0].error));
}

// What the settings of the measure lack, in words; several vectors are told apart by a |.
TEST(FrequencyMeasure, SaysWhatItNeeds) {
  using ::testing::HasSubstr;
  const auto run = integrate("harmonic-oscillator", {}, "verlet", {}, {.step = "0.1"});
  const auto refused = [&](const std::string& text) -> std::string {
    try {
      return measure_asked_for(text)->refuses(*run.model(), run.method());
    } catch (const InputError& error) {
      return error.what();
    }
  };
  for (const char* text : {"frequency(x=q, y=p)", "frequency(name=a | b, x=q | q, y=p | a*p, let=| a = 2)"})
    EXPECT_EQ(refused(text), "") << text;
  EXPECT_THAT(refused("frequency"), HasSubstr("needs the components of a vector"));
  EXPECT_THAT(refused("frequency(x=q)"), HasSubstr("needs the components of a vector"));
  EXPECT_THAT(refused("frequency(x=q | q, y=p)"), HasSubstr("as many of y and of name as of x, which are 2"));
  EXPECT_THAT(refused("frequency(x=q, y=p, let=| a = 2)"), HasSubstr("a list 'let' for each vector at most"));
  EXPECT_THAT(refused("frequency(x=q, y=p, let=a)"), HasSubstr("expected NAME = EXPRESSION, got 'a'"));
  EXPECT_THAT(refused("frequency(x=q, y=a*p)"), HasSubstr("unknown name 'a'"));
}

TEST_F(Frequencies, ExpressionsAreReadBeforeAnythingRuns) {
  const auto message = [&](const std::string& frequency) -> std::string {
    try {
      (void)expand(read(oscillators,
                        "name = \"swing\"\nsystem = \"harmonic-oscillator\"\ntime = 1\n"
                        "steps = [0.1]\n[[case.frequency]]\n" +
                            frequency));
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing thrown";
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(message("name = \"phase\"\nx = \"q\"\n"), HasSubstr("key 'y' is missing"));
  EXPECT_THAT(message("name = \"phase\"\nx = \"q\"\ny = \"pp\"\n"),
              AllOf(HasSubstr("case swing"), HasSubstr("frequency 'phase', component y"),
                    HasSubstr("unknown name 'pp'")));
  EXPECT_THAT(message("name = \"phase\"\nx = \"q +\"\ny = \"p\"\n"), HasSubstr("component x"));
  EXPECT_THAT(message("name = \"phase\"\nx = \"q\"\ny = \"p\"\nz = \"q\"\n"), HasSubstr("unknown key 'z'"));
}

}  // namespace
