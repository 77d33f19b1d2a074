// Models and runs that the tests of methods for velocity constraints share.
#pragma once

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/tests/formulations/velocity_systems.hpp>

#include "../golden_numbers.hpp"
#include "methods.hpp"

namespace pfaff::nonholonomic {

using testing::after_steps;
using testing::distance;
using testing::golden;
using testing::initial_state;
using testing::method_named;
using testing::numbers;
using testing::values;

inline const std::vector<const char*> staggered{"gni", "nonholonomic-leap-frog"};

inline std::vector<nlohmann::json> golden_cases() {
  const auto cases = golden("J").at("cases");
  return {cases.begin(), cases.begin() + 4};
}

template <class T>
std::vector<T> joined(std::vector<T> a, const std::vector<T>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// The systems of the golden values, in their order, each with the reversal (q, p) -> (q, -p).
template <class S>
struct Reversible : S {
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    for (std::size_t k = 0; k < z.size(); ++k) reversed[k] = k < z.size() / 2 ? z[k] : T(-z[k]);
  }
};
template <class S>
std::shared_ptr<const Model> golden_model(const char* name, const nlohmann::json& entry) {
  std::vector<Real> initial;
  for (const Quad& x : joined(numbers<Quad>(entry["q0"]), numbers<Quad>(entry["p0"])))
    initial.emplace_back(x);
  return make_model(
      SystemDescriptor{.name = name, .title = "", .reference = "", .initial = std::move(initial)},
      Reversible<S>{});
}
inline std::vector<std::shared_ptr<const Model>> golden_models() {
  const auto cases = golden_cases();
  return {golden_model<testing::ContactOscillator>("contact", cases[0]),
          golden_model<testing::KnifeEdge>("edge", cases[1]),
          golden_model<testing::Snakeboard>("board", cases[2]),
          golden_model<testing::ChaplyginSleigh>("sleigh", cases[3])};
}

inline std::unique_ptr<MethodInstance> composed(const char* base, const char* scheme, const char* order) {
  return method_named("composition", {{"scheme", scheme}, {"order", order}, {"base", base}});
}

/// H_p.
template <class T>
std::vector<T> velocity(const Model& model, const std::vector<T>& z) {
  const auto slopes = values(model, Formula::hamiltonian_gradient, T(0), z);
  return {slopes.begin() + static_cast<std::ptrdiff_t>(z.size() / 2), slopes.end()};
}
template <class T>
double slip(const Model& model, const T& t, const std::vector<T>& z) {
  T largest(0);
  for (const T& x : values(model, Formula::constraints, t, z)) largest = std::max(largest, T(abs(x)));
  return static_cast<double>(largest);
}
inline std::vector<Quad> positions(const std::vector<Quad>& z) {
  return {z.begin(), z.begin() + static_cast<std::ptrdiff_t>(z.size() / 2)};
}

/// By how much 40 steps in quad change the energy of the initial state.
inline double energy_error(const MethodInstance& method, const std::shared_ptr<const Model>& model) {
  const auto start = initial_state(*model), z = after_steps(method, model, Quad(0.125), 40, start);
  const auto energy = [&](const std::vector<Quad>& at) {
    return values(*model, Formula::hamiltonian, Quad(0), at).front();
  };
  return static_cast<double>(abs(energy(z) - energy(start)));
}

}  // namespace pfaff::nonholonomic
