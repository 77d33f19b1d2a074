// Matrices that the motion needs regular and that are singular between two states of a run: constraints of
// velocities, second class constraints, structures. And what only looks like it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pfaff/bench/runner/files.hpp>
#include <pfaff/bench/runner/record.hpp>
#include <pfaff/runs/support/rank_watch.hpp>
#include <pfaff/tests/temporary_directory.hpp>

#include "../bench/kept_samples.hpp"

namespace pfaff {
namespace {
using namespace pfaff::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

class RankAlongRuns : public ::testing::Test {
 protected:
  RecordWithSamples run_of(const std::string& text, const std::string& method, const std::string& step,
                           const std::string& time, Precision precision = Precision::double_precision) {
    write_file(files_ / "model.toml", text);
    return run_named(files_ / "model.toml", method, step, time, precision);
  }
  static RecordWithSamples run_named(const std::string& system, const std::string& method,
                                     const std::string& step, const std::string& time,
                                     Precision precision = Precision::double_precision) {
    RunSettings s;
    s.system = system;
    s.integrator = method;
    (method == "taylor" ? s.tolerance : s.step) = step;
    s.time = time;
    s.precision = precision;
    s.reference = ErrorsAgainst::none;
    s.structure_residuals = false;
    return execute_and_keep(resolve(s), nullptr);
  }

 private:
  TemporaryDirectory files_;
};

// Motion in the plane with one constraint of velocities; it goes straight on with velocity (1, v).
std::string planar(const std::string& initial, const std::string& row) {
  return R"(name = "planar"
coordinates = ["x", "y", "z", "p_x", "p_y", "p_z"]
initial = [)" +
         initial + R"(]
kinetic = "(p_x^2 + p_y^2 + p_z^2)/2"
potential = "0"
velocity_constraints = [{ name = "turn", )" +
         row + R"( }]
invariants = { energy = "(p_x^2 + p_y^2 + p_z^2)/2" }
)";
}
constexpr const char* turning = R"(row = ["-y", "x", "0"])";

// The states at -1 + 0.1 k miss the singular point at t = 1.03 or, where they hit it, there at the latest.
TEST_F(RankAlongRuns, EndsRunsThroughAPointWhereARowOfConstraintsVanishes) {
  for (const char* method : {"rk4", "nonholonomic-lobatto", "dla", "velocity-projected-rk4"})
    for (const auto& [initial, row] : {std::pair{"-1.03, 0, 0, 1, 0, 0.25", turning},
                                       {"-1.03, -0.515, 0, 1, 0.5, 0.25", turning},
                                       {"-1.07, 0, 0, 1, 0, 0.25", R"(row = ["0", "x^2", "0"])"}}) {
      SCOPED_TRACE(std::string(method) + ": " + initial + ", " + row);
      const RecordWithSamples record = run_of(planar(initial, row), method, "0.1", "3");
      EXPECT_EQ(record.status, Status::singular);
      EXPECT_THAT(record.message, AllOf(HasSubstr("S = A H_pp A^T of the constraints of velocities is "
                                                  "singular between t = "),
                                        HasSubstr("its smallest pivot vanishes; this was seen at t = ")));
      EXPECT_GE(record.completed, 9);
      EXPECT_LE(record.completed, 11);
      EXPECT_LE(record.samples.size(), 12U);
    }
}
TEST_F(RankAlongRuns, EndsThemInQuadAndWithStepsOfTheMethodsChoosing) {
  const std::string model = planar("-1.03, 0, 0, 1, 0, 0.25", turning);
  EXPECT_EQ(run_of(model, "rk4", "0.1", "3", Precision::quad).status, Status::singular);
  EXPECT_EQ(run_of(model, "taylor", "1e-8", "3").status, Status::singular);
}
// Past the point at a hundredth of the step or less, and at many of them: the rows turn round quickly, and
// stay independent. The motion is a straight line whose angular momentum is 0.001.
TEST_F(RankAlongRuns, LetsRunsPassNearby) {
  const std::string model = planar("-1.03, 0, 0, 1, -0.00097087378640776699029126213592233, 0.25",
                                   R"(row = ["-y", "x", "0"], b = "-0.001")");
  for (const char* step : {"0.1", "0.01", "0.001"}) {
    const RecordWithSamples record = run_of(model, "rk4", step, "3");
    EXPECT_EQ(record.status, Status::converged) << step << ": " << record.message;
  }
}

// K = x^k on the line y = 0, along which x' = -1 whatever k is.
std::string line(int power) {
  const std::string k = std::to_string(power), next = std::to_string(power + 1);
  return "name = \"line\"\ncoordinates = [\"x\", \"y\"]\ninitial = [1.03, 0]\nbirkhoffian = \"x^" + k +
         "*y\"\none_form = [\"0\", \"x^" + next + "/" + next + "\"]\n";
}
TEST_F(RankAlongRuns, EndsRunsThroughAStructureThatIsSingular) {
  for (const char* method : {"rk4", "gauss", "leap-frog"}) {
    const RecordWithSamples odd = run_of(line(1), method, "0.1", "3"),
                            third = run_of(line(3), method, "0.1", "3"),
                            even = run_of(line(2), method, "0.1", "3");
    EXPECT_EQ(odd.status, Status::singular) << method;
    EXPECT_THAT(odd.message, HasSubstr("the structure K is singular between t = 1 and t = 1.1, where its "
                                       "Pfaffian changes its sign"));
    EXPECT_EQ(odd.completed, 10) << method;
    EXPECT_EQ(third.status, Status::singular) << method;
    EXPECT_EQ(even.status, Status::singular) << method;
    EXPECT_THAT(even.message, HasSubstr("its smallest pivot vanishes")) << method;
    EXPECT_EQ(run_of(line(0), method, "0.1", "3").status, Status::converged) << "the control: K = 1";
  }
}

// {q_2, q_1^k p_2} = q_1^k, and q_1 = -1.03 + t.
std::string second_class(const std::string& of_q1) {
  return R"(name = "second-class"
coordinates = ["q_1", "q_2", "p_1", "p_2"]
initial = [-1.03, 0, 1, 0]
hamiltonian = "(p_1^2 + p_2^2)/2"
constraints = ["q_2", "()" +
         of_q1 + ")*p_2\"]\n";
}
TEST_F(RankAlongRuns, EndsRunsThroughConstraintsThatStopBeingSecondClass) {
  for (const auto& [of_q1, sign] : {std::pair{"q_1", "its Pfaffian changes its sign"},
                                    {"q_1^3 + q_1", "its Pfaffian changes its sign"},
                                    {"q_1^2", "its smallest pivot vanishes"}})
    for (const Precision precision : {Precision::double_precision, Precision::quad}) {
      const RecordWithSamples record = run_of(second_class(of_q1), "rk4", "0.1", "3", precision);
      EXPECT_EQ(record.status, Status::singular) << of_q1;
      EXPECT_THAT(record.message, HasSubstr("the matrix C of the constraints' Poisson brackets is singular"));
      EXPECT_THAT(record.message, HasSubstr(sign));
    }
  // Controls: a pivot that merely gets small, by a factor of a million and more, and comes back.
  for (const char* of_q1 : {"q_1^2 + 1/1000000", "exp(-20*q_1)", "1/(1 + 1000*exp(-100*q_1^2))"}) {
    const RecordWithSamples record = run_of(second_class(of_q1), "rk4", "0.01", "3");
    EXPECT_EQ(record.status, Status::converged) << of_q1 << ": " << record.message;
  }
}

// K = e^{nu t} J leaves the range of doubles at t = 2365, where it is as regular as before.
TEST_F(RankAlongRuns, DoesNotTakeALargeStructureForASingularOne) {
  const RecordWithSamples record = run_named("damped-pendulum", "rk4", "0.5", "3000");
  EXPECT_EQ(record.completed, 6000) << record.message;
}

// The blade turns by 2 radians in a step: its row points back and forth, and is never zero.
TEST_F(RankAlongRuns, DoesNotTakeATurnForASingularRow) {
  const RecordWithSamples record =
      run_of(planar("0, 0, 0, 1, 0, 20", R"row(row = ["-sin(z)", "cos(z)", "0"])row"),
             "velocity-projected-rk4", "0.1", "5");
  EXPECT_EQ(record.status, Status::converged) << record.message;
}
// Shipped systems, over a time in which each of them is far from its start.
TEST_F(RankAlongRuns, FindsNothingInRegularRuns) {
  for (const char* system : {"four-bar",
                             "polar-double-pendulum",
                             "spherical-pendulum",
                             "torus-particle",
                             "shaken-pendulum",
                             "sphere-particle",
                             "n-pendulum",
                             "ring",
                             "humanoid",
                             "contact-oscillator",
                             "contact-particle",
                             "heisenberg-geodesic",
                             "knife-edge",
                             "quartic-nonholonomic",
                             "rolling-ball",
                             "rolling-disk",
                             "skate-chain",
                             "sleigh",
                             "coupled-damped-pendula",
                             "damped-bead-in-bowl",
                             "damped-pendulum",
                             "damped-relativistic-oscillator",
                             "dense-time-structure",
                             "driven-duffing",
                             "guiding-centre",
                             "hojman-urrutia",
                             "lotka-volterra",
                             "magnetic-induction",
                             "magnetic-planar",
                             "point-vortices"}) {
    const RecordWithSamples record = run_named(system, "rk4", "0.01", "5");
    EXPECT_EQ(record.status, Status::converged) << system << ": " << record.message;
  }
  // The control: the snakeboard's wheels come to stand in line, after which its constraints are dependent.
  EXPECT_EQ(run_named("snakeboard", "rk4", "0.01", "8").status, Status::singular);
}

TEST(SmallestPivots, AreThoseOfTheElimination) {
  std::vector<double> a{4, 2, 2, 3};  // pivots 4 and 2
  EXPECT_DOUBLE_EQ(smallest_pivot_of_symmetric(a, 2).size, 2);
  std::vector<double> dependent{1, 2, 2, 4};
  EXPECT_EQ(smallest_pivot_of_symmetric(dependent, 2).size, 0);
  // Pf = a_01 a_23 - a_02 a_13 + a_03 a_12 = 1*6 - 2*5 + 3*4 = 8: the pivots are 6 and 8/6.
  std::vector<double> skew{0, 1, 2, 3, -1, 0, 4, 5, -2, -4, 0, 6, -3, -5, -6, 0};
  const auto smallest = smallest_pivot_of_skew(skew, 4);
  EXPECT_NEAR(smallest.size, 8.0 / 6, 1e-15);
  EXPECT_EQ(smallest.sign, 1);
  std::vector<double> turned{0, -1, -2, -3, 1, 0, 4, 5, 2, -4, 0, 6, 3, -5, -6, 0};  // the first row negated
  EXPECT_EQ(smallest_pivot_of_skew(turned, 4).sign, -1);
}

}  // namespace
}  // namespace pfaff
