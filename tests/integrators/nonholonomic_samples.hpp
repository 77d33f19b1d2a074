// Models and runs that the tests of methods for velocity constraints share.
#pragma once

#include <fstream>
#include <pfaff/bench/runner/json.hpp>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/tests/formulations/velocity_systems.hpp>

namespace pfaff::nonholonomic {

inline std::vector<nlohmann::json> golden_cases() {
  const auto cases = nlohmann::json::parse(std::ifstream(PFAFF_GOLDEN "/J.json")).at("cases");
  return {cases.begin(), cases.begin() + 4};
}

template <class T>
std::vector<T> numbers(const nlohmann::json& list) {
  std::vector<T> out;
  for (const auto& text : list) out.push_back(T(*Real::parse(text.get<std::string>())));
  return out;
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

inline std::unique_ptr<MethodInstance> method(const std::string& name, const Assignments& parameters = {}) {
  return integrators().get(name, "integrator").make(parameters);
}
inline std::unique_ptr<MethodInstance> composed(const char* base, const char* scheme, const char* order) {
  return method("composition", {{"scheme", scheme}, {"order", order}, {"base", base}});
}

template <class T>
std::vector<T> initial(const Model& model) {
  std::vector<T> z;
  for (const Real& x : model.initial()) z.push_back(T(x));
  return z;
}
/// The state after `count` steps of size h from z at t.
template <class T>
std::vector<T> run(const MethodInstance& method, const std::shared_ptr<const Model>& model, const T& h,
                   std::int64_t count, std::vector<T> z, const T& t = T(0)) {
  const auto stepper = method.stepper(model, T());
  std::int64_t completed = 0;
  EXPECT_EQ(stepper->advance(t, 0, h, count, z, completed), Status::converged)
      << method.called() << " on " << model->name() << " after " << completed;
  return z;
}
template <class T>
std::vector<T> values(const Model& model, Formula formula, const T& t, const std::vector<T>& z) {
  Replay<T> replay(model.tape(formula));
  std::vector<T> out(replay.tape().outputs.size());
  replay(t, z.data(), out.data());
  return out;
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
template <class T>
double distance(const std::vector<T>& a, const std::vector<T>& b) {
  EXPECT_EQ(a.size(), b.size());
  T largest(0);
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
    largest = std::max(largest, T(abs(a[k] - b[k])));
  return static_cast<double>(largest);
}
inline std::vector<Quad> positions(const std::vector<Quad>& z) {
  return {z.begin(), z.begin() + static_cast<std::ptrdiff_t>(z.size() / 2)};
}

}  // namespace pfaff::nonholonomic
