// The measure of how rounding errors grow, on a method whose errors are known because they are made: exact
// rotations, carried on in quad, whose radius is changed in every step by a random amount, by a bias, or by a
// trend whose sign depends on the start.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

#include <pfaff/core/integrator.hpp>
#include <pfaff/verify/check.hpp>
#include <pfaff/verify/round_off_growth.hpp>

namespace pfaff {
namespace {

// What is done to log r in each step, in units of round-off.
struct Kicks {
  double random = 0, bias = 0, signed_trend = 0;
};
Kicks kicks;  // of the runs that follow; methods are made by their types alone

struct KickedRotation {
  template <class P>
  struct Work {
    Quad q = 0, p = 0;
    double sign = 0;
    bool begun = false;
    std::mt19937_64 random;
    Work(const KickedRotation& /*method*/, const P& /*problem*/) {}
  };
  template <HasVectorField P>
  Status step(const P& /*p*/, const Scalar<P>& /*t*/, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    if constexpr (std::is_same_v<T, double>) {
      if (!w.begun) {
        w.q = Quad(z[0]);
        w.p = Quad(z[1]);
        w.sign = std::fmod(std::abs(z[0]) * 1e6, 2) < 1 ? -1 : 1;
        w.random.seed(std::bit_cast<std::uint64_t>(z[0]));  // each run has kicks of its own
        w.begun = true;
      }
      std::uniform_real_distribution<double> uniform(-1, 1);
      const double kick = kicks.random * uniform(w.random) + kicks.bias + kicks.signed_trend * w.sign;
      const Quad c = cos(Quad(h)), s = sin(Quad(h)), r = Quad(1) + Quad(kick * unit_roundoff<double>());
      const Quad q = r * (c * w.q + s * w.p);
      w.p = r * (c * w.p - s * w.q);
      w.q = q;
      z[0] = static_cast<double>(w.q);
      z[1] = static_cast<double>(w.p);
    } else {
      const T c = cos(h), s = sin(h), q = c * z[0] + s * z[1];
      z[1] = c * z[1] - s * z[0];
      z[0] = q;
    }
    return Status::converged;
  }
};

class NoisyPlugin final : public MethodPlugin {
 public:
  NoisyPlugin()
      : MethodPlugin({.name = "kicked-rotation", .title = "", .reference = "", .order = 1}, {},
                     typeid(KickedRotation), std::source_location::current()) {}
  [[nodiscard]] std::unique_ptr<MethodInstance> make(const Assignments& /*none*/ = {}) const override {
    return std::make_unique<detail::Instance<KickedRotation>>(*this, KickedRotation());
  }
  [[nodiscard]] std::vector<Assignments> instances(bool /*full*/) const override { return {{}}; }
};

RoundOffGrowth growth_with(const Kicks& made) {
  kicks = made;
  const NoisyPlugin plugin;
  const auto method = plugin.make();
  const auto model = systems().get("harmonic-oscillator", "system").make({});
  const std::vector<Real> centre{1, Real::fraction(1, 2)};
  const auto growth =
      round_off_growth(*method, model, centre, 0, {Real::fraction(2, 5), {0}}, {.steps = 8192});
  EXPECT_TRUE(growth.has_value());
  return growth->front();
}

TEST(RoundOffGrowth, OfRandomKicksIsARandomWalk) {
  const RoundOffGrowth g = growth_with({.random = 0.1});
  EXPECT_LT(std::abs(g.significance), 3);
  EXPECT_NEAR(g.exponent, 0.5, 0.1);
  // H = r^2 / 2 changes by 2 H times the kick, whose variance is 0.1^2 / 3.
  const double walk = 2 * 0.625 * unit_roundoff<double>() * 0.1 / std::sqrt(3.0) * std::sqrt(8192.0);
  EXPECT_NEAR(g.rms / walk, 1, 0.4);
  EXPECT_LE(excess_over_random_walk({g}), 1);
}

TEST(RoundOffGrowth, OfABiasIsSeenInTheMean) {
  const RoundOffGrowth g = growth_with({.random = 0.1, .bias = 0.005});
  EXPECT_GT(g.significance, 6);
  EXPECT_GT(excess_over_random_walk({g}), 2);
  EXPECT_LT(growth_with({.random = 0.1, .bias = -0.005}).significance, -6);
}

TEST(RoundOffGrowth, OfTrendsOfEitherSignIsSeenInTheExponent) {
  const RoundOffGrowth g = growth_with({.random = 0.02, .signed_trend = 0.005});
  EXPECT_LT(std::abs(g.significance), 3);
  EXPECT_GT(g.exponent, 0.8);
  EXPECT_GT(excess_over_random_walk({g}), 2);
}

TEST(RoundOffGrowth, OfTheWholeStateIsTooLarge) {
  const RoundOffGrowth g = growth_with({.random = 1});
  EXPECT_NEAR(g.exponent, 0.5, 0.1);
  EXPECT_GT(g.size, 1.5);
}

TEST(RoundOffGrowth, OfNothingButTheStatesThatAreSeenDoesNotGrow) {
  const RoundOffGrowth g = growth_with({});
  EXPECT_LT(g.rms, 2 * unit_roundoff<double>());
  EXPECT_EQ(excess_over_random_walk({g}), 0);  // less than a walk, which is better
}

// The step is as long as truncation allows, and no step does for a method of low order.
TEST(RoundOffGrowth, StepsKeepTruncationOutOfSight) {
  const auto model = systems().get("pendulum", "system").make({});
  const auto step = [&](const char* name, const Assignments& parameters) {
    const auto method = integrators().get(name, "integrator").make(parameters);
    return round_off_step(*method, model, generic_state(*model), 0, 1, 16384);
  };
  const auto six = step("gauss", {{"stages", "6"}}), eight = step("gauss", {{"stages", "8"}});
  ASSERT_TRUE(six && eight);
  EXPECT_GT(eight->h.value(), six->h.value());
  EXPECT_FALSE(step("gauss", {{"stages", "2"}}));
  EXPECT_FALSE(step("rk4", {}));
}

}  // namespace
}  // namespace pfaff
