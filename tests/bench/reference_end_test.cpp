// Reference solutions that end before they were asked to: where the motion blows up, where a budget or a
// request ends them, and what is then said of the errors of a run.
#include <gtest/gtest.h>

#include <atomic>
#include <limits>

#include <pfaff/bench/runner/files.hpp>
#include <pfaff/bench/runner/record.hpp>
#include <pfaff/core/errors/budget.hpp>

#include "../runs/reference_samples.hpp"
#include "../temporary_directory.hpp"
#include "kept_samples.hpp"
#include "run_settings.hpp"

namespace {

using namespace pfaff;
using pfaff::testing::sample_motion;
using pfaff::testing::start_of_sample;

struct Quintic {  // v' = 1 + v^5, infinite at pi / (5 sin(pi / 5)) from v = 0
  static constexpr int dimension = 1;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    const T square = z[0] * z[0];
    rate[0] = T(1) + square * square * z[0];
  }
};
struct Spinning {  // blows up while it turns ever faster, so that steps get short long before the end
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1] + z[1] * z[1] / 2;
    rate[1] = -(z[0] + T(3) * z[0] * z[0] / 5 + sin(z[0]) / 4);
  }
};
struct DrainingTank {  // z' = -sqrt(z) - 1, no number from z = 0 on, at t = 2 - 2 log 2 from z = 1
  static constexpr int dimension = 1;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = -sqrt(z[0]) - T(1);
  }
};
struct LosingDigits {  // Lorenz's equations lose a digit in two and a half units of time
  static constexpr int dimension = 3;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = T(10) * (z[1] - z[0]);
    rate[1] = z[0] * (T(28) - z[2]) - z[1];
    rate[2] = z[0] * z[1] - T(8) * z[2] / 3;
  }
};

std::string end_of_flow(const std::shared_ptr<const Model>& model, Quad time) {
  std::vector<Quad> z = start_of_sample(*model);
  try {
    taylor_flow(*model, Quad(0), time, z);
  } catch (const SolutionEnds& ends) {
    return ends.what();
  }
  return "it did not end";
}
ReferenceSolution solution_of(const std::shared_ptr<const Model>& model, Quad time) {
  return {model, Quad(0), start_of_sample(*model), time};
}
void expect_end(const std::shared_ptr<const Model>& model, Quad time, const std::string& words, Quad last) {
  const std::string found = "the solution was found up to t = ";
  EXPECT_EQ(end_of_flow(model, time).find(found), 0U) << end_of_flow(model, time);
  const ReferenceSolution solution = solution_of(model, time);
  EXPECT_EQ(solution.ended().find(found + words), 0U) << solution.ended();
  EXPECT_TRUE(solution.covers(last * Quad(0.99)));
  EXPECT_FALSE(solution.covers(last * Quad(1.01)));
  EXPECT_THROW((void)solution.at(last * Quad(1.01)), SolutionEnds);
  EXPECT_TRUE(isfinite(solution.at(last * Quad(0.99))[0]));
}

TEST(ReferenceEnd, Poles) {
  expect_end(sample_motion(Quintic{}, {0}), Quad(2), "1.06895933", Quad(1.068959332115595));
}
TEST(ReferenceEnd, MotionThatTurnsEverFaster) {
  expect_end(sample_motion(Spinning{}, {1, 0}), Quad(20), "3.73", Quad(3.7352));
}
TEST(ReferenceEnd, EndOfTheDomain) {
  expect_end(sample_motion(DrainingTank{}, {1}), Quad(1), "0.6137", Quad(2 - 2 * 0.6931471805599453));
}
// Control: what goes on is found, and to the end.
TEST(ReferenceEnd, NoneWhereTheMotionGoesOn) {
  const auto model = sample_motion(Quintic{}, {0});
  EXPECT_EQ(end_of_flow(model, Quad(1)), "it did not end");
  EXPECT_EQ(solution_of(model, Quad(1)).ended(), "");
}

// What is claimed is what two orders have in common: fewer digits as time goes on, and none in the end.
TEST(ReferenceEnd, ChaosLosesDigitsAndThenTheSolution) {
  const auto model = sample_motion(LosingDigits{}, {1, 2, 3});
  EXPECT_EQ(solution_of(model, Quad(1)).kind(), "30-digit");
  const std::string kind = solution_of(model, Quad(20)).kind();
  EXPECT_TRUE(kind < "29-digit" && kind > "20-digit") << kind;
  const ReferenceSolution lost = solution_of(model, Quad(80));
  EXPECT_NE(lost.ended().find("two orders agree in less than 20 digits"), std::string::npos) << lost.ended();
  EXPECT_TRUE(lost.covers(Quad(15)));
  EXPECT_FALSE(lost.covers(Quad(70)));
}

TEST(ReferenceEnd, BudgetsAndRequests) {
  const auto model = sample_motion(LosingDigits{}, {1, 2, 3});
  {
    const Budget budget({.steps = 40});
    const ReferenceSolution solution = solution_of(model, Quad(20));
    EXPECT_NE(solution.ended().find("budget of 40 steps"), std::string::npos) << solution.ended();
    EXPECT_FALSE(solution.covers(Quad(20)));
  }
  const std::atomic<bool> stop{true};
  const Budget budget({}, &stop);
  EXPECT_THROW((void)solution_of(model, Quad(20)), BudgetSpent);
  std::vector<Quad> z{Quad(1), Quad(2), Quad(3)};
  EXPECT_THROW(taylor_flow(*model, Quad(0), Quad(1), z), BudgetSpent);
}

// The example of a run: errors are measured up to where the solution was found, and the summary says so.
TEST(ReferenceEnd, ErrorsOfARunEndWithTheSolution) {
  const pfaff::testing::TemporaryDirectory directory;
  const std::string file = directory / "blowing.toml";
  write_file(file,
             "name = \"blowing\"\ncoordinates = [\"q\", \"p\"]\n"
             "kinetic = \"p^2/2 + p^3/6\"\npotential = \"q^2/2 + q^3/5 - cos(q)/4\"\ninitial = [1, 0]\n");
  RunSettings settings;
  settings.system = file;
  settings.integrator = "rk4";
  settings.step = "0.1";
  settings.time = "20";
  settings.every = 1;
  settings.reference = ErrorsAgainst::solution;
  const ResolvedRun run = resolve(settings);
  const auto solution = reference_asked_for(run);
  const pfaff::testing::RecordWithSamples record = pfaff::testing::execute_and_keep(run, solution.get());
  ASSERT_GT(record.samples.size(), 36U);
  EXPECT_TRUE(record.samples[37].error.has_value());  // t = 3.7
  for (std::size_t k = 38; k < record.samples.size(); ++k) EXPECT_FALSE(record.samples[k].error.has_value());
  const nlohmann::json j = summary(run, record);
  EXPECT_EQ(j["reference_ended"].get<std::string>().find("the solution was found up to t = 3.73"), 0U);
  EXPECT_TRUE(j["error_max"].is_number());
}

// A solution that reaches no sample behind the start leaves no error, for that of the start is zero.
TEST(ReferenceEnd, NoErrorsWithoutASolution) {
  RunSettings settings;
  settings.system = "damped-pendulum";
  settings.integrator = "rk4";
  settings.step = "1";
  settings.time = "10";
  settings.reference = ErrorsAgainst::solution;
  const ResolvedRun run = resolve(settings);
  for (const std::int64_t steps : {0, 4, 1000}) {
    const auto solution = [&] {
      const Budget budget({.steps = steps});
      return reference_asked_for(run);
    }();
    const pfaff::testing::RecordWithSamples record = pfaff::testing::execute_and_keep(run, solution.get());
    const nlohmann::json j = summary(run, record);
    EXPECT_EQ(j["error_max"].is_null(), steps < 1000) << j["error_max"];
    EXPECT_EQ(j.contains("reference_ended"), steps < 1000);
  }
}

}  // namespace
