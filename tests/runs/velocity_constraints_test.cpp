// Systems with velocity constraints outside the core: which formulation moves them, states off their
// constraints, rows that depend on each other, and what verification finds of them.
#include <gtest/gtest.h>

#include <algorithm>

#include <pfaff/core/system.hpp>
#include <pfaff/runs/motion.hpp>
#include <pfaff/runs/support/constraints.hpp>
#include <pfaff/verify/check.hpp>
#include <pfaff/verify/formulation_checks.hpp>
#include <pfaff/verify/skated_models.hpp>

#include "../formula_values.hpp"
#include "worst_residual.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::initial_state;
using pfaff::testing::worst_residual;

TEST(VelocityConstraints, MoveInTheNonholonomicFormulationByDefault) {
  for (const auto& model : skated_models()) {
    EXPECT_EQ(default_formulation(*model).name(), "nonholonomic");
    const auto motion = motion_of(model);
    EXPECT_TRUE(motion->moves());
    EXPECT_TRUE(motion->restricted());
    EXPECT_EQ(motion->source().formulation, "nonholonomic");
    EXPECT_EQ(motion_of(motion), motion);
    EXPECT_EQ(motion_for(*integrators().get("rk4", "integrator").make({}), model)->source().formulation,
              "nonholonomic");
  }
  EXPECT_EQ(&default_formulation(*systems().get("spherical-pendulum", "system").make({})),
            &dirac_formulation());
}

TEST(VelocityConstraints, StatesAreMovedOntoThem) {
  const Quad t(1);
  for (const auto& model : skated_models()) {
    SCOPED_TRACE(model->name());
    std::vector<Quad> z = initial_state(*model);
    for (std::size_t k = 0; k < z.size(); ++k) z[k] += Quad(static_cast<int>(k % 3) - 1) / Quad(64);
    const Quad before = worst_residual(*model, t, z);
    ASSERT_GT(before, Quad(1e-3));
    const auto projection = project_onto_constraints(*model, t, z);
    EXPECT_EQ(projection.status, Status::converged);
    EXPECT_NEAR(projection.worst_residual, static_cast<double>(before), 1e-15 * static_cast<double>(before));
    EXPECT_GT(projection.change, 1e-3);
    // Residuals are sums of products of numbers up to 10.
    EXPECT_LT(worst_residual(*model, t, z), Quad(1e-31));
    EXPECT_LT(project_onto_constraints(*model, t, z).change, 1e-32);
  }
}

// Momenta lose A^T lambda and nothing else: of all admissible velocities the projection is the one with the
// least distance in the metric of the masses, so that positions stay and admissible momenta do too.
TEST(VelocityConstraints, TheProjectionIsThatOfTheMetric) {
  const auto model = two_blades(false);
  const auto constraints = model->velocity_constraints<Quad>();
  const std::vector<Quad> start = initial_state(*model);
  std::vector<Quad> z = start;
  ASSERT_EQ(project_onto_constraints(*model, Quad(0), z).status, Status::converged);
  const In<Quad> before(start), after(z);
  EXPECT_TRUE(std::equal(start.begin(), start.begin() + 5, z.begin()));
  std::vector<Quad> lost(5), along(2), back(5);
  for (std::size_t k = 0; k < 5; ++k) lost[k] = before[5 + k] - after[5 + k];
  ASSERT_EQ(constraints->linearise(Quad(0), after.first(5), after.subspan(5)), Status::converged);
  constraints->by_momentum(lost, along);
  constraints->solve(along, along);
  constraints->apply_transpose(along, back);
  Quad size(0);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_LT(abs(back[k] - lost[k]), Quad(1e-31)) << k;
    size = std::max(size, abs(lost[k]));
  }
  EXPECT_GT(size, Quad(1e-3));
}

// A(q) has three rows, of which some depend on others where q says so: (1, q0, 0), (q1, 1, 0), (0, q2, q3).
struct Rows {
  static constexpr int dimension = 8, velocity_constraint_count = 3;
  bool moving = false, massless = false;
  static std::vector<Parameter> parameters() { return {}; }
  static std::vector<std::string> velocity_constraint_names() { return {"first", "second", "third"}; }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return massless ? T(p[3] * p[3] / 2) : T((p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3]) / 2);
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0];
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = T(1);
    rows[1] = q[0];
    rows[4] = q[1];
    rows[5] = T(1);
    rows[9] = q[2];
    rows[10] = q[3];
  }
  template <class T>
  void velocity_offsets(const T& t, In<T> /*q*/, Out<T> b) const {
    b[1] = moving ? T(1 + t) : T(0);
    b[2] = moving ? t : T(0);
  }
};
std::string dependent(const Rows& rows, const std::vector<int>& q, int t = 0) {
  const auto model = make_model(SystemDescriptor{.name = "rows", .title = "", .reference = ""}, rows);
  std::vector<Quad> z(8);
  for (std::size_t k = 0; k < 4; ++k) z[k] = Quad(q[k]);
  return dependent_velocity_constraints(*model, Quad(t), z);
}
TEST(VelocityConstraints, DependentRowsAreNamed) {
  EXPECT_EQ(dependent({}, {2, 3, 0, 1}), "");
  EXPECT_EQ(dependent({}, {1, 1, 0, 1}),
            "the row of A of velocity constraint second depends on that of first");
  EXPECT_EQ(dependent({}, {2, 3, 1, 0}),
            "the row of A of velocity constraint third depends on that of first and second");
  EXPECT_EQ(dependent({}, {0, 3, 1, 0}),
            "the row of A of velocity constraint third depends on that of first and second");
  EXPECT_EQ(dependent({}, {2, 3, 0, 0}), "the row of A of velocity constraint third is zero");
  EXPECT_EQ(dependent({.massless = true}, {2, 3, 0, 1}),
            "the mass matrix is degenerate along the velocity constraints (A H_pp A^T is singular)");
}
TEST(VelocityConstraints, ContradictionsAreNamed) {
  EXPECT_EQ(dependent({.moving = true}, {2, 3, 0, 1}, 2), "");
  EXPECT_EQ(dependent({.moving = true}, {1, 1, 0, 1}, 2),
            "velocity constraint second contradicts first: no velocity keeps them all");
  // At t = -1 the offset of the second constraint is that of the first, zero.
  EXPECT_EQ(dependent({.moving = true}, {1, 1, 0, 1}, -1),
            "the row of A of velocity constraint second depends on that of first");
  EXPECT_EQ(dependent({.moving = true}, {2, 3, 0, 0}, 2),
            "velocity constraint third is kept by no velocity: its row of A is zero");
}

// Both formulations pass on every kind of velocity constraints, and fail with their reactions reversed.
TEST(VelocityConstraints, FormulationsAreWhatTheySay) {
  for (const char* name : {"nonholonomic", "vakonomic"})
    for (const auto& model : skated_models()) {
      const FormulationPlugin& plugin = formulations().get(name, "formulation");
      ASSERT_TRUE(verified_on(plugin, {}, *model)) << model->name();
      std::size_t judged = 0, controls = 0;
      for (const Check& check : check_formulation(plugin, {}, model)) {
        EXPECT_TRUE(good(check)) << name << ' ' << model->name() << ' ' << check.claim << ' '
                                 << check.measured;
        judged += check.in_scope && !check.control ? 1U : 0U;
        controls += check.control ? 1U : 0U;
      }
      const bool rolls = name == std::string("nonholonomic"), still = model->name() != "two moving blades";
      EXPECT_EQ(judged, rolls ? (still ? 10U : 8U) : 4U) << name << ' ' << model->name();
      EXPECT_EQ(controls, rolls ? (still ? 5U : 4U) : 2U) << name << ' ' << model->name();
    }
}

}  // namespace
