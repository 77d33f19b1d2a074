// Motions that come to rest. Their momenta become smaller than what the forces round, which cancel each other
// there: steps converge as elsewhere, and end where the forces vanish. An iteration that stagnates because it
// has no solution does not converge there, either.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/core/system.hpp>
#include <pfaff/runs/integrate.hpp>

#include "method_files.hpp"
#include "methods.hpp"

namespace pfaff {
namespace {

using testing::method_named;
using testing::shipped_tables;

// A mass on a spring that carries its weight: at rest, q = -weight.
struct Hanging {
  static constexpr int dimension = 2;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0] * q[0] / 2 + T(Real::fraction(981, 100)) * q[0];
  }
};
// The same with damping.
struct DampedHanging : Hanging {
  [[nodiscard]] Real damping() const { return Real(1); }
};
// A damped particle in Morse's well: at rest, q = 0, and the numbers that cancel in the force are no products
// of q.
struct DampedMorse : Hanging {
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    const T away = T(1) - exp(-q[0]);
    return away * away / 2;
  }
  [[nodiscard]] Real damping() const { return Real(1); }
};
// The same well beside friction that does not exceed a bound, as a field.
struct MorseWithFriction {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    const T e = exp(-z[0]), fast = exp(T(2) * z[1]);
    rate[0] = z[1];
    rate[1] = (e - T(1)) * e - (fast - T(1)) / (fast + T(1));
  }
};
// A damped particle between two wells, whose positions are counted in `unit`: at rest, q = unit or -unit.
struct TwoWells {
  static constexpr int dimension = 2;
  Real unit = 1;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    const T q = z[0] / T(unit);
    rate[0] = T(unit) * z[1];
    rate[1] = q - q * q * q - z[1];
  }
};
// A mass that dry friction slows down: at rest its equation has no solution, since the friction jumps.
struct DryFriction {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = T(1) - select(z[1], T(3), T(-3));
  }
};

// A pair of numbers that relax within a time of 1 / 50000. The iterates of a fixed-point iteration leave the
// range of numbers at once.
struct Stiff {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    for (std::size_t k = 0; k < 2; ++k) rate[k] = (T(1) - exp((z[k] - T(1)) * 50)) * 1000;
  }
};

template <class System>
std::shared_ptr<const Model> model_of(const System& system, const Real& q, const Real& p) {
  SystemDescriptor descriptor{.name = "at-rest", .title = "at rest", .reference = "landau-lifshitz1976"};
  descriptor.coordinates = {{"q", ""}, {"p", ""}};
  descriptor.initial = {q, p};
  return make_model(descriptor, system);
}

// Every kind of implicit iteration for stages.
class ImplicitMethods {
 public:
  ImplicitMethods() {
    for (const char* stages : {"1", "2", "3", "4", "6"})
      methods_.push_back(method_named("gauss", {{"stages", stages}}));
    methods_.push_back(method_named("implicit-midpoint"));
    for (const char* table : {"radau-iia-5.toml", "symplectic-dirk-4.toml"}) {
      tables_.push_back(read_method_table(shipped_tables + table));
      methods_.push_back(tables_.back()->make({}));
    }
  }
  [[nodiscard]] auto begin() const { return methods_.begin(); }
  [[nodiscard]] auto end() const { return methods_.end(); }

 private:
  std::vector<std::unique_ptr<const MethodTable>> tables_;  // which methods refer to
  std::vector<std::shared_ptr<const MethodInstance>> methods_;
};

// The motion reaches its end and comes to where the forces vanish, within what they round there, or for
// motions that are not damped as near as they begin.
template <class T>
void comes_to(const std::shared_ptr<const Model>& model, const std::shared_ptr<const MethodInstance>& method,
              const T& h, double time, const T& place, const T& rounding) {
  SCOPED_TRACE(method->called());
  Integration<T> run = integrate<T>(model, method, h);
  const auto steps = static_cast<std::int64_t>(time / static_cast<double>(h));
  const Outcome outcome = run.steps(steps);
  EXPECT_TRUE(outcome.reached()) << outcome.message();
  EXPECT_LE(abs(T(run.state()[0] - place)), rounding);
}

// Steps in quad come to rest after twice the time, and are a hundred times as long.
template <class T>
void every_method_comes_to_rest(std::vector<T> steps, double time) {
  const T u = unit_roundoff<T>(), g = T(981) / T(100);
  for (const auto& method : ImplicitMethods())
    for (const T& h : steps) {
      comes_to<T>(model_of(DampedHanging(), 0, 0), method, h, time, -g, 64 * u * g);
      comes_to<T>(model_of(DampedMorse(), Real::fraction(1, 2), 0), method, h, time, 0, 64 * u);
      comes_to<T>(model_of(MorseWithFriction(), Real::fraction(1, 2), 0), method, h, time, 0, 64 * u);
      for (const int exponent : {-20, 0, 20}) {
        const Real unit = Real(Quad(std::ldexp(1.0, exponent)));
        comes_to<T>(model_of(TwoWells{unit}, Real::fraction(8, 5) * unit, Real::fraction(3, 10)), method, h,
                    time, T(unit), 64 * u * T(unit));
      }
    }
}
TEST(Rest, EveryImplicitMethodComesToIt) { every_method_comes_to_rest<double>({0.125, 0.4}, 200); }
TEST(Rest, EveryImplicitMethodComesToItInQuad) { every_method_comes_to_rest<Quad>({Quad(2) / Quad(5)}, 240); }

// Without damping the amplitude stays, far below round-off of the place.
TEST(Rest, SmallOscillationsAboutAPlaceFarFromTheOrigin) {
  for (const auto& method : ImplicitMethods())
    for (const double amplitude : {1e-8, 1e-12, 1e-14, 0.0})
      for (const double h : {0.1, 0.4}) {
        const auto model = model_of(Hanging(), Real(Quad(-9.81) + Quad(amplitude)), 0);
        comes_to<double>(model, method, h, 200, -9.81, 2 * amplitude + 64 * 9.81 * unit_roundoff<double>());
      }
}

TEST(Rest, StiffMotionsComeToIt) {
  const auto radau = read_method_table(shipped_tables + "radau-iia-5.toml");
  const auto model = model_of(Stiff(), Real::fraction(1001, 1000), Real::fraction(999, 1000));
  comes_to<double>(model, radau->make({}), 0.125, 2, 1, 0.125 * 50000 * unit_roundoff<double>());
}

// A bounded force between q and p, from whose iterates at long steps each next one may lie anywhere, and x
// and y, which are free: their size must not decide whether q and p have converged.
struct BesideFree {
  static constexpr int dimension = 4;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[2] / sqrt(T(1) + z[2] * z[2]);
    rate[1] = z[3];
    rate[2] = -(z[0] / sqrt(T(1) + z[0] * z[0])) * 1000;
    rate[3] = T(0);
  }
};
TEST(Rest, ALargeNumberBesideDoesNotMakeChaosConverge) {
  SystemDescriptor descriptor{.name = "beside-free", .title = "", .reference = "landau-lifshitz1976"};
  descriptor.coordinates = {{"q", ""}, {"x", ""}, {"p", ""}, {"y", ""}};
  const auto ends = [&](const std::shared_ptr<const MethodInstance>& method, int exponent) {
    descriptor.initial = {Real::fraction(1, 2), Real(Quad(std::ldexp(1.0, exponent))), Real::fraction(1, 10),
                          0};
    Integration<double> run = integrate<double>(make_model(descriptor, BesideFree()), method, 0.7);
    return run.steps(20).status();
  };
  int failing = 0;
  for (const auto& method : ImplicitMethods()) {
    const Status alone = ends(method, 0);
    failing += alone == Status::not_converged ? 1 : 0;
    for (const int exponent : {20, 30, 40})
      EXPECT_EQ(ends(method, exponent), alone) << method->called() << ", 2^" << exponent;
  }
  EXPECT_GE(failing, 3);
}

struct Pendulum {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = -sin(z[0]) * 100;
  }
};
// Such a step is tried once more, and must not become one of the method by which the table starts.
TEST(Rest, MultistepMethodsThatDoNotConvergeAreNoOthers) {
  const auto table = read_method_table(shipped_tables + "milne-simpson.toml");
  const auto model = model_of(Pendulum(), Real::fraction(1, 2), 0);
  Integration<double> fine = integrate<double>(model, table->make({}), 0.125);
  EXPECT_EQ(fine.steps(4).status(), Status::converged);  // the control
  Integration<double> coarse = integrate<double>(model, table->make({}), 0.25);
  EXPECT_EQ(coarse.steps(4).status(), Status::not_converged);
  EXPECT_EQ(coarse.steps_taken(), 1);
}

TEST(Rest, WhatHasNoSolutionDoesNotConverge) {
  for (const auto& method : ImplicitMethods()) {
    Integration<double> run = integrate<double>(model_of(DryFriction(), 0, 1), method, 0.125);
    EXPECT_EQ(run.steps(100).status(), Status::not_converged) << method->called();
    EXPECT_GE(run.state()[1], -1e-13) << method->called();
  }
}

}  // namespace
}  // namespace pfaff
