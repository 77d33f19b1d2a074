// Systems with closed solutions for methods that choose their steps, and how runs of such methods end.
#pragma once

#include <gtest/gtest.h>

#include <limits>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/system.hpp>

namespace pfaff::testing {

struct Growth {  // z' = z
  static constexpr int dimension = 1;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[0];
  }
};
struct Blowing {  // z' = z^2, which is infinite at t = 1/z(0)
  static constexpr int dimension = 1;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[0] * z[0];
  }
};
template <class S>
std::shared_ptr<const Model> sample_of(S system, std::vector<Real> initial = {1}) {
  return make_model({.name = "sample", .title = "", .reference = "", .initial = std::move(initial)}, system);
}

/// A tolerance below round-off, and steps that get lost in the time, end with a status.
template <class T>
void expect_refused_tolerances(const MethodInstance& method) {
  const auto growing = method.stepper(sample_of(Growth{}), T());
  std::vector<T> z{T(1)};
  T t(0);
  EXPECT_EQ(growing->advance_to(t, T(1), std::numeric_limits<T>::epsilon() / T(2), z), Status::not_converged);
  EXPECT_TRUE(t == T(0));
  EXPECT_TRUE(z[0] == T(1));
  // From here on the solution 1/(1 - t) has no continuation: steps shrink until they no longer move the time.
  const auto blowing = method.stepper(sample_of(Blowing{}), T());
  EXPECT_NE(blowing->advance_to(t, T(2), T(1e-8), z), Status::converged);
  EXPECT_TRUE(t > T(0.99) && t < T(1.01));
}

}  // namespace pfaff::testing
