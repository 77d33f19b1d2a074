// Initial states that may be off the constraints of their system: they are checked, moved onto them, refused,
// or taken as they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/runs/support/constraints.hpp>
#include <pfaff/runs/support/links.hpp>

#include "../formula_values.hpp"
#include "worst_residual.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::initial_state;
using pfaff::testing::worst_residual;

TEST(ProjectionOntoConstraints, EndsAtRoundOffAndSaysWhatItChanged) {
  for (const std::string name :
       {"spherical-pendulum", "guiding-centre", "four-bar", "polar-double-pendulum"}) {
    const auto model = systems().get(name, "system").make({});
    std::vector<Quad> z = initial_state(*model);
    for (std::size_t k = 0; k < z.size(); ++k) z[k] += Quad(static_cast<int>(k % 3) - 1) / Quad(64);
    const Quad before = worst_residual(*model, Quad(0), z);
    ASSERT_GT(before, Quad(1e-3)) << name;
    const ProjectionOntoConstraints projection = project_onto_constraints(*model, Quad(0), z);
    EXPECT_EQ(projection.status, Status::converged) << name;
    EXPECT_NEAR(projection.worst_residual, static_cast<double>(before), 1e-15 * static_cast<double>(before));
    EXPECT_GT(projection.change, 1e-3) << name;
    // Residuals are sums of products of numbers up to 10.
    EXPECT_LT(worst_residual(*model, Quad(0), z), Quad(1e-31)) << name;
    EXPECT_LT(project_onto_constraints(*model, Quad(0), z).change, 1e-32) << name;
  }
}

// Components that only round-off keeps from zero come closer to it in every iteration: no reason not to end.
TEST(ProjectionOntoConstraints, LeavesLongPendulaWhereTheyStart) {
  for (const std::string dimension : {"2", "3"})
    for (const std::string bobs : {"16", "256", "2000"}) {
      const auto model =
          systems().get("n-pendulum", "system").make({{"bobs", bobs}, {"dimension", dimension}});
      std::vector<Quad> z = initial_state(*model);
      const ProjectionOntoConstraints projection = project_onto_constraints(*model, Quad(0), z);
      EXPECT_EQ(projection.status, Status::converged) << bobs;
      EXPECT_LT(projection.change, 1e-30) << bobs;
    }
}

TEST(ProjectionOntoConstraints, SaysWhenItCannot) {
  const auto model = systems().get("spherical-pendulum", "system").make({});
  std::vector<Quad> centre(6, Quad(0));
  EXPECT_EQ(project_onto_constraints(*model, Quad(0), centre).status, Status::singular);
  std::vector<Quad> undefined(6, std::numeric_limits<Quad>::quiet_NaN());
  EXPECT_EQ(project_onto_constraints(*model, Quad(0), undefined).status, Status::non_finite);
}

RunSettings off_the_sphere() {
  RunSettings s;
  s.system = "sphere-particle";
  s.integrator = "rattle";
  s.step = "0.1";
  s.time = "1";
  s.initial = {"1.1", "0", "0", "0.1", "0.2", "0.3"};
  return s;
}

TEST(InitialStates, OffTheConstraintsAreRefusedOrMovedOrTaken) {
  RunSettings settings = off_the_sphere();
  try {
    (void)resolve(settings);
    FAIL() << "expected a refusal";
  } catch (const InputError& error) {
    const std::string text = error.what();
    for (const char* part :
         {"sphere-particle", "sphere~", "0.11", "--project-initial", "--allow-inconsistent"})
      EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
  }
  settings.project_initial = true;
  const ResolvedRun moved = resolve(settings);
  // Along the gradient, which points from the centre, and the momenta without their normal part.
  const std::vector<double> expected{1, 0, 0, 0, 0.2, 0.3};
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(moved.initial[k].value(), expected[k], 1e-16);
  EXPECT_GT(moved.projected, 0.05);
  settings.project_initial = false;
  settings.allow_inconsistent = true;
  EXPECT_EQ(resolve(settings).initial[0].value(), 1.1);
}

TEST(InitialStates, OfSystemsWithoutConstraintsAreNotProjected) {
  RunSettings settings = off_the_sphere();
  settings.system = "pendulum";
  settings.integrator = "verlet";
  settings.initial.clear();
  settings.project_initial = true;
  EXPECT_THROW((void)resolve(settings), InputError);
}
// The links of a model as texts, "1-0" of two points and "0@0,0" of a point and a place.
std::vector<std::string> links_as_text(const std::string& system, const Assignments& set) {
  const auto model = systems().get(system, "system").make(set);
  std::vector<double> state;
  for (const Real& x : model->initial()) state.push_back(x.value());
  std::vector<std::string> texts;
  for (const Link& link : links_of(*model, 0, state)) {
    std::string text = std::to_string(link.from);
    if (link.to) {
      text += "-" + std::to_string(*link.to);
    } else {
      for (std::size_t k = 0; k < link.place.size(); ++k)
        text += (k == 0 ? "@" : ",") + std::to_string(std::lround(1e9 * link.place[k]));
    }
    texts.push_back(text);
  }
  std::sort(texts.begin(), texts.end());
  return texts;
}

// A pendulum hangs from the origin, a ring is closed, and a human figure is a tree. What is no set of points
// on rods has no links: a particle on a surface, and a system without constraints.
TEST(Links, AreTheRodsOfPoints) {
  using Texts = std::vector<std::string>;
  EXPECT_EQ(links_as_text("n-pendulum", {{"bobs", "3"}, {"dimension", "2"}}), (Texts{"0-1", "0@0,0", "1-2"}));
  EXPECT_EQ(links_as_text("n-pendulum", {{"bobs", "2"}, {"dimension", "3"}}), (Texts{"0-1", "0@0,0,0"}));
  EXPECT_EQ(links_as_text("ring", {{"beads", "4"}, {"dimension", "2"}}), (Texts{"0-1", "0-3", "1-2", "2-3"}));
  EXPECT_EQ(links_as_text("humanoid", {}).size(), 12U);
  EXPECT_EQ(links_as_text("skate-chain", {{"beads", "3"}}), (Texts{"0-1", "0@0,0", "1-2"}));
  EXPECT_EQ(links_as_text("torus-particle", {}), Texts{});
  EXPECT_EQ(links_as_text("kepler", {}), Texts{});
}

}  // namespace
