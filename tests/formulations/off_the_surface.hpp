// Systems with constraints, random states off the surface of their constraints, and what a formulation gives
// at these states: the field, and the rates of the constraints and of the energy along it.
#pragma once

#include <random>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/linear/matrix.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>

#include "../formula_values.hpp"
#include "rods.hpp"

namespace pfaff::testing {

using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;

inline constexpr int points = 10;

/// The hanging chain of four, friction or none, about the golden state on the surface.
inline std::shared_ptr<const Model> chain(std::vector<Real> drag) {
  Rods rods = golden_rods();
  rods.drag = std::move(drag);
  const nlohmann::json state = golden_pendulum()["states"][0];
  std::vector<Real> initial = reals_of(state["q"]);
  for (const Real& x : reals_of(state["p"])) initial.push_back(x);
  return make_model(SystemDescriptor{.name = "rods", .title = "", .reference = "", .initial = initial}, rods);
}
inline std::vector<std::shared_ptr<const Model>> holonomic_models() {
  return {chain({}),
          model_named("spherical-pendulum"),
          model_named("sphere-particle"),
          model_named("torus-particle"),
          model_named("polar-double-pendulum"),
          model_named("shaken-pendulum")};
}

/// Random states within a tenth of the initial one: off the surface, where constraints are independent.
template <class T>
class Points {
 public:
  std::vector<T> near(const Model& model) {
    std::vector<T> z;
    for (const Real& x : model.initial()) z.push_back(T(x) + T(offset_(random_)));
    return z;
  }
  T time() { return T(1 + offset_(random_)); }

 private:
  std::mt19937_64 random_{20044};
  std::uniform_real_distribution<double> offset_{-0.1, 0.1};
};

template <class T>
std::vector<T> field(const std::shared_ptr<const Model>& model, const T& t, const std::vector<T>& z) {
  return evaluated(model, Formula::field, z, z.size(), t);
}

/// The rates of all constraints (each phi followed by its phi~) and of H along a motion, with the partial
/// derivative of H in time; and the largest of the terms that they are sums of.
template <class T>
struct Rates {
  Rates(const Model& model, const std::vector<T>& field, const T& t, const std::vector<T>& z) {
    const auto phi = model.tape(Formula::constraints), slopes = model.tape(Formula::constraint_gradients);
    const auto energy = model.tape(Formula::hamiltonian_gradient);
    const std::size_t n = z.size(), count = phi->outputs.size();
    const auto still = std::make_shared<const Tape>(
        record(phi->inputs, static_cast<int>(count), [&](const Recorded& s, Arguments x, Results out) {
          const auto rest = time_derivative(*phi, s, x);
          std::copy(rest.begin(), rest.end(), out.begin());
        }));
    const auto rows = values(slopes, t, z), moving = values(still, t, z), dh = values(energy, t, z);
    const auto add = [&](T& sum, const T& term) {
      sum = sum + term;
      size = std::max(size, abs(term));
    };
    for (std::size_t i = 0; i < count; ++i) {
      T sum(0);
      add(sum, moving[i]);
      for (std::size_t a = 0; a < n; ++a) add(sum, rows[i * n + a] * field[a]);
      (i % 2 == 0 ? phi_rates : hidden_rates).push_back(sum);
    }
    for (std::size_t a = 0; a < n; ++a) add(energy_rate, dh[a] * field[a]);
  }
  std::vector<T> phi_rates, hidden_rates;
  T energy_rate{0}, size{1};

  [[nodiscard]] double relative(const T& x) const { return static_cast<double>(abs(x) / size); }
  [[nodiscard]] double worst(const std::vector<T>& x) const {
    double largest = 0;
    for (const T& value : x)
      largest = std::max(largest, std::isnan(relative(value)) ? INFINITY : relative(value));
    return largest;
  }
};

// Rounding of the terms, times what solves with S amplify it by: its condition is below a hundred here.
template <class T>
inline constexpr double kept = 100 * bound<T>;

}  // namespace pfaff::testing
