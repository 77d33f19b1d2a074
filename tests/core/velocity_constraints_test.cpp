// Velocity constraints A(q, t) v + b(q, t) = 0: what a system that writes them offers, and what it does not.
#include <gtest/gtest.h>

#include <pfaff/core/formulation.hpp>
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/system.hpp>

#include "../formula_values.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::values;

const SystemDescriptor sleigh_descriptor{
    .name = "sleigh", .title = "", .reference = "", .invariants = {conserved("energy", "J")}};

void expect_near(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-15) << k;
}

// A sleigh at (x, y) whose blade points along theta: it does not slip sideways, -sin(theta) x' + cos(theta)
// y' = 0. The mass is not 1, so that velocities and momenta differ.
struct Sleigh {
  static constexpr int dimension = 6, velocity_constraint_count = 1;
  static std::vector<Parameter> parameters() { return {}; }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1]) / 8 + p[2] * p[2] / 6;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0] / 2;
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {  // of q[2] none: a zero left out
    rows[0] = -sin(q[2]);
    rows[1] = cos(q[2]);
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> out) const {
    out[0] = kinetic(t, z.subspan(3)) + potential(t, z.first(3));
  }
};
// The same on ground that moves sideways, faster and faster; it may write too much.
struct SleighOnABelt : Sleigh {
  int written = 1;
  static std::vector<std::string> velocity_constraint_names() { return {"blade"}; }
  template <class T>
  void velocity_offsets(const T& t, In<T> q, Out<T> b) const {
    for (std::size_t k = 0; k < static_cast<std::size_t>(written); ++k) b.data()[k] = -t * cos(q[2]);
  }
};

const std::vector<double> q{0.1, 0.2, 0.7}, z{0.1, 0.2, 0.7, 3, -2, 1};

TEST(VelocityConstraints, AreOfferedAndNoVectorFieldIs) {
  const auto model = make_model(sleigh_descriptor, Sleigh{});
  EXPECT_EQ(model->facets(), facets(Facet::velocity_constraints, Facet::invariants));
  EXPECT_TRUE(model->restricted());
  EXPECT_TRUE(model->has_energy());
  EXPECT_FALSE(model->moves());
  EXPECT_FALSE(model->constrained());  // a Dirac bracket would make another motion of them
  EXPECT_FALSE(model->holonomic());
  EXPECT_TRUE(model->autonomous());
  EXPECT_EQ(model->advice(facets(Facet::vector_field)),
            "; a formulation of its velocity constraints makes a motion of them");
  EXPECT_EQ(model->advice(facets(Facet::velocity_constraints)), "");
  EXPECT_EQ(
      formulations().get("dirac", "formulation").refuses(*model),
      "formulation dirac makes no motion of velocity constraints, which sleigh has; expected nonholonomic "
      "or vakonomic");
  const auto moving = formulations().get("nonholonomic", "formulation").apply(model, {});
  EXPECT_EQ(moving->facets(),
            facets(Facet::velocity_constraints, Facet::invariants).with(Facet::vector_field));
  EXPECT_EQ(moving->advice(facets(Facet::separable)), "");
}

TEST(VelocityConstraints, TapesAreWhatTheirAuthorWrote) {
  const auto rest = make_model(sleigh_descriptor, Sleigh{}),
             moving = make_model(sleigh_descriptor, SleighOnABelt{});
  for (const auto& model : {rest, moving})
    expect_near(values(*model, Formula::velocity_constraints, 2.0, q), {-std::sin(0.7), std::cos(0.7), 0});
  EXPECT_FALSE(rest->given(Formula::velocity_offsets));
  EXPECT_EQ(values(*rest, Formula::velocity_offsets, 2.0, q), std::vector<double>{0});
  expect_near(values(*moving, Formula::velocity_offsets, 2.0, q), {-2 * std::cos(0.7)});
  EXPECT_FALSE(moving->autonomous());
}

TEST(VelocityConstraints, AreConstraintsOfThePhaseSpaceWithTheirGradients) {
  const auto model = make_model(sleigh_descriptor, SleighOnABelt{});
  const double s = std::sin(0.7), c = std::cos(0.7), slip = -s * 3 / 4 - c * 2 / 4 - 2 * c;
  expect_near(values(*model, Formula::constraints, 2.0, z), {slip});
  expect_near(values(*model, Formula::constraint_gradients, 2.0, z),
              {0, 0, -c * 3 / 4 + s * 2 / 4 + 2 * s, -s / 4, c / 4, 0});
  EXPECT_EQ(model->constraint_names(), std::vector<std::string>{"blade"});
  EXPECT_EQ(make_model(sleigh_descriptor, Sleigh{})->constraint_names(), std::vector<std::string>{"psi1"});
}

// On a plane that tilts as well: a holonomic constraint beside that of velocities.
struct SleighOnASlope : Sleigh {
  static constexpr int constraint_count = 1;
  template <class T>
  void holonomic(const T& t, In<T> x, Out<T> phi) const {
    phi[0] = x[1] - t * x[0];
  }
};
TEST(VelocityConstraints, StandBesideHolonomicOnes) {
  const auto model = make_model(sleigh_descriptor, SleighOnASlope{});
  EXPECT_EQ(model->facets(), facets(Facet::velocity_constraints, Facet::invariants));
  EXPECT_EQ(model->constraint_names(), (std::vector<std::string>{"phi1", "phi1~", "psi1"}));
  const double s = std::sin(0.7), c = std::cos(0.7);
  expect_near(values(*model, Formula::constraints, 2.0, z),
              {0.2 - 2 * 0.1, -2.0 / 4 - 2 * 3.0 / 4 - 0.1, -s * 3 / 4 - c * 2 / 4});
}

TEST(VelocityConstraints, ProblemsHaveTheirMembers) {
  EXPECT_TRUE(HasVelocityConstraints<Problem<double>>);
  constexpr FacetSet without = FacetSet::all().without(Facet::velocity_constraints);
  EXPECT_FALSE((HasVelocityConstraints<Problem<double, dynamic, without>>));
  const Problem<Quad> problem(make_model(sleigh_descriptor, Sleigh{}));
  std::vector<Quad> at{Quad(0), Quad(0), Quad(1)}, rows(3), b(1);
  problem.velocity_constraints(Quad(0), at, rows);
  problem.velocity_offsets(Quad(0), at, b);
  EXPECT_EQ(rows[0], -sin(Quad(1)));
  EXPECT_EQ(b[0], Quad(0));
}

// A method that asks for them needs that facet and no other.
struct AsksForThem {
  template <HasVelocityConstraints P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& /*h*/, State<P>& state, NoWork& /*w*/) const {
    p.velocity_offsets(t, state, state);
    return Status::converged;
  }
};
TEST(VelocityConstraints, AreFoundAsAMethodsNeed) {
  EXPECT_EQ(needs_of<AsksForThem>(), facets(Facet::velocity_constraints));
}

// Control: an author who writes another number of results is told.
TEST(VelocityConstraints, AWrongNumberOfResultsIsRefused) {
  try {
    SleighOnABelt wrong;
    wrong.written = 2;
    (void)make_model(sleigh_descriptor, wrong);
    FAIL() << "two offsets of one constraint were accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "system sleigh: velocity_offsets(t, q, b) writes 2 results; expected 1");
  }
}

}  // namespace
