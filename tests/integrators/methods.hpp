// Methods by their names, and the states that they lead to.
#pragma once

#include <gtest/gtest.h>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/runs/integration.hpp>

#include "../formula_values.hpp"

namespace pfaff::testing {

inline std::unique_ptr<MethodInstance> method_named(const std::string& name,
                                                    const Assignments& parameters = {}) {
  return integrators().get(name, "integrator").make(parameters);
}
/// The generating-function scheme truncated at degree `order`.
inline std::unique_ptr<MethodInstance> generating_scheme(int order, const char* variant) {
  return method_named("generating-function",
                      {{"order", std::to_string(order)}, {"variant", variant}, {"extra", "0"}});
}

/// The state after `count` steps of size h from z at t.
template <class T>
std::vector<T> after_steps(const MethodInstance& method, const std::shared_ptr<const Model>& model,
                           const T& h, std::int64_t count, std::vector<T> z, const T& t = T(0)) {
  Integration<T> run(start_with<T>(method, model, std::move(z), h, t));
  const Outcome outcome = run.steps(count);
  EXPECT_TRUE(outcome.reached()) << method.called() << " on " << model->name() << ": " << outcome.message();
  return {run.state().begin(), run.state().end()};
}
/// The same from the initial state of the model.
template <class T>
std::vector<T> after_steps(const MethodInstance& method, const std::shared_ptr<const Model>& model,
                           const T& h, std::int64_t count) {
  return after_steps(method, model, h, count, initial_state<T>(*model));
}

}  // namespace pfaff::testing
