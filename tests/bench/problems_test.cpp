// Which motions the runs of an experiment are compared with.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/experiment/problems.hpp>
#include <pfaff/bench/runner/files.hpp>

#include "../temporary_directory.hpp"

namespace {
using namespace pfaff;

// Two beads of unlike masses on rods, in a fluid: the friction of Dirac's formulation is reduced to the
// surface, where it is another force than Stokes's drag. Either is of fourth order against the motion that it
// steps.
class Problems : public ::testing::Test {
 protected:
  Experiment read(const std::string& friction) const {
    write_file(files / "rods.toml",
               "name = \"rods\"\ncoordinates = { q = 4, p = 4 }\n"
               "initial = [\"4/5\", \"-3/5\", \"9/5\", \"-3/5\", 0, 0, 0, 3]\n"
               "kinetic = \"(p[1]^2 + p[2]^2)/2 + (p[3]^2 + p[4]^2)/5\"\npotential = \"10*q[2] + 25*q[4]\"\n"
               "holonomic = [\"(q[1]^2 + q[2]^2 - 1)/2\", \"((q[3]-q[1])^2 + (q[4]-q[2])^2 - 1)/2\"]\n"
               "friction = " +
                   friction + "\n");
    write_file(files / "e.toml",
               "schema = 1\ntitle = \"two frictions\"\n"
               "[[method]]\nlabel = \"Dirac\"\nintegrator = \"gauss\"\nformulation = \"dirac\"\n"
               "[[method]]\nlabel = \"LMM\"\nintegrator = \"gauss\"\nformulation = \"lmm\"\n"
               "[[case]]\nname = \"c\"\nsystem = \"rods.toml\"\ntime = 1\nsteps = [0.02, 0.01]\n");
    return read_experiment(files / "e.toml", true);
  }
  pfaff::testing::TemporaryDirectory files;
};

TEST_F(Problems, FrictionOfAnotherFormIsAnotherMotion) {
  const Experiment experiment = read("[\"0.4\", \"0.4\", \"0.7\", \"0.7\"]");
  const auto runs = expand(experiment);
  ASSERT_EQ(runs.size(), 4U);
  EXPECT_EQ(problem_of(runs[0]), problem_of(runs[1]));
  EXPECT_NE(problem_of(runs[0]), problem_of(runs[2]));
  const ExperimentOutcome outcome =
      run_experiment(experiment, files / "out", {}, {.report = false, .timing = 0.001});
  EXPECT_THAT(outcome.table, ::testing::HasSubstr("metriplectic with Dirac; stokes with LMM"));
  for (std::size_t k = 0; k < runs.size(); k += 2) {
    const auto error = [&](const ExperimentRun& run) {
      const auto summary =
          nlohmann::json::parse(read_file(files / ("out/runs/" + run.slug + "/summary.json")));
      return summary["error_max"].get<double>();
    };
    EXPECT_NEAR(std::log2(error(runs[k]) / error(runs[k + 1])), 4, 0.3) << runs[k].method->label;
  }
}

TEST_F(Problems, WithoutFrictionFormulationsShareTheirMotion) {
  const Experiment experiment = read("[\"0\", \"0\", \"0\", \"0\"]");
  const auto runs = expand(experiment);
  EXPECT_EQ(problem_of(runs[0]), problem_of(runs[3]));
  EXPECT_EQ(said_of_problems(runs, std::vector<nlohmann::json>(runs.size())), "");
}

}  // namespace
