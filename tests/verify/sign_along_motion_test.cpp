// Quantities that are said to fall or to rise, judged along the motion besides at random states.
#include <gtest/gtest.h>

#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/verify/sign_along_motion.hpp>

#include "judged.hpp"

namespace pfaff {
namespace {

using testing::bad;
using testing::Names;

// The phase of a clock.
struct Clock {
  static constexpr int dimension = 1;
  template <class T>
  void field(const T& /*t*/, In<T> /*z*/, Out<T> rate) const {
    rate[0] = T(1);
  }
};
double largest_of_sine_less(Real less) {
  static const System<Clock> clock{{.name = "clock", .title = "", .reference = "", .initial = {0}}};
  const std::shared_ptr<const Model> model = clock.make({});
  const auto rate = expression(
      1, 1, [&](const Recorded& /*t*/, Arguments z, Results out) { out[0] = sin(z[0]) - Recorded(less); });
  FollowedMotion motion(model, region_of(*model, generic_state(*model)));
  return largest_along(motion, rate, rate);
}

// The sine comes to one five times within 32 units of time, between two of 512 looks, at none of which it is
// nearer to one than 1e-6.
TEST(SignAlongMotion, MaximaBetweenLooksAreFound) {
  EXPECT_GT(largest_of_sine_less(1 - 1_r / 1000000000), 1e-10);
  EXPECT_EQ(largest_of_sine_less(1 + 1_r / 1000000000), 0);
  EXPECT_GT(largest_of_sine_less(0), 0.1);
}

// Van der Pol's oscillator, whose friction feeds it in a thin layer about q = 0 that every swing crosses.
struct ThinLayer {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = -z[0] + (0.0009_r - z[0] * z[0]) * z[1];
  }
  template <class T>
  void invariants(const T& /*t*/, In<T> z, Out<T> values) const {
    values[0] = (z[0] * z[0] + z[1] * z[1]) / 2;
  }
};
// x and y come together. The rate of the quantity, -(x - y)^2, is written as a sum that cancels.
struct Meeting {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1] - z[0];
    rate[1] = z[0] - z[1];
  }
  template <class T>
  void invariants(const T& /*t*/, In<T> z, Out<T> values) const {
    values[0] = (z[0] * z[0] + z[1] * z[1]) / 2;
  }
};

Invariant falling(const char* name) {
  Invariant invariant;
  invariant.name = name;
  invariant.behaviour = Behaviour::decreasing;
  return invariant;
}

TEST(SignAlongMotion, AThinLayerIsMet) {
  static const System<ThinLayer> layer{{.name = "thin-layer",
                                        .title = "",
                                        .reference = "",
                                        .initial = {2, 0},
                                        .invariants = {falling("energy")}}};
  EXPECT_EQ(bad(check_system(layer)), (Names{"decreases energy along the motion"}));
}

// A -> B -> C, of which B begins at zero: what is stated holds for amounts that are not negative, and the
// state at which claims are measured is one of these.
struct Decays {
  static constexpr int dimension = 3;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = -2 * z[0];
    rate[1] = 2 * z[0] - z[1];
    rate[2] = z[1];
  }
  template <class T>
  void invariants(const T& /*t*/, In<T> z, Out<T> values) const {
    values[0] = -z[2];
  }
};

TEST(SignAlongMotion, StatesAreInTheRangesOfTheirCoordinates) {
  const Range amount{0, 1};
  static const System<Decays> decays{
      {.name = "decays",
       .title = "",
       .reference = "",
       .coordinates = {{"A", "", amount}, {"B", "", amount}, {"C", "", amount}},
       .initial = {1, 0, 0},
       .invariants = {falling("less C")}}};
  EXPECT_EQ(bad(check_system(decays)), Names{});
}

// Two bodies exchange heat, whose entropy log x + 2 log y rises. Backwards in time one comes to be negative,
// where the rate of the entropy has a value and the entropy none.
struct Exchange {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = (z[1] - z[0]) / 10;
    rate[1] = (z[0] - z[1]) / 20;
  }
  template <class T>
  void invariants(const T& /*t*/, In<T> z, Out<T> values) const {
    values[0] = -log(z[0]) - 2 * log(z[1]);
  }
};

TEST(SignAlongMotion, AQuantityHasToHaveAValue) {
  static const System<Exchange> exchange{{.name = "exchange",
                                          .title = "",
                                          .reference = "",
                                          .initial = {4, 3},
                                          .invariants = {falling("less entropy")}}};
  EXPECT_EQ(bad(check_system(exchange)), Names{});
}

TEST(SignAlongMotion, ARateThatComesToZeroIsNone) {
  static const System<Meeting> meeting{
      {.name = "meeting", .title = "", .reference = "", .initial = {1, 2}, .invariants = {falling("size")}}};
  EXPECT_EQ(bad(check_system(meeting)), Names{});
}

}  // namespace
}  // namespace pfaff
