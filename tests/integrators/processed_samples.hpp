// What tests of processed methods share: a system that depends on time, and runs in one piece and in several.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/runs/integration.hpp>

namespace pfaff::testing {

// A pendulum that is pushed, so that it matters at which times forces are evaluated.
struct PushedPendulum {
  static constexpr int dimension = 2;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& t, In<T> q) const {
    return q[0] * sin(3 * t) - cos(q[0]);
  }
};

inline std::shared_ptr<const Model> pushed_pendulum() {
  return make_model({.name = "pushed", .title = "", .reference = "", .initial = {1, 0.3_r}},
                    PushedPendulum{});
}

template <class T>
struct Ended {
  std::vector<T> z;
  std::int64_t forces;
};

// `calls` calls of `steps` steps each, from the initial state.
template <class T>
Ended<T> ended(const MethodInstance& method, const std::shared_ptr<const Model>& model, int calls, int steps,
               const T& h) {
  std::vector<T> z;
  for (const Real& x : model->initial()) z.push_back(T(x));
  Integration<T> run(start_with<T>(method, model, std::move(z), h, T(0.4)));
  for (int k = 0; k < calls; ++k) run.steps(steps).expect_reached();
  return {{run.state().begin(), run.state().end()}, run.counters().fields};
}

inline double distance(const std::vector<Quad>& a, const std::vector<Quad>& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    largest = std::max(largest, std::abs(static_cast<double>(a[k] - b[k])));
  return largest;
}

// Thirty steps at once, ten times three and thirty times one. The states are of size 1, and a flow rounds by
// some units of 1e-34.
inline void expect_one_map(const MethodInstance& method, const std::shared_ptr<const Model>& model,
                           double limit) {
  ASSERT_TRUE(method.processed());
  const Quad h(0.1);
  const auto single = ended(method, model, 30, 1, h).z;
  EXPECT_LT(distance(ended(method, model, 1, 30, h).z, single), limit) << method.called();
  EXPECT_LT(distance(ended(method, model, 10, 3, h).z, single), limit) << method.called();
  const auto backwards = ended(method, model, 30, 1, -h).z;
  EXPECT_LT(distance(ended(method, model, 1, 30, -h).z, backwards), limit) << method.called();
}

}  // namespace pfaff::testing
