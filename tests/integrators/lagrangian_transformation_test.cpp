// Transformations alpha as authors write them, linear and not: condition (34) of su-qin is checked on the
// recorded formula, and a transformation that violates it is refused with the reason.
#include <gtest/gtest.h>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/examples/templates/alpha.hpp>
#include <pfaff/integrators/generating/lagrangian_transformation.hpp>

namespace pfaff {
namespace {

// How an author may be mistaken.
enum class Mistake { none, sign, factor, weight, old_time, varying_factor };

// su-qin (95) for K = e^{nu t} [[0, -1], [1, 0]], and behind it, if asked, the nonlinear map
// (w^, w) -> (w^ + grad s(w), w), which keeps J.
struct DampedAlpha {
  Mistake mistake = Mistake::none;
  bool sheared = false;
  Real nu = 0.3_r;
  template <class T>
  void alpha(const T& t, const T& t0, In<T> new_z, In<T> old_z, Out<T> w_hat, Out<T> w) const {
    const T e = exp(nu * t), e0 = exp(nu * (mistake == Mistake::old_time ? t : t0));
    w_hat[0] = e * new_z[1] - e0 * old_z[1];
    w_hat[1] = new_z[0] - old_z[0];
    w[0] = (new_z[0] + old_z[0]) / 2;
    w[1] = -(e * new_z[1] + e0 * old_z[1]) / 2;
    if (mistake == Mistake::sign || mistake == Mistake::factor)
      for (T& x : w_hat) x = mistake == Mistake::sign ? -x : 3 * x;
    if (mistake == Mistake::weight) w[0] = (2 * new_z[0] + old_z[0]) / 3;
    if (mistake == Mistake::varying_factor)
      for (T& x : w_hat) x = (1 + t) * x;
    if (sheared) {  // s = w0^2 w1 + sin(w1)
      w_hat[0] = w_hat[0] + 2 * w[0] * w[1];
      w_hat[1] = w_hat[1] + w[0] * w[0] + cos(w[1]);
    }
  }
};

// K(z) = [[0, -1], [1, 0]]/(x y), Lotka and Volterra's structure: nonlinear in z through the chart (log x,
// log y).
struct LogarithmicAlpha {
  bool linear = false;  // forgets the chart
  template <class T>
  void alpha(const T& /*t*/, const T& /*t0*/, In<T> new_z, In<T> old_z, Out<T> w_hat, Out<T> w) const {
    for (std::size_t k = 0; k < 2; ++k) {
      const T after = linear ? new_z[k] : log(new_z[k]), before = linear ? old_z[k] : log(old_z[k]);
      w_hat[1 - k] = k == 0 ? before - after : after - before;
      w[k] = (after + before) / 2;
    }
    w_hat[0] = (linear ? new_z[1] : log(new_z[1])) - (linear ? old_z[1] : log(old_z[1]));
    w_hat[1] = (linear ? old_z[0] : log(old_z[0])) - (linear ? new_z[0] : log(new_z[0]));
  }
};

template <class A>
std::shared_ptr<const Tape> recorded(const A& author) {
  return std::make_shared<const Tape>(record_alpha(author, 2));
}
std::shared_ptr<const Tape> damped_structure() {
  return systems().get("damped-pendulum", "system").make({{"nu", "0.3"}})->tape(Formula::structure);
}
std::shared_ptr<const Tape> logarithmic_structure() {
  return std::make_shared<const Tape>(
      record(2, 4, [](const Recorded&, std::span<const Recorded> z, std::span<Recorded> k) {
        k[1] = Recorded(-1) / (z[0] * z[1]);
        k[2] = Recorded(1) / (z[0] * z[1]);
      }));
}
template <class T>
std::vector<StatePair<T>> state_pairs() {
  const auto q = [](int x) { return T(x) / T(10); };
  return {{q(9), q(7), {q(5), q(3)}, {q(4), q(6)}},
          {q(2), q(1), {q(13), q(8)}, {q(11), q(2)}},
          {q(15), q(16), {q(3), q(21)}, {q(7), q(17)}}};
}

template <class T>
class LagrangianTransformationTest : public ::testing::Test {};
using TestedScalars = ::testing::Types<double, Quad>;
TYPED_TEST_SUITE(LagrangianTransformationTest, TestedScalars);

TYPED_TEST(LagrangianTransformationTest, RightOnesHold) {
  for (const bool sheared : {false, true}) {
    const auto check = check_lagrangian(recorded(DampedAlpha{.sheared = sheared}), damped_structure(),
                                        state_pairs<TypeParam>());
    EXPECT_TRUE(check.holds) << check.message;
    EXPECT_LE(check.residual, 8 * static_cast<double>(unit_roundoff<TypeParam>()));
    EXPECT_EQ(check.factor, 1);
    EXPECT_TRUE(check.message.empty());
  }
  const auto check =
      check_lagrangian(recorded(LogarithmicAlpha{}), logarithmic_structure(), state_pairs<TypeParam>());
  EXPECT_TRUE(check.holds) << check.message;
}

// The one that the documentation shows, and with a wrong damping rate.
TYPED_TEST(LagrangianTransformationTest, TheDocumentedOneHolds) {
  const auto structure = std::make_shared<const Tape>(
      record(2, 4, [](const Recorded& t, std::span<const Recorded>, std::span<Recorded> k) {
        k[2] = Recorded(2) * exp(Recorded(Real::fraction(3, 20)) * t);
        k[1] = -k[2];
      }));
  const auto right =
      check_lagrangian(recorded(examples::NewPositionOldMomentum{}), structure, state_pairs<TypeParam>());
  EXPECT_TRUE(right.holds) << right.message;
  EXPECT_FALSE(check_lagrangian(recorded(examples::NewPositionOldMomentum{.damping = 0.6_r}), structure,
                                state_pairs<TypeParam>())
                   .holds);
}

TYPED_TEST(LagrangianTransformationTest, WrongOnesAreNamed) {
  const auto expect = [](const LagrangianCheck& check, double factor, const std::string& said) {
    EXPECT_FALSE(check.holds);
    EXPECT_GT(check.residual, 1e-3);
    EXPECT_DOUBLE_EQ(check.factor, factor);
    EXPECT_NE(check.message.find(said), std::string::npos) << check.message;
    EXPECT_EQ(check.message.find('\n'), std::string::npos);
  };
  const auto with = [](Mistake mistake) {
    return check_lagrangian(recorded(DampedAlpha{.mistake = mistake, .sheared = true}), damped_structure(),
                            state_pairs<TypeParam>());
  };
  expect(with(Mistake::sign), -1, "change the sign of w_hat");
  expect(with(Mistake::factor), 3, "divide w_hat by 3");
  expect(with(Mistake::weight), 1, "block (");
  expect(with(Mistake::old_time), 1, "(old, old): B^T D - D^T B must be -K(z, t0)");
  expect(with(Mistake::varying_factor), 1, "block (");  // 1 + t is not a constant
  expect(check_lagrangian(recorded(LogarithmicAlpha{.linear = true}), logarithmic_structure(),
                          state_pairs<TypeParam>()),
         1, "block (");
}

// A damping rate that is off by fifty times the tolerance, which is a hundred units of round-off.
TYPED_TEST(LagrangianTransformationTest, SmallMistakesAreNoRoundOff) {
  const Quad off = Quad(6400) * Quad(unit_roundoff<TypeParam>());
  const DampedAlpha nearly{.nu = Real(Quad(3) / Quad(10) + off)};
  const auto check = check_lagrangian(recorded(nearly), damped_structure(), state_pairs<TypeParam>());
  EXPECT_FALSE(check.holds);
  EXPECT_LE(check.residual, 4 * static_cast<double>(off));
}

TYPED_TEST(LagrangianTransformationTest, BadPointsAreNotSilent) {
  auto bad = state_pairs<TypeParam>();
  bad[1].new_z[0] = TypeParam(-1);  // its logarithm is not a number
  const auto check = check_lagrangian(recorded(LogarithmicAlpha{}), logarithmic_structure(), bad);
  EXPECT_FALSE(check.holds);
  EXPECT_NE(check.message.find("not finite"), std::string::npos) << check.message;
  const auto none = check_lagrangian<TypeParam>(recorded(LogarithmicAlpha{}), logarithmic_structure(), {});
  EXPECT_FALSE(none.holds);
  EXPECT_NE(none.message.find("no point"), std::string::npos);
}

// The Jacobian's blocks, through the tape, against su-qin (96) and (98).
TYPED_TEST(LagrangianTransformationTest, BlocksOfThePapersAlpha) {
  using T = TypeParam;
  LagrangianTransformation<T> alpha(recorded(DampedAlpha{}));
  const T t = T(9) / T(10), t0 = T(7) / T(10), nu = T(Real::fraction(3, 10)), half = T(1) / T(2);
  const T e = exp(nu * t), e0 = exp(nu * t0), zero(0), one(1);
  const auto blocks = alpha.blocks(t, t0, std::vector<T>{one, half}, std::vector<T>{half, one});
  const Matrix<T> expected(4, std::vector<T>{zero, e, zero, -e0, one, zero, -one, zero, half, zero, half,
                                             zero, zero, -e * half, zero, -e0 * half});
  const double bound = 8 * static_cast<double>(unit_roundoff<T>());  // one rounding of an exponential or two
  EXPECT_LE(static_cast<double>(largest(blocks.jacobian() - expected)), bound);
  const Matrix<T> k(2, std::vector<T>{zero, -e, e, zero}), k0(2, std::vector<T>{zero, -e0, e0, zero});
  const Matrix<T> inverse_expected(
      4, std::vector<T>{zero, half, one, zero, half / e, zero, zero, -one / e, zero, -half, one, zero,
                        -half / e0, zero, zero, -one / e0});
  EXPECT_LE(static_cast<double>(largest(blocks.inverse_blocks(k, k0).jacobian() - inverse_expected)), bound);
  // d alpha/dt at fixed states: nu E p' in w^_0, half of it with the other sign in w_1.
  const auto rate = alpha.time_derivative(t, t0, std::vector<T>{one, half}, std::vector<T>{half, one});
  EXPECT_LE(static_cast<double>(abs(rate[0] - nu * e * half)), bound);
  EXPECT_LE(static_cast<double>(abs(rate[3] + nu * e * half * half)), bound);
  EXPECT_EQ(rate[1], zero);
  EXPECT_EQ(rate[2], zero);
}

}  // namespace
}  // namespace pfaff
