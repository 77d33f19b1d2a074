// The largest errors of invariants, watched in lanes and not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <pfaff/core/system.hpp>
#include <pfaff/runs/integrate.hpp>
#include <pfaff/runs/invariant_errors.hpp>

#include "explosion.hpp"
#include "notes.hpp"

namespace pfaff {
namespace {

using testing::Notes;

// The largest errors of invariants are those of the states one by one, to the last bit, in lanes and not.
TEST(InvariantErrors, AreThoseOfTheStates) {
  for (const char* system : {"kepler", "n-pendulum", "damped-oscillator"}) {
    SCOPED_TRACE(system);
    auto run = integrate(system, {}, "gauss", {}, {.step = "0.05", .block_rows = 13});
    InvariantErrors errors;
    Notes notes;
    run.watch(errors);
    run.watch(notes);
    EXPECT_TRUE(run.steps(100).reached());
    const Problem<double> problem(run.model());
    const std::size_t count = run.model()->invariants().size();
    std::vector<double> first(count), now(count), largest(count);
    problem.invariants(0, notes.states[0], first);
    for (std::size_t k = 0; k < notes.states.size(); ++k) {
      problem.invariants(notes.times[k], notes.states[k], now);
      for (std::size_t i = 0; i < count; ++i) largest[i] = std::max(largest[i], std::abs(now[i] - first[i]));
    }
    EXPECT_EQ(errors.largest(), largest);
    EXPECT_GT(count, 0U);
  }
}

// x' = -1 leads out of the domain of the root.
struct Falling {
  static constexpr int dimension = 1;
  template <class T>
  void field(const T& /*t*/, In<T> /*z*/, Out<T> rate) const {
    rate[0] = T(-1);
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = sqrt(z[0]);
    values[1] = z[0] + t;
  }
};
TEST(InvariantErrors, AreInfiniteWhereAValueIsNotFinite) {
  const auto model = make_model({.name = "falling",
                                 .title = "",
                                 .reference = "",
                                 .coordinates = {{"x", ""}},
                                 .initial = {1},
                                 .invariants = {decreasing("root", ""), conserved("sum", "")}},
                                Falling{});
  for (const std::size_t steps : {3U, 5U, 8U, 9U, 20U}) {
    auto run = integrate<double>(model, integrators().get("rk4", "integrator").make({}), 0.25);
    InvariantErrors errors;
    run.watch(errors);
    EXPECT_TRUE(run.steps(static_cast<std::int64_t>(steps)).reached());
    EXPECT_EQ(std::isfinite(errors.largest()[0]), steps <= 4) << steps;
    EXPECT_LT(errors.largest()[1], 1e-15) << steps;
  }
}

// What was watched before is forgotten, also on a model without invariants.
TEST(InvariantErrors, BeginAnewWithEachRun) {
  InvariantErrors errors;
  auto with = integrate("kepler", {}, "rk4", {}, {.step = "0.1"});
  with.watch(errors);
  EXPECT_TRUE(with.steps(10).reached());
  EXPECT_FALSE(errors.largest().empty());
  auto without =
      integrate<double>(testing::explosion(), integrators().get("rk4", "integrator").make({}), 0.125);
  without.watch(errors);
  EXPECT_TRUE(without.steps(3).reached());
  EXPECT_TRUE(errors.largest().empty());
}

}  // namespace
}  // namespace pfaff
