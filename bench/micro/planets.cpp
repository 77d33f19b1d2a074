// The outer solar system over 1e7 days, in which Jupiter goes round 2308 times: Gauss collocation with long
// steps and the symmetric multistep method of Quinlan and Tremaine of order 10, one force a step, both on the
// registered path, beside Verlet's method as a loop by hand with merged drifts and steps of 25 days. The
// error is the largest relative one of the energy.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/integrators/tables/method_table.hpp>

#include "whole_runs.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::micro;

constexpr std::size_t bodies = 6;
constexpr double attraction = 2.95912208286e-4, duration = 1e7;
constexpr std::array<double, bodies> masses{1.00000597682,      0.000954786104043,  0.000285583733151,
                                            0.0000437273164546, 0.0000517759138449, 1 / 1.3e8};
using Row = std::array<double, bodies>;
using Planets = std::array<double, 6 * bodies>;  // positions and momenta, direction by direction

Planets planets() {
  const auto model = systems().get("outer-solar-system", "system").make({});
  Planets z;
  for (std::size_t k = 0; k < 6 * bodies; ++k) z[k] = model->initial()[k].value();
  return z;
}

double energy(const Planets& state) {
  const auto z = [&](std::size_t row, std::size_t i) { return state[row * bodies + i]; };
  double sum = 0;
  for (std::size_t i = 0; i < bodies; ++i) {
    sum += (z(3, i) * z(3, i) + z(4, i) * z(4, i) + z(5, i) * z(5, i)) / (2 * masses[i]);
    for (std::size_t j = 0; j < i; ++j)
      sum -= attraction * masses[i] * masses[j] /
             std::hypot(z(0, i) - z(0, j), z(1, i) - z(1, j), z(2, i) - z(2, j));
  }
  return sum;
}

void verlet_by_hand(Planets& z, double step, std::int64_t steps) {
  std::array<Row, 3> q{}, v{};
  for (std::size_t x = 0; x < 3; ++x)
    for (std::size_t i = 0; i < bodies; ++i) {
      q[x][i] = z[x * bodies + i];
      v[x][i] = z[(3 + x) * bodies + i] / masses[i];
    }
  const auto drift = [&](double h) {
    for (std::size_t x = 0; x < 3; ++x)
      for (std::size_t i = 0; i < bodies; ++i) q[x][i] += h * v[x][i];
  };
  const auto kick = [&](double h) {
    for (std::size_t i = 1; i < bodies; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double a = q[0][j] - q[0][i], b = q[1][j] - q[1][i], c = q[2][j] - q[2][i];
        const double square = a * a + b * b + c * c, pull = h * attraction / (square * std::sqrt(square));
        const double of_i = pull * masses[j], of_j = pull * masses[i];
        v[0][i] += of_i * a;
        v[1][i] += of_i * b;
        v[2][i] += of_i * c;
        v[0][j] -= of_j * a;
        v[1][j] -= of_j * b;
        v[2][j] -= of_j * c;
      }
  };
  drift(step / 2);
  for (std::int64_t k = 1; k < steps; ++k) {
    kick(step);
    drift(step);
  }
  kick(step);
  drift(step / 2);
  for (std::size_t x = 0; x < 3; ++x)
    for (std::size_t i = 0; i < bodies; ++i) {
      z[x * bodies + i] = q[x][i];
      z[(3 + x) * bodies + i] = v[x][i] * masses[i];
    }
}

// A run of so many steps.
void add_registered(const std::string& name, const MethodPlugin& method, const Assignments& parameters,
                    std::int64_t steps) {
  const std::shared_ptr<Stepper<double>> stepper =
      method.make(parameters)->stepper(systems().get("outer-solar-system", "system").make({}), 0.0);
  const double step = duration / static_cast<double>(steps);
  const auto advance = [=](Planets& z, std::int64_t first, std::int64_t count) {
    std::int64_t completed = 0;
    stepper->advance(0, first, step, count, z, completed);
  };
  const Planets start = planets();
  const double initial = energy(start);
  double error = 0;
  Planets z = start;
  for (std::int64_t k = 0; k < steps; ++k) {
    advance(z, k, 1);
    error = std::max(error, std::abs(energy(z) / initial - 1));
  }
  add_run("outer-solar-system-run/" + name + "-h" + step_name(step) + "/registered", start, "energy_error",
          error, [=](Planets& at) { advance(at, 0, steps); });
}

bool add_runs() {
  const Planets start = planets();
  const volatile double step = 25;  // the compiler is to compute nothing beforehand
  Planets end = start;
  verlet_by_hand(end, step, 400000);
  // The error of Verlet's method oscillates; that at the end stands for it.
  add_run("outer-solar-system-run/verlet-h25/by-hand", start, "energy_error",
          std::abs(energy(end) / energy(start) - 1),
          [unknown = double(step)](Planets& z) { verlet_by_hand(z, unknown, 400000); });
  add_registered("gauss-16", integrators().get("gauss", "integrator"), {{"stages", "8"}}, 12500);
  add_registered("quinlan-tremaine-10", integrator_named(PFAFF_TABLES "/quinlan-tremaine-10.toml"), {},
                 285714);
  return true;
}

[[maybe_unused]] const bool added = add_runs();
}  // namespace
