// The algorithm of Dirac and Bergmann on systems whose constraints are known in closed form.
#include <gtest/gtest.h>

#include <pfaff/brackets/canonical.hpp>
#include <pfaff/brackets/dirac/dirac_bergmann.hpp>
#include <pfaff/brackets/lie_poisson.hpp>
#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace {
using namespace pfaff;
using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;
using Numbers = std::vector<Quad>;

// Formulas as lambdas of the recorded state.
template <class H, class Primary, class Bracket = CanonicalBracket>
ConstrainedHamiltonian constrained(int n, std::vector<std::string> names, H&& h, Primary&& primary,
                                   const Bracket& bracket = {}) {
  const auto count = static_cast<int>(names.size());
  ConstrainedHamiltonian system;
  system.hamiltonian = std::make_shared<const Tape>(
      record(n, 1, [&](const Recorded& /*t*/, Arguments z, Results out) { out[0] = h(z); }));
  system.primary = std::make_shared<const Tape>(record(n, count, primary));
  system.sharp = sharp_tape(bracket, n);
  system.names = std::move(names);
  return system;
}
std::vector<int> generations(const ConstraintAlgorithm<Quad>& result) {
  std::vector<int> all;
  for (const FoundConstraint& c : result.constraints) all.push_back(c.generation);
  return all;
}
Numbers results_of(const ConstraintAlgorithm<Quad>& result, const Numbers& z, Quad t = 0) {
  Numbers out(result.constraints.size());
  Replay<Quad> replay(result.values);
  replay(t, z.data(), out.data());
  return out;
}
Quad largest(const Numbers& x) {
  Quad worst(0);
  for (const Quad v : x) worst = std::max(worst, abs(v));
  return worst;
}
// Quad: solves and projections of numbers about 1.
constexpr double bound = 1e-31;
const Numbers pendulum_point{Quad(0.3), Quad(-0.5), Quad(0.9), Quad(0.2), Quad(0.7), Quad(-0.4)};

ConstrainedHamiltonian spherical_pendulum(Real unit) {
  return constrained(
      6, {"length"}, [](Arguments z) { return (z[3] * z[3] + z[4] * z[4] + z[5] * z[5]) / 2 + 10 * z[2]; },
      [unit](const Recorded& /*t*/, Arguments z, Results out) {
        out[0] = unit * (z[0] * z[0] + z[1] * z[1] + z[2] * z[2] - 1) / 2;
      });
}

TEST(DiracBergmann, SphericalPendulumClosesWithItsHiddenConstraint) {
  const auto result = dirac_bergmann<Quad>(spherical_pendulum(1), Quad(0), pendulum_point);
  ASSERT_EQ(result.closure, ConstraintClosure::closed);
  EXPECT_EQ(generations(result), (std::vector<int>{1, 2}));
  EXPECT_EQ(result.constraints[1].name, "length'");
  EXPECT_TRUE(result.classes.regular());
  EXPECT_LE(largest(results_of(result, result.point)), bound);
  // The second constraint is q.p wherever it is asked for, on the surface or off it.
  EXPECT_LE(abs(results_of(result, pendulum_point)[1] -
                (pendulum_point[0] * pendulum_point[3] + pendulum_point[1] * pendulum_point[4] +
                 pendulum_point[2] * pendulum_point[5])),
            bound);
  // The multiplier is the tension: (|p|^2 - g z)/|q|^2.
  const Numbers& z = result.point;
  const Quad tension =
      (z[3] * z[3] + z[4] * z[4] + z[5] * z[5] - Quad(10) * z[2]) / (z[0] * z[0] + z[1] * z[1] + z[2] * z[2]);
  ASSERT_TRUE(result.multipliers[0].determined);
  EXPECT_LE(abs(result.multipliers[0].value - tension), bound);
}

TEST(DiracBergmann, UnitsDoNotMatter) {
  for (const char* unit : {"1e-12", "1e12"}) {
    const auto result = dirac_bergmann<Quad>(spherical_pendulum(*Real::parse(unit)), Quad(0), pendulum_point);
    EXPECT_EQ(result.closure, ConstraintClosure::closed);
    EXPECT_EQ(generations(result), (std::vector<int>{1, 2})) << unit;
    EXPECT_TRUE(result.classes.regular());
  }
}

TEST(DiracBergmann, DoubleFindsTheSame) {
  const std::vector<double> z{0.3, -0.5, 0.9, 0.2, 0.7, -0.4};
  const auto result = dirac_bergmann<double>(spherical_pendulum(1), 0.0, z);
  EXPECT_EQ(result.closure, ConstraintClosure::closed);
  EXPECT_EQ(result.constraints.size(), 2U);
  EXPECT_TRUE(result.classes.regular());
}

// The tension as a coordinate, its momentum the primary constraint: four generations, all second class. A
// Dirac bracket of the second and third would end here too early, with the tension arbitrary.
TEST(DiracBergmann, PendulumWithItsTensionHasFourGenerations) {
  const auto system = constrained(
      8, {"p_tension"},
      [](Arguments z) {
        return (z[4] * z[4] + z[5] * z[5] + z[6] * z[6]) / 2 + 10 * z[2] +
               z[3] * (z[0] * z[0] + z[1] * z[1] + z[2] * z[2] - 1) / 2;
      },
      [](const Recorded& /*t*/, Arguments z, Results out) { out[0] = z[7]; });
  const Numbers z{Quad(0.3), Quad(-0.5), Quad(0.9), Quad(-7), Quad(0.2), Quad(0.7), Quad(-0.4), Quad(0.1)};
  const auto result = dirac_bergmann<Quad>(system, Quad(0), z);
  ASSERT_EQ(result.closure, ConstraintClosure::closed) << describe(result);
  EXPECT_EQ(generations(result), (std::vector<int>{1, 2, 3, 4}));
  EXPECT_TRUE(result.classes.regular());
  EXPECT_TRUE(result.multipliers[0].determined);
  const Numbers& x = result.point;
  EXPECT_LE(abs(x[3] - (x[4] * x[4] + x[5] * x[5] + x[6] * x[6] - Quad(10) * x[2])), bound);
  EXPECT_LE(abs(x[7]), bound);
}

// L = (x' - y)^2 / 2: p_y, then p_x, both first class; y is arbitrary.
TEST(DiracBergmann, GaugeFreedom) {
  const auto system = constrained(
      4, {"p_y"}, [](Arguments z) { return z[2] * z[2] / 2 + z[1] * z[2]; },
      [](const Recorded& /*t*/, Arguments z, Results out) { out[0] = z[3]; });
  const auto result = dirac_bergmann<Quad>(system, Quad(0), Numbers{Quad(1), Quad(2), Quad(3), Quad(4)});
  ASSERT_EQ(result.closure, ConstraintClosure::closed);
  EXPECT_EQ(generations(result), (std::vector<int>{1, 2}));
  EXPECT_EQ(result.classes.rank(), 0U);
  EXPECT_FALSE(result.multipliers[0].determined);
  EXPECT_EQ(
      describe(result),
      "generation 1: p_y\ngeneration 2: p_y'\nclosed after 2 generations\nmultiplier of p_y is not "
      "determined\np_y and p_y' are first class: p_y; p_y' have vanishing brackets with every constraint");
}

TEST(DiracBergmann, RelativisticParticleIsFirstClass) {
  const auto system = constrained(
      4, {"mass"}, [](Arguments /*z*/) { return Recorded(0); },
      [](const Recorded& /*t*/, Arguments z, Results out) { out[0] = (z[3] * z[3] - z[2] * z[2] + 1) / 2; });
  const auto result = dirac_bergmann<Quad>(system, Quad(0), Numbers{Quad(0), Quad(0), Quad(2), Quad(1)});
  EXPECT_EQ(result.closure, ConstraintClosure::closed);
  EXPECT_EQ(result.constraints.size(), 1U);
  EXPECT_EQ(result.classes.classes[0], ConstraintClass::first);
  EXPECT_FALSE(result.multipliers[0].determined);
}

// H = q1 p2 + q2 p3 and p1: p1' = -p2, p1'' = p3, and there it ends.
TEST(DiracBergmann, AChainOfThreeGenerations) {
  const auto system = constrained(
      6, {"p1"}, [](Arguments z) { return z[0] * z[4] + z[1] * z[5]; },
      [](const Recorded& /*t*/, Arguments z, Results out) { out[0] = z[3]; });
  const auto result = dirac_bergmann<Quad>(
      system, Quad(0), Numbers{Quad(1), Quad(2), Quad(3), Quad(0.5), Quad(0.25), Quad(-1)});
  ASSERT_EQ(result.closure, ConstraintClosure::closed);
  EXPECT_EQ(generations(result), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(result.constraints[2].name, "p1''");
  EXPECT_EQ(results_of(result, {Quad(1), Quad(2), Quad(3), Quad(5), Quad(7), Quad(11)}),
            (Numbers{Quad(5), Quad(-7), Quad(11)}));
  EXPECT_THROW((void)dirac_bergmann<Quad>(system, Quad(0), Numbers(6), 2), RunError);
}

// L = q has p and p' = 1.
TEST(DiracBergmann, InconsistentSystemsAreReported) {
  const auto system = constrained(
      2, {"p"}, [](Arguments z) { return -z[0]; },
      [](const Recorded& /*t*/, Arguments z, Results out) { out[0] = z[1]; });
  const auto result = dirac_bergmann<Quad>(system, Quad(0), Numbers{Quad(0.3), Quad(0.2)});
  EXPECT_EQ(result.closure, ConstraintClosure::inconsistent);
  EXPECT_NE(describe(result).find("inconsistent: p' = 1 "), std::string::npos) << describe(result);
}

TEST(DiracBergmann, ConditionsWithoutAGradientAreReported) {
  const auto system = constrained(
      2, {"p"}, [](Arguments z) { return z[0] * z[0] * z[0]; },
      [](const Recorded& /*t*/, Arguments z, Results out) { out[0] = z[1]; });
  EXPECT_EQ(dirac_bergmann<Quad>(system, Quad(0), Numbers{Quad(0), Quad(0)}).closure,
            ConstraintClosure::irregular);
}

TEST(DiracBergmann, ConstraintsWithoutPointsAreReported) {
  const auto system = constrained(
      2, {"nowhere"}, [](Arguments z) { return z[1] * z[1]; },
      [](const Recorded& /*t*/, Arguments z, Results out) { out[0] = z[0] * z[0] + 1; });
  const auto result = dirac_bergmann<Quad>(system, Quad(0), Numbers{Quad(0.4), Quad(0)});
  EXPECT_EQ(result.closure, ConstraintClosure::unreachable);
  EXPECT_NE(result.trouble.find("nowhere"), std::string::npos);
}

// p_i = A_i(q) with curl A = B(q) = 1 + q1, H = V(q): second class at once, and the multipliers are the drift
// velocities -V_2/B, V_1/B.
TEST(DiracBergmann, StrongMagneticFieldIsSecondClassAtOnce) {
  const auto system = constrained(
      4, {"pi1", "pi2"}, [](Arguments z) { return z[0] * z[0] * z[1] + 3 * z[1]; },
      [](const Recorded& /*t*/, Arguments z, Results out) {
        out[0] = z[2];
        out[1] = z[3] - z[0] - z[0] * z[0] / 2;
      });
  const auto result = dirac_bergmann<Quad>(system, Quad(0), Numbers{Quad(0.5), Quad(0.25), Quad(1), Quad(2)});
  ASSERT_EQ(result.closure, ConstraintClosure::closed);
  EXPECT_EQ(generations(result), (std::vector<int>{1, 1}));
  EXPECT_TRUE(result.classes.regular());
  const Quad x = result.point[0], y = result.point[1], field = Quad(1) + x;
  EXPECT_LE(abs(result.multipliers[0].value + (x * x + Quad(3)) / field), bound);
  EXPECT_LE(abs(result.multipliers[1].value - Quad(2) * x * y / field), bound);
}

// Of u1 and u2 only the sum is determined: q1 + q2 = 0 follows from p1 = p2 = 0.
TEST(DiracBergmann, MultipliersTiedToOthersAreNotDetermined) {
  const auto system = constrained(
      4, {"p1", "p2"}, [](Arguments z) { return (z[0] + z[1]) * (z[0] + z[1]) / 2; },
      [](const Recorded& /*t*/, Arguments z, Results out) {
        out[0] = z[2];
        out[1] = z[3];
      });
  const auto result = dirac_bergmann<Quad>(system, Quad(0), Numbers{Quad(1), Quad(2), Quad(3), Quad(4)});
  ASSERT_EQ(result.closure, ConstraintClosure::closed);
  EXPECT_EQ(generations(result), (std::vector<int>{1, 1, 2}));
  EXPECT_FALSE(result.multipliers[0].determined);
  EXPECT_FALSE(result.multipliers[1].determined);
  EXPECT_EQ(result.classes.rank(), 2U);
  EXPECT_EQ(result.classes.members(ConstraintClass::first).size(), 1U);
}

TEST(DiracBergmann, RedundantPrimaryConstraintsAreNamed) {
  const auto system = constrained(
      4, {"a", "b", "twice"}, [](Arguments z) { return z[0] * z[0] + z[1]; },
      [](const Recorded& /*t*/, Arguments z, Results out) {
        out[0] = z[2] + z[1];
        out[1] = z[3] - z[0];
        out[2] = 2 * out[0];
      });
  const auto result = dirac_bergmann<Quad>(system, Quad(0), Numbers{Quad(1), Quad(2), Quad(3), Quad(4)});
  ASSERT_EQ(result.closure, ConstraintClosure::closed);
  EXPECT_EQ(result.classes.classes[2], ConstraintClass::redundant);
  EXPECT_FALSE(result.multipliers[2].determined);
  EXPECT_NE(describe(result).find("twice is redundant: the gradient of twice - 2 a vanishes"),
            std::string::npos)
      << describe(result);
}

// The constraint p1 is kept in time if p1 + e p2 vanishes. What the second adds is a thousand units of
// round-off, which is no rounding error of a gradient with exact entries, and then one unit, which may be.
TEST(DiracBergmann, NearlyParallelConditionsAreConstraints) {
  for (const int digits : {42, 52}) {
    const Real e = Real::fraction(1, std::int64_t{1} << digits);
    const auto system = constrained(
        4, {"first"}, [e](Arguments z) { return z[0] * (z[2] + Recorded(e) * z[3]); },
        [](const Recorded& /*t*/, Arguments z, Results out) { out[0] = z[2]; });
    const auto result = dirac_bergmann<double>(system, 0.0, std::vector<double>{1, 2, 0, 0});
    ASSERT_EQ(result.closure, ConstraintClosure::closed);
    EXPECT_EQ(result.constraints.size(), digits == 42 ? 2U : 1U);
  }
}

// q = t: p = 1 follows, as the explicit time derivative says.
TEST(DiracBergmann, ConstraintsThatDependOnTime) {
  const auto system = constrained(
      2, {"moving"}, [](Arguments z) { return z[1] * z[1] / 2; },
      [](const Recorded& t, Arguments z, Results out) { out[0] = z[0] - t; });
  const auto result = dirac_bergmann<Quad>(system, Quad(0.5), Numbers{Quad(3), Quad(3)});
  ASSERT_EQ(result.closure, ConstraintClosure::closed);
  EXPECT_EQ(result.point, (Numbers{Quad(0.5), Quad(1)}));
}

// The Casimir of so(3)* as a constraint has vanishing brackets with everything.
TEST(DiracBergmann, ACasimirIsFirstClass) {
  const auto system = constrained(
      3, {"casimir"}, [](Arguments z) { return z[0] * z[0] + 2 * z[1] * z[1] + 3 * z[2] * z[2]; },
      [](const Recorded& /*t*/, Arguments z, Results out) {
        out[0] = z[0] * z[0] + z[1] * z[1] + z[2] * z[2] - 1;
      },
      LiePoissonBracket::rigid_body());
  const auto result = dirac_bergmann<Quad>(system, Quad(0), Numbers{Quad(0.3), Quad(0.4), Quad(0.5)});
  EXPECT_EQ(result.closure, ConstraintClosure::closed);
  EXPECT_EQ(result.constraints.size(), 1U);
  EXPECT_EQ(result.classes.rank(), 0U);
}

TEST(DiracBergmann, BadInputIsRefused) {
  auto system = spherical_pendulum(1);
  EXPECT_THROW((void)dirac_bergmann<Quad>(system, Quad(0), Numbers(4)), InputError);
  system.names.push_back("another");
  EXPECT_THROW((void)dirac_bergmann<Quad>(system, Quad(0), pendulum_point), InputError);
  const auto root = constrained(
      2, {"root"}, [](Arguments z) { return z[0]; },
      [](const Recorded& /*t*/, Arguments z, Results out) { out[0] = sqrt(z[0]); });
  EXPECT_THROW((void)dirac_bergmann<Quad>(root, Quad(0), Numbers{Quad(-1), Quad(0)}), InputError);
}
}  // namespace
