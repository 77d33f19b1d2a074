// Kinetic energies that depend on time: methods that make steps of T and V by turns have their order and
// their symmetry on them too, or refuse. Expected values are Taylor solutions of 45 digits of the equations
// of motion, made with mpmath.
#include <gtest/gtest.h>

#include <cmath>

#include "method_files.hpp"
#include "methods.hpp"

namespace pfaff {
namespace {

using testing::after_steps;
using testing::method_named;
using testing::shipped_tables;
using testing::TemporaryDirectory;

// H = p^2/(2 (1 + t/2)) + q^2/2 + q^4/4, with friction or without.
struct GrowingMass {
  static constexpr int dimension = 2;
  template <class T>
  T kinetic(const T& t, In<T> p) const {
    return p[0] * p[0] / (2 * (1 + t / 2));
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0] * q[0] / 2 + q[0] * q[0] * q[0] * q[0] / 4;
  }
};
struct DampedGrowingMass : GrowingMass {
  [[nodiscard]] static Real damping() { return 0.3_r; }
};
// T is not quadratic, and both energies depend on time.
struct ShakenQuartic {
  static constexpr int dimension = 2;
  template <class T>
  T kinetic(const T& t, In<T> p) const {
    const T square = p[0] * p[0];
    return square / 2 * (1 + t * t / 3) + square * square / 8 * exp(-t);
  }
  template <class T>
  T potential(const T& t, In<T> q) const {
    return cos(q[0]) * t / 2 + q[0] * q[0] / 2;
  }
};
// A mass matrix of two degrees that turns.
struct TurningMasses {
  static constexpr int dimension = 4;
  template <class T>
  T kinetic(const T& t, In<T> p) const {
    return (p[0] * p[0] + (2 + sin(t)) * p[1] * p[1]) / 2 + t * p[0] * p[1] / 4;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0] * q[0] * q[0] * q[0] / 4 + q[1] * q[1] / 2 + q[0] * q[1] * q[1] / 3;
  }
};
// T = p^2/2 + t p^4/4 is quadratic at t = 0 alone.
struct QuadraticAtFirst : GrowingMass {
  template <class T>
  T kinetic(const T& t, In<T> p) const {
    return p[0] * p[0] / 2 + t * p[0] * p[0] * p[0] * p[0] / 4;
  }
};

template <class S>
std::shared_ptr<const Model> model_of(const S& system, std::vector<Real> initial) {
  return make_model({.name = "timed", .title = "", .reference = "", .initial = std::move(initial)}, system);
}
std::shared_ptr<const Model> growing_mass() { return model_of(GrowingMass(), {1, 0.3_r}); }

// A motion and where it is at t = 2.
struct KnownMotion {
  std::shared_ptr<const Model> model;
  std::vector<Quad> end;
};
const std::vector<KnownMotion>& known_motions() {
  static const auto digits = [](std::initializer_list<const char*> numbers) {
    std::vector<Quad> z;
    for (const char* x : numbers) z.push_back(Real::parse(x)->quad());
    return z;
  };
  static const std::vector<KnownMotion> all{
      {growing_mass(),
       digits({"-0.275233063146561574521685039857987", "-1.42286503867135999508668253392635"})},
      {model_of(ShakenQuartic(), {0.7_r, Real::fraction(-2, 5)}),
       digits({"-1.22151364855759561394812403488587", "-0.537238806952064259394810440877354"})},
      {model_of(TurningMasses(), {0.5_r, 0.3_r, 0.2_r, Real::fraction(-1, 2)}),
       digits({"0.510591274606118620539264262465046", "0.102296614885243364738280920506148",
               "-0.278698001335470967972484530916267", "0.530649112894329317655277179557005"})}};
  return all;
}

// The error at t = 2 after so many steps.
double error_after(const MethodInstance& method, const KnownMotion& known, int steps) {
  const auto z = after_steps<Quad>(method, known.model, Quad(2) / Quad(steps), steps);
  Quad worst(0);
  for (std::size_t k = 0; k < z.size(); ++k) worst = std::max(worst, abs(z[k] - known.end[k]));
  return static_cast<double>(worst);
}
// The exponent with which the error falls from `steps` to twice as many steps.
double slope_of(const MethodInstance& method, const KnownMotion& known, int steps) {
  return std::log2(error_after(method, known, steps) / error_after(method, known, 2 * steps));
}
// How far a step of h and one of -h are from the start.
double asymmetry(const MethodInstance& method, const std::shared_ptr<const Model>& model) {
  const std::vector<Quad> start = testing::initial_state<Quad>(*model);
  const Quad h = Quad(1) / Quad(10), t = Quad(1) / Quad(3);
  auto z = after_steps<Quad>(method, model, h, 1, start, t);
  z = after_steps<Quad>(method, model, -h, 1, z, t + h);
  Quad worst(0);
  for (std::size_t k = 0; k < z.size(); ++k) worst = std::max(worst, abs(z[k] - start[k]));
  return static_cast<double>(worst);
}

struct Named {
  const char* name;
  Assignments parameters;
  int order, steps;
};
const std::vector<Named> splittings{{"verlet", {}, 2, 64},
                                    {"symplectic-euler", {}, 1, 256},
                                    {"yoshida-verlet", {{"order", "4"}}, 4, 64},
                                    {"yoshida-verlet", {{"order", "6"}}, 6, 64},
                                    {"suzuki-verlet", {{"order", "4"}}, 4, 32},
                                    {"kahan-li-verlet", {{"order", "8"}}, 8, 32}};

// Slopes of errors at 64 steps and more are within .3 of the order: what follows the leading term is an h or
// h^2 smaller, and the coefficients of these motions are of order one.
TEST(TimedKineticEnergy, SplittingsHaveTheirOrder) {
  for (const KnownMotion& known : known_motions())
    for (const Named& m : splittings) {
      const auto method = method_named(m.name, m.parameters);
      EXPECT_NEAR(slope_of(*method, known, m.steps), m.order, 0.3) << method->called();
      if (m.order == 1) continue;
      EXPECT_LT(asymmetry(*method, known.model), 1e-30) << method->called();
    }
}

TEST(TimedKineticEnergy, HasTheRightEnd) {
  // Order 8 with 128 steps of 1/64 leaves 1e-12 and less.
  const KnownMotion& known = known_motions().front();
  const auto method = method_named("kahan-li-verlet", {{"order", "8"}});
  const auto z = after_steps<double>(*method, known.model, 1.0 / 64, 128);
  EXPECT_NEAR(z[0], -0.27523306314656157, 1e-12);
  EXPECT_NEAR(z[1], -1.42286503867136, 1e-12);
}

// Control: a drift-kick-drift whose drifts take the time at which they begin, as it was before, has order 1.
TEST(TimedKineticEnergy, OneTimeForBothPartsHasOrderOne) {
  const TemporaryDirectory files;
  const auto map = [&](const char* second) {
    std::ofstream(files / "map.toml") << "name = \"drifting\"\nkind = \"map\"\norder = 1\nstep = [\n"
                                         "\"q = q + h/2*velocity(t, p)\",\n"
                                         "\"p = p + h*force(t + h/2, q)\",\n"
                                         "\"q = q + h/2*velocity(t + "
                                      << second << ", p)\"]\n";
    return read_method_table(files / "map.toml")->make({});
  };
  const KnownMotion& known = known_motions().front();
  EXPECT_NEAR(slope_of(*map("h/2"), known, 64), 1, 0.1);
  EXPECT_NEAR(slope_of(*map("h"), known, 64), 2, 0.1);
}

TEST(TimedKineticEnergy, TablesHaveTheirOrderOrRefuse) {
  const KnownMotion& known = known_motions().front();
  struct Table {
    const char* file;
    double order;
    int steps;
  };
  for (const Table& table : {Table{"blanes-moan-s6.toml", 4, 64},
                             {"blanes-moan-s10.toml", 6, 32},
                             {"forest-ruth.toml", 4, 64},
                             {"pefrl.toml", 4, 64},
                             {"ruth-3.toml", 3, 128},
                             {"suzuki-4-verlet.toml", 4, 32},
                             {"verlet-as-processed-euler.toml", 2, 64},
                             {"blanes-casas-murua-processed-6.toml", 6, 32},
                             {"verlet-map.toml", 2, 64}}) {
    const auto read = read_method_table(shipped_tables + table.file);  // which its methods refer to
    const auto method = read->make({});
    EXPECT_EQ(method->refuses(*known.model), "");
    EXPECT_NEAR(slope_of(*method, known, table.steps), table.order, 0.35) << table.file;
  }
  // Fewer conditions are asked of these, or accelerations are stepped.
  const auto steady = model_of(testing::Relativistic{true}, {1, 0});
  const auto at_first = model_of(QuadraticAtFirst(), {1, 0.3_r});
  for (const char* file : {"blanes-moan-srkn6.toml", "blanes-moan-srkn11.toml", "mclachlan-atela-4.toml",
                           "quinlan-tremaine-8.toml", "hairer-lubich-wanner-8.toml"}) {
    const auto read = read_method_table(shipped_tables + file);
    const auto method = read->make({});
    EXPECT_NE(method->refuses(*known.model).find("time"), std::string::npos) << file;
    EXPECT_NE(method->refuses(*at_first).find("quadratic"), std::string::npos) << file;
    EXPECT_EQ(method->refuses(*steady), "") << file;
  }
  EXPECT_NE(method_named("odeint-mclachlan")->refuses(*known.model), "");
}

// Friction beside it: the same motion with p' = ... - .3 p.
TEST(TimedKineticEnergy, ConformalSplittingHasItsOrder) {
  const KnownMotion known{model_of(DampedGrowingMass(), {1, 0.3_r}),
                          {Real::parse("-0.0835885767076678784730675766722058")->quad(),
                           Real::parse("-1.0431399520164671621740169802707")->quad()}};
  EXPECT_NEAR(slope_of(*method_named("conformal-splitting"), known, 64), 2, 0.1);
  EXPECT_NEAR(
      slope_of(*method_named("composition", {{"base", "conformal-splitting"}, {"order", "4"}}), known, 64), 4,
      0.3);
}

// Methods that were right before: collocation, whose form of second order is for steady masses alone.
TEST(TimedKineticEnergy, CollocationHasItsOrder) {
  for (const KnownMotion& known : known_motions()) {
    EXPECT_NEAR(slope_of(*method_named("gauss", {{"stages", "2"}}), known, 32), 4, 0.3);
    EXPECT_LT(error_after(*method_named("gauss", {{"stages", "8"}}), known, 64), 1e-22);
  }
}

}  // namespace
}  // namespace pfaff
