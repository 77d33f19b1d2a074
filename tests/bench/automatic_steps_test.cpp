// steps = "auto": which steps are chosen for methods of known error and cost, what is refused, and that the
// choice is kept in the runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include <pfaff/bench/experiment/automatic_steps.hpp>
#include <pfaff/bench/experiment/error_measure.hpp>
#include <pfaff/bench/experiment/team.hpp>
#include <pfaff/bench/runner/files.hpp>

#include "../temporary_directory.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::TemporaryDirectory;
using StepCounts = std::vector<std::int64_t>;

// A method of an order whose error at N steps is constant / N^order, but not below round-off, and which takes
// `stages` evaluations a step. `most` is the largest number of evaluations of one trial.
struct SteppedMethod {
  double order, constant, stages, round_off = 1e-13;
  mutable double most = 0;
  [[nodiscard]] double error(double count) const {
    return std::max(constant / std::pow(count, order), round_off);
  }
  [[nodiscard]] StepCounts chosen(double evaluations) const {
    return step_counts(
        [&](std::int64_t count, std::int64_t taken) {
          most = std::max(most, stages * static_cast<double>(taken));
          const double e = error(static_cast<double>(count));
          return StepTrial{stages * static_cast<double>(taken), e < 1 ? e : INFINITY};
        },
        evaluations);
  }
};

TEST(AutomaticSteps, AreFiveToEightFromSmallErrorsToRoundOff) {
  for (const double order : {1.0, 2.0, 4.0, 8.0, 16.0, 40.0}) {
    const SteppedMethod method{order, std::pow(30.0, order), 4};
    const StepCounts counts = method.chosen(1e12);
    SCOPED_TRACE(order);
    ASSERT_GE(counts.size(), fewest_automatic);
    ASSERT_LE(counts.size(), most_automatic);
    EXPECT_TRUE(std::is_sorted(counts.begin(), counts.end()));
    EXPECT_EQ(std::adjacent_find(counts.begin(), counts.end()), counts.end());
    // The first is within a rung of where the error is 0.1, the last one within a rung of round-off, and all
    // that stand between are on the slope.
    EXPECT_LE(method.error(static_cast<double>(counts.front())), 0.1);
    EXPECT_GT(method.error(static_cast<double>(counts.front()) / 1.61), 0.1);
    if (order >= 2) {
      EXPECT_LE(method.error(static_cast<double>(counts.back())), 10 * method.round_off);
    }
    EXPECT_GT(method.error(static_cast<double>(counts[counts.size() - 2])), method.round_off);
  }
}

// What lies above the limit is neither chosen nor tried; with more evaluations there would be finer steps.
TEST(AutomaticSteps, TakeNoMoreEvaluationsThanAllowed) {
  const SteppedMethod method{2, 900, 4};
  const StepCounts few = method.chosen(1e5);
  EXPECT_LE(method.most, 1e5);
  EXPECT_EQ(few, (StepCounts{100, 250, 400, 1000, 2500, 6400, 10000, 25000}));
  EXPECT_GT(method.chosen(1e6).back(), few.back());
}

TEST(AutomaticSteps, OfAMethodThatFailsEverywhereAreTheFinest) {
  const SteppedMethod method{1, 1e12, 1};
  EXPECT_EQ(method.chosen(1e4), (StepCounts{1600, 2500, 4000, 6400, 10000}));
  EXPECT_EQ(method.chosen(20), (StepCounts{10, 11, 13, 14, 16}));
  EXPECT_TRUE(method.chosen(12).empty());  // one rung is no choice
}

TEST(AutomaticSteps, OfAMethodWithoutErrorAreTheCoarsest) {
  EXPECT_EQ((SteppedMethod{4, 0, 1}.chosen(1e6)), (StepCounts{10, 16, 25, 40, 64}));
  EXPECT_EQ((SteppedMethod{4, 0, 1}.chosen(30)), (StepCounts{10, 13, 16, 20, 25}));
}

// Round-off that happens to be smaller at some fine step is not a slope: steps stay between 25 and 250 to the
// duration. Where the error does fall by the same amounts, they go on.
TEST(AutomaticSteps, LuckOnRoundOffIsNoSlope) {
  const auto finest = [](const std::vector<double>& factors, double evaluations) {
    return step_counts(
               [&](std::int64_t count, std::int64_t taken) {
                 const auto k =
                     static_cast<std::size_t>(std::llround(5 * std::log10(static_cast<double>(count) / 10)));
                 const double slope = std::pow(20.0 / static_cast<double>(count), 16);
                 return StepTrial{static_cast<double>(taken), slope + 1e-13 * factors.at(k)};
               },
               evaluations)
        .back();
  };
  std::vector<double> lucky(30, 1.0), falling;
  lucky[8] = 0.5, lucky[10] = 0.3, lucky[12] = 0.15;
  EXPECT_LE(finest(lucky, 1e6), 250);
  EXPECT_LE(finest(lucky, 3000), 250);
  for (int k = 0; k < 30; ++k) falling.push_back(std::pow(1.6, -k));
  EXPECT_EQ(finest(falling, 1e4), 10000);
}

// One small error among large ones is luck, and is not taken for the coarse end.
TEST(AutomaticSteps, ALuckyErrorIsPassedOver) {
  const auto trial = [](std::int64_t count, std::int64_t taken) {
    const double e = 1e6 / std::pow(static_cast<double>(count), 4);
    return StepTrial{static_cast<double>(taken), count == 16 ? 0.01 : e};
  };
  EXPECT_EQ(step_counts(trial, 1e6).front(), 64);
}

const char* const chosen_steps = R"(schema = 1
title = "A test"
[[method]]
label = "Gauss 4"
integrator = "gauss"
set = { stages = 2 }
[[method]]
label = "RK4"
integrator = "rk4"
[[method]]
label = "Dormand and Prince"
integrator = "odeint-dopri5"
tolerance = 1e-6
[[case]]
name = "chosen"
system = "damped-oscillator"
time = 10
initial = [1, 0]
steps = "auto"
evaluations = 4000
[[case]]
name = "given"
system = "damped-oscillator"
time = 10
steps = [0.5]
methods = ["RK4"]
)";

class AutomaticExperiment : public ::testing::Test {
 protected:
  TemporaryDirectory files_;
  Experiment read(const std::string& text) {
    write_file(files_ / "test.toml", text);
    return read_experiment(files_ / "test.toml", false);
  }
  // Runs it up to the timings, which take long.
  void run(const Experiment& of, const std::string& out) {
    const auto up_to_timings = [](const ExperimentStage& stage) {
      if (stage.phase > 1) throw RunError("stopped");
    };
    EXPECT_THROW((void)run_experiment(of, files_ / out, up_to_timings), RunError);
  }
  std::vector<std::string> runs_in(const std::string& out) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(files_ / (out + "/runs")))
      names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
  }
};

TEST_F(AutomaticExperiment, StepsAreChosenForEachMethodAndStayTheSame) {
  const Experiment of = read(chosen_steps);
  run(of, "first");
  run(of, "second");
  const auto runs = runs_in("first");
  EXPECT_EQ(runs, runs_in("second"));
  EXPECT_EQ(std::count(runs.begin(), runs.end(), "given-rk4-h0.5"), 1);
  EXPECT_EQ(std::count(runs.begin(), runs.end(), "chosen-dormand-and-prince-tol1e-6"), 1);
  for (const char* method : {"chosen-rk4-h", "chosen-gauss-4-h"}) {
    std::vector<double> errors;
    for (const std::string& name : runs) {
      if (!name.starts_with(method)) continue;
      const std::string in = "first/runs/" + name;
      const auto summary = nlohmann::json::parse(read_file(files_ / (in + "/summary.json")));
      errors.push_back(summary["error_max"].get<double>());
      EXPECT_LE(summary["counts"]["right_hand_sides"].get<double>(), 4000) << name;
      EXPECT_EQ(summary["time"], "10");
      // The step is in the configuration, which is the same bytes each time.
      EXPECT_NE(read_file(files_ / (in + "/config.toml")).find("step = "), std::string::npos);
      EXPECT_EQ(read_file(files_ / (in + "/config.toml")),
                read_file(files_ / ("second/runs/" + name + "/config.toml")));
    }
    EXPECT_GE(errors.size(), fewest_automatic) << method;
    EXPECT_LE(errors.size(), most_automatic) << method;
    EXPECT_LE(*std::max_element(errors.begin(), errors.end()), 0.1) << method;
    EXPECT_LT(*std::min_element(errors.begin(), errors.end()), 1e-6) << method;
  }
}

TEST_F(AutomaticExperiment, ResumedItChoosesTheSameAndKeepsItsRuns) {
  const Experiment of = read(chosen_steps);
  run(of, "out");
  const auto runs = runs_in("out");
  std::filesystem::remove_all(files_ / ("out/runs/" + runs.front()));
  std::size_t kept = 0;
  const auto count = [&](const ExperimentStage& stage) {
    if (stage.phase == 1 && stage.all == runs.size() && kept == 0) kept = stage.done;
    if (stage.phase > 1) throw RunError("stopped");
  };
  EXPECT_THROW((void)run_experiment(of, files_ / "out", count), RunError);
  EXPECT_EQ(kept, runs.size() - 1);
  EXPECT_EQ(runs_in("out"), runs);
  // Other evaluations make another experiment, which the directory does not take.
  std::string other = chosen_steps;
  other.replace(other.find("4000"), 4, "9000");
  EXPECT_THROW((void)run_experiment(read(other), files_ / "out", {}), InputError);
}

TEST_F(AutomaticExperiment, AskedToStopItEndsBeforeItsRuns) {
  const std::atomic<bool> stop = true;
  const ExperimentOutcome outcome = run_experiment(read(chosen_steps), files_ / "out", {}, {.stop = &stop});
  EXPECT_TRUE(outcome.interrupted);
  EXPECT_FALSE(std::filesystem::exists(files_ / "out/runs"));
}

// A process that does not lead takes what the leading one has chosen, whatever it is.
class Follower final : public Team {
 public:
  [[nodiscard]] bool leads() const override { return false; }
  [[nodiscard]] bool several() const override { return true; }
  std::vector<std::size_t> agreed(const std::function<std::vector<std::size_t>()>&) override {
    // Nothing for the directory; then for Gauss one step number and for RK4 two; then the runs that are open.
    const std::vector<std::vector<std::size_t>> answers{{}, {1, 10, 2, 20, 40}, {0, 1, 2, 3, 4}};
    return answers.at(asked_++);
  }
  void share(std::size_t count, const std::function<bool(std::size_t)>& make,
             const std::function<void(std::size_t)>&) override {
    for (std::size_t k = 0; k < count; ++k) (void)make(k);
  }

 private:
  std::size_t asked_ = 0;
};

TEST_F(AutomaticExperiment, ProcessesTakeTheStepsThatTheLeadingOneHasChosen) {
  Follower follower;
  std::filesystem::create_directories(files_ / "out/runs");
  (void)run_experiment(read(chosen_steps), files_ / "out", {}, {.team = &follower});
  EXPECT_EQ(runs_in("out"),
            (std::vector<std::string>{"chosen-dormand-and-prince-tol1e-6", "chosen-gauss-4-h1",
                                      "chosen-rk4-h0.25", "chosen-rk4-h0.5", "given-rk4-h0.5"}));
}

TEST_F(AutomaticExperiment, QuickRunsMayHaveAListInstead) {
  std::string text = chosen_steps;
  text.replace(text.find("evaluations = 4000"), 18, "evaluations = 4000\n[case.quick]\nsteps = [0.5, 0.25]");
  write_file(files_ / "test.toml", text);
  EXPECT_TRUE(read_experiment(files_ / "test.toml", false).cases.at(0).automatic);
  const Experiment quick = read_experiment(files_ / "test.toml", true);
  EXPECT_FALSE(quick.cases.at(0).automatic);
  EXPECT_EQ(quick.cases.at(0).steps, (std::vector<std::string>{"0.5", "0.25"}));
}

// An experiment with one method, whose cases are to follow.
const std::string rk4_alone = R"(schema = 1
title = "A test"
[[method]]
label = "RK4"
integrator = "rk4"
)";

// By the error of the energy, without a solution: the steps are those of that error, which is written into
// results.csv and is what the samples of the run say.
TEST_F(AutomaticExperiment, StepsMayBeChosenByAConservedQuantity) {
  const Experiment of = read(rk4_alone + R"([[case]]
name = "orbit"
system = "kepler"
time = 20
steps = "auto"
evaluations = 20000
error = "energy"
reference = "none"
structure = "none"
)");
  run(of, "out");
  double least = 1;
  for (const std::string& name : runs_in("out")) {
    const auto summary = nlohmann::json::parse(read_file(files_ / ("out/runs/" + name + "/summary.json")));
    EXPECT_TRUE(summary["error_max"].is_null());
    const auto& energy = summary["invariants"][0];
    ASSERT_EQ(energy["name"], "energy");
    // H = -1/2 at the start, so that the relative error is twice the absolute one.
    EXPECT_NEAR(energy["initial"].get<double>(), -0.5, 1e-15);
    const double error = error_of(of.cases.front(), summary);
    EXPECT_DOUBLE_EQ(error, 2 * energy["max"].get<double>());
    EXPECT_LE(error, 0.1) << name;
    least = std::min(least, error);
    nlohmann::json false_summary = summary;  // control: another start makes another error
    false_summary["invariants"][0]["initial"] = 1.0;
    EXPECT_DOUBLE_EQ(error_of(of.cases.front(), false_summary), error / 2);
    false_summary["invariants"][0]["name"] = "momentum";
    EXPECT_TRUE(std::isnan(error_of(of.cases.front(), false_summary)));
  }
  EXPECT_LT(least, 1e-6);
}

// A pendulum that hangs at rest has the energy that its potential is counted from; relative to zero nothing
// is small.
TEST_F(AutomaticExperiment, AQuantityThatIsZeroAtTheStartIsNoMeasure) {
  const Experiment of = read(rk4_alone + R"([[case]]
name = "still"
system = "harmonic-oscillator"
initial = [0, 0]
time = 20
steps = [0.1]
error = "energy"
)");
  try {
    (void)expand(of);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("case still, method RK4: key 'error'"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("not zero at the start"), std::string::npos);
  }
}
}  // namespace
