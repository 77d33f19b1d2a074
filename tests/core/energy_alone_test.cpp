// Where a second bracket, applied forces or constraints take part, the field of the energy alone is not the
// motion: neither what was compiled of force and velocity is used as the field, nor does the static path
// offer one.
#include <gtest/gtest.h>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/facets/static_problem.hpp>
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

const SystemDescriptor trap_descriptor{.name = "trap", .title = "", .reference = ""};

// H = p^2/2 + q^4/4, everything written.
struct Trap {
  static constexpr int dimension = 2;
  static std::vector<Parameter> parameters() { return {}; }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0] * q[0] * q[0] * q[0] / 4;
  }
  template <class T>
  void force(const T& /*t*/, In<T> q, Out<T> f) const {
    f[0] = -q[0] * q[0] * q[0];
  }
  template <class T>
  void velocity(const T& /*t*/, In<T> p, Out<T> v) const {
    v[0] = p[0];
  }
};
// G = diag(0, 3): p' = -V_q - 3 T_p.
struct Friction {
  template <class T>
  void sharp(const T& /*t*/, In<T> /*z*/, In<T> covector, Out<T> vector) const {
    vector[0] = T(0);
    vector[1] = 3 * covector[1];
  }
};
struct TrapWithFriction : Trap {
  [[nodiscard]] Friction symmetric_bracket() const { return {}; }
};
struct TrapWithFieldAndFriction : TrapWithFriction {
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = -z[0] * z[0] * z[0] - 3 * z[1];
  }
};
struct BatchedTrapWithFriction : TrapWithFriction {
  static constexpr bool batched = true;
};
struct TrapWithAppliedForce : Trap {
  template <class T>
  void applied_force(const T& /*t*/, In<T> z, Out<T> f) const {
    f[0] = -3 * z[1];
  }
};
struct BatchedTrapWithAppliedForce : TrapWithAppliedForce {
  static constexpr bool batched = true;
};
struct TrapOnASurface : Trap {
  static constexpr int constraint_count = 1;
  template <class T>
  void holonomic(const T& /*t*/, In<T> q, Out<T> phi) const {
    phi[0] = q[0] - 1;
  }
};
struct TrapWithABlade : Trap {
  static constexpr int velocity_constraint_count = 1;
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = q[0];
  }
};

// p' at (q, p) = (1, 2), as a run in double evaluates it.
template <class S>
double momentum_rate() {
  const Problem<double> problem(make_model(trap_descriptor, S{}));
  auto z = problem.make_state(), rate = problem.make_state();
  z[0] = 1;
  z[1] = 2;
  problem.field(0, z, rate);
  return rate[1];
}

TEST(EnergyAlone, FrictionIsInTheFieldOfRunsInDouble) {
  EXPECT_EQ(momentum_rate<TrapWithFriction>(), -7);
  EXPECT_EQ(momentum_rate<TrapWithFieldAndFriction>(), -7);
  EXPECT_EQ(momentum_rate<BatchedTrapWithFriction>(), -7);
  EXPECT_EQ(momentum_rate<TrapWithAppliedForce>(), -7);
  EXPECT_EQ(momentum_rate<BatchedTrapWithAppliedForce>(), -7);
  EXPECT_EQ(momentum_rate<Trap>(), -1);
}
TEST(EnergyAlone, WhatIsCompiledOfForceAndVelocityIsTheFieldOfTheEnergyOnly) {
  EXPECT_NE(make_model(trap_descriptor, Trap{})->compiled(Formula::field), nullptr);
  EXPECT_EQ(make_model(trap_descriptor, TrapWithFriction{})->compiled(Formula::field), nullptr);
  EXPECT_EQ(make_model(trap_descriptor, TrapWithAppliedForce{})->compiled(Formula::field), nullptr);
}
TEST(EnergyAlone, StaticProblemsOfferNoFieldOfIt) {
  static_assert(HasVectorField<StaticProblem<Trap>> && HasSeparable<StaticProblem<Trap>>);
  static_assert(!HasVectorField<StaticProblem<TrapWithFriction>>);
  static_assert(!HasSeparable<StaticProblem<TrapWithFriction>>);
  static_assert(!HasDarbouxChart<StaticProblem<TrapWithFriction>>);
  static_assert(!HasVectorField<StaticProblem<TrapWithAppliedForce>>);
  static_assert(!HasSeparable<StaticProblem<TrapWithAppliedForce>>);
  static_assert(HasVectorField<StaticProblem<TrapWithFieldAndFriction>>);
  static_assert(!HasSeparable<StaticProblem<TrapWithFieldAndFriction>>);
  static_assert(!HasVectorField<StaticProblem<TrapOnASurface>> &&
                !HasSeparable<StaticProblem<TrapOnASurface>>);
  static_assert(!HasVectorField<StaticProblem<TrapWithABlade>> &&
                !HasSeparable<StaticProblem<TrapWithABlade>>);

  const StaticProblem<TrapWithFieldAndFriction> problem;
  StaticProblem<TrapWithFieldAndFriction>::State z, rate;
  z[0] = 1;
  z[1] = 2;
  problem.field(0, z, rate);
  EXPECT_EQ(rate[1], -7);
}
}  // namespace
