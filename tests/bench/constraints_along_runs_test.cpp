// Constraints and structure along whole runs. A claim is judged in a step or eight from one state; an
// iteration that ends too early in one step of a hundred is found by measuring every step of a run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pfaff/bench/runner/files.hpp>
#include <pfaff/bench/runner/record.hpp>
#include <pfaff/tests/temporary_directory.hpp>

namespace pfaff {
namespace {
using namespace pfaff::testing;
using ::testing::HasSubstr;

// A five-bar linkage in the angles of its links, with point masses at the joints and a coupler of its own
// inertia: the mass matrix depends on the angles, and two equations close the loop. `coupled` is the entry
// that couples two angles; with 1.4 the mass matrix is nearly singular where the links are in line.
std::string five_bar(const std::string& coupled) {
  return R"text(
name = "five-bar"
coordinates = ["a", "b", "c", "d", "p_a", "p_b", "p_c", "p_d"]
initial = [2.0, 0.6, 1.2, 2.6, 0.4, 0, 0, 0]
hamiltonian = "kinetic + height"
invariants = { energy = "kinetic + height" }

[holonomic]
across = "cos(a) + 1.2*cos(b) - 1.5 - cos(c) - 1.3*cos(d)"
up = "sin(a) + 1.2*sin(b) - sin(c) - 1.3*sin(d)"

[let]
m_aa = "1.8"
m_ab = ")text" +
         coupled + R"text(*cos(a - b)"
m_bb = "1.152"
links = "(m_bb*p_a^2 - 2*m_ab*p_a*p_b + m_aa*p_b^2)/(2*(m_aa*m_bb - m_ab^2))"
kinetic = "links + p_c^2/2 + p_d^2/0.8"
height = "9.81*(1.8*sin(a) + 0.96*sin(b) + sin(c))"
)text";
}

struct WholeRun {
  RunRecord record;
  std::int64_t steps = 0;
  double unit = 0;  // of round-off
};
WholeRun whole_run(const std::string& system, const std::string& method, const std::string& step,
                   const std::string& time, const Assignments& set, Precision precision) {
  RunSettings s;
  s.system = system;
  s.integrator = method;
  s.step = step;
  s.time = time;
  s.set = set;
  s.precision = precision;
  s.project_initial = true;
  s.reference = ErrorsAgainst::none;
  const ResolvedRun run = resolve(s);
  return {execute(run, nullptr), run.steps, precision == Precision::quad ? 0x1p-113 : 0x1p-53};
}

// The largest residual of each level at any step, and of the structure at some fifty, in units of round-off.
void expect_at_round_off(const WholeRun& run, double positions, double momenta, double structure) {
  EXPECT_EQ(run.record.status, Status::converged) << run.record.message;
  EXPECT_EQ(run.record.completed, run.steps);
  ASSERT_EQ(run.record.constraints().drift.size(), 2U);
  EXPECT_LE(run.record.constraints().drift[0].maximum, positions * run.unit);
  EXPECT_LE(run.record.constraints().drift[1].maximum, momenta * run.unit);
  ASSERT_TRUE(run.record.structure_residual);
  EXPECT_LE(*run.record.structure_residual, structure * run.unit);
}

// Lengths are about 1, and momenta and their rates about 5. Steps that move by a radian add up to ten
// numbers of that size for a position.
TEST(ConstraintsAlongRuns, AreKeptByLobattoPairsWhereTheMassMatrixDependsOnThePositions) {
  for (const Precision precision : {Precision::double_precision, Precision::quad}) {
    const bool quad = precision == Precision::quad;
    for (const char* stages : {"2", "3", "4"}) {
      SCOPED_TRACE(stages);
      for (const auto& [step, time] : {std::pair{"0.01", "10"}, {"0.05", "20"}})
        expect_at_round_off(whole_run("polar-double-pendulum", "lobatto-spark", step, quad ? "5" : time,
                                      {{"stages", stages}}, precision),
                            16, 32, 64);
    }
  }
  expect_at_round_off(
      whole_run("polar-double-pendulum", "lobatto-spark", "0.2", "200", {}, Precision::double_precision), 64,
      32, 64);
}
// Angles grow to 14, momenta to 10. Structure is measured in tangent vectors of a surface that bends, of
// which differences of a few hundred units remain.
TEST(ConstraintsAlongRuns, AreKeptInALinkage) {
  TemporaryDirectory files;
  for (const auto& [coupled, step, time, precision] :
       {std::tuple{"0.96", "0.005", "5", Precision::double_precision},
        {"0.96", "0.01", "5", Precision::double_precision},
        {"1.2", "0.02", "1.9", Precision::double_precision},
        {"0.96", "0.01", "1", Precision::quad}}) {
    SCOPED_TRACE(std::string(coupled) + ", " + step);
    write_file(files / "five-bar.toml", five_bar(coupled));
    expect_at_round_off(whole_run(files / "five-bar.toml", "lobatto-spark", step, time, {}, precision), 64,
                        256, 1024);
  }
}
// The mass matrix of links that are coupled as strongly as this is nearly singular on the way, where steps no
// longer converge: the run then ends and says so, and does not take what is 1e5 units off for converged.
TEST(ConstraintsAlongRuns, AreKeptUpToAStepThatDoesNotConverge) {
  TemporaryDirectory files;
  write_file(files / "five-bar.toml", five_bar("1.4"));
  const WholeRun run =
      whole_run(files / "five-bar.toml", "lobatto-spark", "0.02", "1.9", {}, Precision::double_precision);
  EXPECT_EQ(run.record.status, Status::not_converged);
  EXPECT_GT(run.record.completed, 50);
  EXPECT_LE(run.record.constraints().drift[0].maximum, 64 * run.unit);
  EXPECT_LE(run.record.constraints().drift[1].maximum, 256 * run.unit);
}
TEST(ConstraintsAlongRuns, AreKeptByEveryMethodThatClaimsThem) {
  for (const char* method : {"lobatto-spark", "rattle"})
    for (const char* step : {"0.005", "0.01", "0.02"}) {
      SCOPED_TRACE(std::string(method) + step);
      expect_at_round_off(whole_run("four-bar", method, step, "10", {}, Precision::double_precision), 32, 64,
                          64);
    }
}
// The control: SHAKE leaves the hidden constraints, by the square of the step, and the measure sees it.
TEST(ConstraintsAlongRuns, AreSeenToBeMissed) {
  const WholeRun run = whole_run("four-bar", "shake", "0.01", "5", {}, Precision::double_precision);
  EXPECT_EQ(run.record.status, Status::converged);
  EXPECT_LE(run.record.constraints().drift[0].maximum, 32 * run.unit);
  EXPECT_GT(run.record.constraints().drift[1].maximum, 1e-5);
}

// A straight chain whose bobs move at random is stiff: its reactions change within a step by as much as they
// are large, so that those of the step before lead away from the solution. The state alone leads to it.
TEST(ConstraintsAlongRuns, AreFoundAfreshWhereThePastMisleads) {
  for (const auto& [bobs, step, time] :
       {std::tuple{"1000", "0.01", "0.05"}, {"2000", "0.005", "0.025"}, {"10000", "0.001", "0.003"}}) {
    SCOPED_TRACE(bobs);
    const WholeRun run =
        whole_run("n-pendulum", "rattle", step, time, {{"bobs", bobs}}, Precision::double_precision);
    EXPECT_EQ(run.record.status, Status::converged) << run.record.message;
    EXPECT_EQ(run.record.completed, run.steps);
    // Positions are as large as there are bobs, and so is what they are rounded by.
    EXPECT_LE(run.record.constraints().drift[0].maximum, 8 * std::stod(bobs) * run.unit);
  }
  // The control: a step that is too long from the state alone is not taken.
  const WholeRun long_steps = whole_run("n-pendulum", "rattle", "0.05", "4", {}, Precision::double_precision);
  EXPECT_EQ(long_steps.record.status, Status::not_converged);
  EXPECT_THAT(long_steps.record.message, HasSubstr("did not converge"));
}

// The class of a residual at round-off is round-off, in either precision, for a method that has the sphere as
// a quadratic invariant. The control is RK4: its residual of 2.6e-12, however small, is a trend.
TEST(ConstraintsAlongRuns, AtRoundOffHaveNoTrend) {
  const auto classes = [](const char* method, Precision precision) {
    const WholeRun run = whole_run("sphere-particle", method, "0.01", "10", {}, precision);
    return std::pair(run.record.constraints().drift[0].drift_class,
                     run.record.constraints().drift[1].drift_class);
  };
  const std::pair none(DriftClass::round_off, DriftClass::round_off);
  EXPECT_EQ(classes("gauss", Precision::double_precision), none);
  EXPECT_EQ(classes("gauss", Precision::quad), none);
  EXPECT_EQ(classes("rk4", Precision::double_precision).first, DriftClass::linear);
}

}  // namespace
}  // namespace pfaff
