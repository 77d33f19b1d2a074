// Explicit methods do not look at what they make: where a step is not finite, the run ends with the state
// before it, and says which smaller step would have worked from there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <pfaff/bench/runner/files.hpp>
#include <pfaff/bench/runner/record.hpp>
#include "../temporary_directory.hpp"
#include "kept_samples.hpp"

namespace pfaff {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::TemporaryDirectory;

class FailedSteps : public ::testing::Test {
 protected:
  // x' = -sqrt(x) from x = 1 is (1 - t/2)^2 and has no solution beyond t = 2, nor a root of what is below 0.
  // The particle of the second system falls onto q = 1, where its force is not finite.
  ResolvedRun resolved(const std::string& model, const std::string& method, const std::string& step,
                       const std::string& time, std::int64_t every, const std::string& tolerance = "") {
    write_file(files_.path() / "root.toml", "coordinates = [\"x\"]\nfield = [\"-sqrt(x)\"]\ninitial = [1]\n");
    write_file(files_.path() / "well.toml",
               "coordinates = [\"q\", \"p\"]\nkinetic = \"p^2/2\"\npotential = \"sqrt(1 - q)\"\n"
               "initial = [0, 0]\n");
    RunSettings s;
    s.system = files_ / (model + ".toml");
    s.integrator = method;
    (tolerance.empty() ? s.step : s.tolerance) = tolerance.empty() ? step : tolerance;
    s.time = time;
    if (tolerance.empty()) s.every = every;
    s.reference = ErrorsAgainst::none;
    return resolve(s);
  }

 private:
  TemporaryDirectory files_;
};

// A step of the classical method for x' = -sqrt(x), written out.
double rk4_step(double x, double h) {
  const auto f = [](double y) { return -std::sqrt(y); };
  const double a = f(x), b = f(x + h / 2 * a), c = f(x + h / 2 * b), d = f(x + h * c);
  return x + h / 6 * (a + 2 * b + 2 * c + d);
}

TEST_F(FailedSteps, AreNotCountedAndTheSearchBeginsBeforeThem) {
  for (const char* step : {"0.3", "0.17", "0.11"}) {
    SCOPED_TRACE(step);
    const double h = std::stod(step);
    double x = 1;
    int taken = 0;
    for (double next = 0; std::isfinite(next = rk4_step(x, h)); ++taken) x = next;
    double works = 0, fails = h;
    for (int k = 0; k < 60; ++k) {
      const double middle = (works + fails) / 2;
      (std::isfinite(rk4_step(x, middle)) ? works : fails) = middle;
    }
    const testing::RecordWithSamples record =
        testing::execute_and_keep(resolved("root", "rk4", step, "3", 1), nullptr);
    EXPECT_EQ(record.status, Status::non_finite);
    EXPECT_EQ(record.completed, taken);
    ASSERT_EQ(record.samples.size(), static_cast<std::size_t>(taken) + 1);
    EXPECT_NEAR(static_cast<double>(record.samples.back().t), taken * h, 1e-14);
    // The last states halve the digits of their difference from 0 in a step of the worst condition.
    EXPECT_NEAR(static_cast<double>(record.samples.back().state[0]), x, 1e-12);
    EXPECT_THAT(record.message, HasSubstr("(step " + std::to_string(taken) + ")"));
    const std::string said = "from there a step of ";
    const std::size_t at = record.message.find(said);
    ASSERT_NE(at, std::string::npos) << record.message;
    const double largest = std::stod(record.message.substr(at + said.size()));
    // The search ends to 1/32 of the interval that it begins with, and the number has three digits.
    EXPECT_LE(largest, works * 1.005);
    EXPECT_GE(largest, works * 0.93);
  }
}

// Long runs are looked at between blocks of steps. What a block hides is found by its steps one by one, with
// the history of the run: the same number of them, and the same state, from which the same step works.
TEST_F(FailedSteps, WithinABlockAreFoundOneByOne) {
  for (const auto& [model, method] :
       {std::pair{"root", "rk4"}, std::pair{"root", "odeint-rk4"}, std::pair{"root", "odeint-dopri5"},
        std::pair{"root", "leap-frog"}, std::pair{"well", "verlet"}, std::pair{"well", "rk4"},
        std::pair{"well", "composition"}, std::pair{"well", "odeint-mclachlan"},
        std::pair{"well", "extrapolation"}}) {
    const testing::RecordWithSamples one =
        testing::execute_and_keep(resolved(model, method, "0.013", "10", 1), nullptr);
    EXPECT_EQ(one.status, Status::non_finite) << one.message;
    for (const std::int64_t block : {2, 7, 20}) {
      SCOPED_TRACE(std::string(method) + " on " + model + ", blocks of " + std::to_string(block));
      const std::string time = std::to_string(26000 * block);  // 2e6 steps for each of a block
      const testing::RecordWithSamples several =
          testing::execute_and_keep(resolved(model, method, "0.013", time, block), nullptr);
      EXPECT_EQ(several.status, one.status);
      EXPECT_EQ(several.completed, one.completed);
      EXPECT_EQ(several.message, one.message);
      EXPECT_EQ(several.samples.size(), static_cast<std::size_t>(one.completed / block) + 1);
    }
  }
}

// The state of a stepper is never left in what is not finite, whatever the number of steps, and neither is
// its history: the next steps are those of one that has none.
TEST_F(FailedSteps, LeaveAStepperThatCanGoOn) {
  for (const char* method : {"rk4", "leap-frog"})
    for (const std::int64_t count : {1, 3, 100}) {
      const ResolvedRun run = resolved("root", method, "0.3", "3", 1);
      const auto stepper = run.method->stepper(run.model, double()),
                 fresh = run.method->stepper(run.model, double());
      std::vector<double> z{0.01}, other = z;
      std::int64_t completed = -1;
      EXPECT_EQ(stepper->advance(0, 0, 0.3, count, z, completed), Status::non_finite);
      EXPECT_EQ(completed, 0);
      EXPECT_EQ(z[0], 0.01);
      EXPECT_EQ(stepper->counters().steps, 0);
      EXPECT_EQ(stepper->advance(0, 0, 0.01, 3, z, completed), Status::converged);
      EXPECT_EQ(completed, 3);
      EXPECT_EQ(fresh->advance(0, 0, 0.01, 3, other, completed), Status::converged);
      EXPECT_EQ(z, other);
    }
}

// With steps of the method's own choosing, counted up to where they got to.
TEST_F(FailedSteps, OfAStepControlAreNotCounted) {
  for (const auto& [model, method] :
       {std::pair{"root", "odeint-dopri5"}, std::pair{"well", "odeint-dopri5"},
        std::pair{"root", "odeint-bulirsch-stoer"}, std::pair{"well", "taylor"}}) {
    SCOPED_TRACE(std::string(method) + " on " + model);
    const ResolvedRun run = resolved(model, method, "", "3", 1, "1e-6");
    const testing::RecordWithSamples record = testing::execute_and_keep(run, nullptr);
    EXPECT_NE(record.status, Status::converged);
    EXPECT_EQ(record.completed, record.counters.steps);
    for (const Sample<Quad>& sample : record.samples)
      for (const Quad& x : sample.state) EXPECT_TRUE(isfinite(x));
    const auto stepper = run.method->stepper(run.model, double());
    std::vector<double> z;
    for (const Real& x : run.initial) z.push_back(x.value());
    double t = 0;
    EXPECT_NE(stepper->advance_to(t, 3, 1e-6, z), Status::converged);
    for (const double x : z) EXPECT_TRUE(std::isfinite(x));
    EXPECT_LT(t, 3);
  }
}

// A method that looks at nothing, and leaves the range of numbers with its third step.
struct Careless {
  template <class P>
  struct Work {
    double taken = 0;
    Work(const Careless& /*method*/, const P& /*p*/) {}
  };
  template <class P>
  Status step(const P& /*p*/, const double& /*t*/, const double& h, State<P>& z, Work<P>& w) const {
    z[0] += h;
    if (++w.taken > 2) z[0] = std::numeric_limits<double>::quiet_NaN();
    return Status::converged;
  }
  template <class P, class Asked>
  Status advance_to(const P& p, double& t, double end, const Asked& /*tolerance*/, State<P>& z,
                    Work<P>& w) const {
    while (t < end) {
      (void)step(p, t, 0.25, z, w);
      t += 0.25;
      ++p.counters().steps;
    }
    return Status::converged;
  }
};

TEST_F(FailedSteps, OfACarelessMethodLeaveEverythingAsItWas) {
  detail::SteppingOn<Careless, Problem<double>> stepper({}, resolved("root", "rk4", "0.1", "1", 1).model);
  std::vector<double> z{1};
  std::int64_t completed = -1;
  double t = 0;
  for (int again = 0; again < 2; ++again) {  // the second time with the history of a new one
    const double begin = z[0];
    EXPECT_EQ(stepper.advance(0, 0, 0.5, 3, z, completed), Status::non_finite);
    EXPECT_EQ(completed, 0);
    EXPECT_EQ(z[0], begin);
    EXPECT_EQ(stepper.advance(0, 0, 0.5, 2, z, completed), Status::converged);
    EXPECT_EQ(completed, 2);
    EXPECT_EQ(z[0], begin + 1);
    EXPECT_EQ(stepper.advance(0, 0, 0.5, 1, z, completed), Status::non_finite);
    EXPECT_EQ(completed, 0);
    EXPECT_EQ(z[0], begin + 1);
  }
  const std::int64_t steps = stepper.counters().steps;
  EXPECT_EQ(steps, 4);
  EXPECT_EQ(stepper.advance_to(t, 1, 1e-6, z), Status::non_finite);
  EXPECT_EQ(t, 0);
  EXPECT_EQ(z[0], 3);
  EXPECT_EQ(stepper.counters().steps, steps);
  EXPECT_EQ(stepper.advance_to(t, 0.5, 1e-6, z), Status::converged);
  EXPECT_EQ(t, 0.5);
  EXPECT_EQ(z[0], 3.5);
}

}  // namespace
}  // namespace pfaff
