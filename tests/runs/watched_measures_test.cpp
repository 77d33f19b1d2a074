// The measures of what is watched along runs: drift, constraints, error and cost, beside loops written here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <pfaff/core/facets/problem.hpp>

#include "measured_table.hpp"

namespace pfaff {
namespace {

using testing::to_measure;
using testing::ToMeasure;

std::size_t column(const MeasuredTable& table, const std::string& name) {
  const auto found = std::find_if(table.columns.begin(), table.columns.end(),
                                  [&](const Column& one) { return one.name == name; });
  EXPECT_NE(found, table.columns.end()) << name;
  return static_cast<std::size_t>(found - table.columns.begin());
}
double cell(const MeasuredTable& table, std::size_t row, const std::string& name) {
  return testing::number(table.lines.at(row), column(table, name));
}
std::string text(const MeasuredTable& table, std::size_t row, const std::string& name) {
  return std::get<std::string>(table.lines.at(row).cells[column(table, name)]);
}

// The states of a run after each step, the start first.
std::vector<std::vector<double>> states_of(const ToMeasure& run) {
  std::vector<std::vector<double>> states{{run.start.state().begin(), run.start.state().end()}};
  Integration<double> going = run.start.beside(std::vector<double>(states.front()));
  for (std::int64_t n = 0; n < run.steps; ++n) {
    EXPECT_TRUE(going.steps(1).reached());
    states.emplace_back(going.state().begin(), going.state().end());
  }
  return states;
}

// The largest difference and the last one are those of a loop, to the bit: both subtract the same numbers.
TEST(DriftMeasure, IsThatOfALoop) {
  for (const char* method : {"verlet", "rk4", "gauss"}) {
    const ToMeasure run = to_measure("kepler", method, "0.05", {}, 200);
    const MeasuredTable table = table_of("drift", run);
    EXPECT_EQ(table.ended, "");
    Problem<double> problem(run.start.model());
    const std::size_t count = run.start.model()->invariants().size();
    ASSERT_EQ(table.lines.size(), count);
    std::vector<double> first(count), now(count), largest(count, 0);
    const auto states = states_of(run);
    problem.invariants(0, states.front(), first);
    for (const auto& z : states) {
      problem.invariants(0, z, now);
      for (std::size_t i = 0; i < count; ++i) largest[i] = std::max(largest[i], std::abs(now[i] - first[i]));
    }
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(text(table, i, "quantity"), run.start.model()->invariants()[i].name);
      EXPECT_EQ(cell(table, i, "max"), largest[i]) << method << i;
      EXPECT_EQ(cell(table, i, "final"), now[i] - first[i]) << method << i;
      EXPECT_EQ(cell(table, i, "samples"), static_cast<double>(run.steps + 1));
    }
    // The energy of Verlet is bounded and that of RK4 falls at a constant rate; how that of Gauss wanders
    // over thirty revolutions nobody can tell.
    const std::string expected = std::string(method) == "verlet" ? "bounded" : "linear";
    if (std::string(method) != "gauss") {
      EXPECT_EQ(text(table, 0, "class"), expected) << method << ": " << text(table, 0, "evidence");
    }
  }
}

// What is conserved has a drift, what may only rise or fall a setback, and nothing has both. Steps of RK4
// that are too long make the energy rise, which ought to fall: by as much as a loop finds, to the bit.
TEST(DriftMeasure, HasSetbacksOfWhatMayOnlyFall) {
  const ToMeasure run = to_measure("damped-oscillator", "rk4", "3", {}, 60);
  const MeasuredTable table = table_of("drift", run);
  ASSERT_EQ(table.lines.size(), 2U);
  EXPECT_EQ(text(table, 0, "quantity"), "birkhoffian");
  EXPECT_FALSE(std::isnan(cell(table, 0, "max")));
  EXPECT_TRUE(std::isnan(cell(table, 0, "setback")));
  EXPECT_EQ(text(table, 1, "quantity"), "energy");
  EXPECT_TRUE(std::isnan(cell(table, 1, "max")));
  Problem<double> problem(run.start.model());
  std::vector<double> values(2);
  double lowest = std::numeric_limits<double>::infinity(), rise = 0;
  for (const auto& z : states_of(run)) {
    problem.invariants(0, z, values);
    lowest = std::min(lowest, values[1]);
    rise = std::max(rise, values[1] - lowest);
  }
  EXPECT_GT(rise, 1);
  EXPECT_EQ(cell(table, 1, "setback"), rise);
}

// phi of a particle on a sphere is a multiple of q.q - r^2, and the hidden constraint is what follows of it,
// twice that multiple of q.p for a unit mass.
TEST(ConstraintsMeasure, IsThatOfALoop) {
  const ToMeasure run = to_measure("sphere-particle", "rk4", "0.1", {}, 20);
  const MeasuredTable table = table_of("constraints", run);
  ASSERT_EQ(table.lines.size(), 2U);
  const auto states = states_of(run);
  double off_sphere = 0, off_tangent = 0, last = 0;
  double radius = 0;
  for (int k = 0; k < 3; ++k)
    radius += states.front()[static_cast<std::size_t>(k)] * states.front()[static_cast<std::size_t>(k)];
  for (const auto& z : states) {
    const double square = z[0] * z[0] + z[1] * z[1] + z[2] * z[2];
    last = std::abs(square - radius);
    off_sphere = std::max(off_sphere, last);
    off_tangent = std::max(off_tangent, std::abs(z[0] * z[3] + z[1] * z[4] + z[2] * z[5]));
  }
  ASSERT_GT(off_sphere, 1e-8);
  // The factors of phi are those of the system's own formulas, whatever they are; both levels share them.
  const double factor = cell(table, 0, "final") / last;
  EXPECT_NEAR(cell(table, 0, "max"), factor * off_sphere, 1e-15);
  EXPECT_NEAR(cell(table, 1, "max"), 2 * factor * off_tangent, 1e-14);
  EXPECT_TRUE(std::abs(factor - 1) < 1e-6 || std::abs(factor - 0.5) < 1e-6) << factor;
  EXPECT_FALSE(fits("constraints", to_measure("kepler", "rk4", "0.1", {}, 1)));
}

// The oscillator begins at (1, 0), so that its solution is (cos t, -sin t), of size one.
TEST(ErrorMeasure, IsThatOfAClosedForm) {
  const ToMeasure run = to_measure("harmonic-oscillator", "verlet", "0.1", {}, 30);
  const MeasuredTable table = table_of("error(looks=30)", run);
  ASSERT_EQ(table.lines.size(), 31U);
  const auto states = states_of(run);
  for (std::size_t row = 0; row < table.lines.size(); ++row) {
    const auto n = static_cast<std::size_t>(table.lines[row].step);
    const double t = 0.1 * static_cast<double>(n), q = std::cos(t), p = -std::sin(t);
    // Roundings of cos and of its argument.
    EXPECT_NEAR(cell(table, row, "error"), std::hypot(states[n][0] - q, states[n][1] - p), 1e-14) << n;
  }
}

// Of r'' + nu r' + r = 0 from (1, 0) the solution is known, and with it the energy (r^2 + p^2)/2; what is
// conserved has no error. Roundings of a few functions of a size of one are allowed.
TEST(ErrorMeasure, TellsWhatChangesAlongTheMotion) {
  const ToMeasure run = to_measure("damped-oscillator", "rk4", "0.1", {{"nu", "0.3"}}, 5);
  const MeasuredTable table = table_of("error(looks=5)", run);
  EXPECT_EQ(table.ended, "");
  ASSERT_EQ(table.columns.size(), 2U);
  ASSERT_EQ(table.lines.size(), 6U);
  const auto states = states_of(run);
  const double decay = 0.15, turn = std::sqrt(1 - decay * decay);
  for (std::size_t row = 0; row < table.lines.size(); ++row) {
    const auto n = static_cast<std::size_t>(table.lines[row].step);
    const double t = 0.1 * static_cast<double>(n), size = std::exp(-decay * t);
    const double r = size * (std::cos(turn * t) + decay / turn * std::sin(turn * t));
    const double p = -size * std::sin(turn * t) / turn;
    const double off = (states[n][0] * states[n][0] + states[n][1] * states[n][1] - r * r - p * p) / 2;
    EXPECT_NEAR(cell(table, row, "energy:error"), off, 1e-15) << n;
    if (n > 0) {
      EXPECT_GT(std::abs(off), 1e-8);
    }
  }
}

// Methods on constraints step on a model without a field of its own; its motion is that of the multipliers.
TEST(ErrorMeasure, IsOfRunsOnConstraintsToo) {
  const ToMeasure run = to_measure("spherical-pendulum", "rattle", "0.01", {}, 1);
  const MeasuredTable table = table_of("error(looks=2)", run);
  ASSERT_EQ(table.lines.size(), 3U);
  EXPECT_EQ(table.ended, "");
  const double error = cell(table, 2, "error");
  const MeasuredTable half =
      table_of("error(looks=2)", to_measure("spherical-pendulum", "rattle", "0.005", {}, 1));
  EXPECT_GT(error, 1e-6);
  EXPECT_NEAR(error / cell(half, 2, "error"), 4, 0.1);  // of order 2, and the next term is h^2 smaller
}

TEST(CostMeasure, CountsWhatTheRunCounts) {
  const ToMeasure run = to_measure("pendulum", "gauss", "0.1", {}, 10);
  const MeasuredTable table = table_of("cost", run);
  ASSERT_EQ(table.lines.size(), 1U);
  Integration<double> again =
      run.start.beside(std::vector<double>(run.start.state().begin(), run.start.state().end()));
  ASSERT_TRUE(again.steps(run.steps).reached());
  const auto steps = static_cast<double>(run.steps);
  EXPECT_EQ(cell(table, 0, "rhs_per_step"), static_cast<double>(again.counters().fields) / steps);
  EXPECT_EQ(cell(table, 0, "iterations_per_step"), static_cast<double>(again.counters().iterations) / steps);
  EXPECT_GT(cell(table, 0, "iterations_per_step"), 1);
}

// A state that is not finite ends the tables that it concerns, in a line, and no other.
TEST(WatchedMeasures, EndWhereSomethingIsNotFinite) {
  const ToMeasure run = to_measure("lotka-volterra", "rk4", "20", {}, 400);
  const auto drift = measure_asked_for("drift"), cost = measure_asked_for("cost");
  const auto tables = measured(run.start, run.steps, {drift.get(), cost.get()});
  EXPECT_NE(tables[0].ended, "");
  EXPECT_EQ(tables[0].ended.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace pfaff
