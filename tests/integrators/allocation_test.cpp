// Steps allocate no memory: every registered method, with all parameters that its claims are verified with,
// on every system that fits, in double and quad.
#include <gtest/gtest.h>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/integrators/tables/method_table.hpp>
#include <pfaff/runs/motion.hpp>
#include <pfaff/systems/text/text_system.hpp>

#include <pfaff/tests/integrators/nonholonomic_samples.hpp>

#include "../counted_allocations.hpp"

namespace pfaff {
namespace {
using testing::allocations_of;

// Allocations of `steps` steps of size h after a first one, from the model's initial state; -1 where that
// does not converge.
template <class T>
long allocations_of_steps(Stepper<T>& stepper, const Model& model, const T& h, std::int64_t steps) {
  std::vector<T> z;
  for (const Real& x : model.initial()) z.push_back(T(x));
  std::int64_t completed = 0;
  if (stepper.advance(T(0), 0, h, 1, z, completed) != Status::converged) return -1;
  return allocations_of([&] {
    for (std::int64_t k = 1; k <= steps; ++k) stepper.advance(T(0), k, h, 1, z, completed);
  });
}

template <class T>
void no_method_allocates() {
  int tried = 0, stuck = 0;
  for (const MethodPlugin* plugin : integrators().all())
    for (const Assignments& parameters : plugin->instances(false)) {
      const auto method = plugin->make(parameters);
      for (const SystemPlugin* system : systems().all()) {
        const auto model = motion_for(*method, system->make({}));
        if (!method->refuses(*model).empty()) continue;
        const auto stepper = method->stepper(model, T(0));
        const long allocations = allocations_of_steps(*stepper, *model, T(Real::fraction(1, 100)), 4);
        EXPECT_LE(allocations, 0) << plugin->name() << " " << (parameters.empty() ? "" : parameters[0].second)
                                  << " on " << model->name();
        ++(allocations < 0 ? stuck : tried);
      }
    }
  EXPECT_GT(tried, 50);
  // Generating functions of the form `normal` add positions to momenta, which are smaller by 1e11 on the
  // outer solar system; they step there at no step size.
  EXPECT_LE(stuck, 4);
}

TEST(Allocation, NoStepAllocatesInDouble) { no_method_allocates<double>(); }
TEST(Allocation, NoStepAllocatesInQuad) { no_method_allocates<Quad>(); }

template <class T>
void no_method_allocates_on_velocity_constraints() {
  for (const auto& model : nonholonomic::golden_models())
    for (const char* name :
         {"dla", "gni", "nonholonomic-leap-frog", "mclachlan-perlmutter", "nonholonomic-discrete-gradient",
          "composition", "velocity-projected-rk4", "velocity-projected-gauss", "nonholonomic-lobatto"}) {
      const auto method = std::string(name) == "composition" ? nonholonomic::composed("dla", "kahan-li", "6")
                                                             : nonholonomic::method_named(name);
      const auto motion = motion_for(*method, model);
      if (!method->refuses(*motion).empty()) continue;
      const auto stepper = method->stepper(motion, T(0));
      EXPECT_EQ(allocations_of_steps(*stepper, *motion, T(Real::fraction(1, 100)), 4), 0)
          << name << " on " << model->name();
    }
}
TEST(Allocation, NoStepAllocatesOnVelocityConstraints) {
  no_method_allocates_on_velocity_constraints<double>();
  no_method_allocates_on_velocity_constraints<Quad>();
}

TEST(Allocation, NeitherDoMapsWrittenAsText) {
  for (const auto& [name, system] : {std::pair("verlet-map", "henon-heiles"), std::pair("heun-3", "kepler"),
                                     std::pair("damped-pendulum-map", "damped-pendulum")}) {
    const auto map =
        read_method_table(std::string(PFAFF_GOLDEN) + "/../../examples/tables/" + name + ".toml");
    const auto model = systems().get(system, "system").make({});
    const auto stepper = map->make({})->stepper(model, 0.0);
    EXPECT_EQ(allocations_of_steps(*stepper, *model, 0.01, 9), 0) << name;
  }
}

TEST(Allocation, NeitherDoesNewtonsIteration) {
  // omega h = 10: fixed-point iteration diverges.
  const auto model = systems().get("harmonic-oscillator", "system").make({{"omega", "100"}});
  for (const char* name : {"implicit-midpoint", "gauss"}) {
    const auto stepper = integrators().get(name, "integrator").make({})->stepper(model, 0.0);
    EXPECT_EQ(allocations_of_steps(*stepper, *model, 0.1, 4), 0) << name;
    EXPECT_EQ(stepper->counters().factorisations, 5) << name;
  }
}

// Stages are evaluated side by side where formulas are compiled for packs. Where they are not, neither:
struct Unpacked {
  static constexpr int dimension = 2;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0] * q[0] / 2;
  }
  template <class T>
  void force(const T& /*t*/, In<T> q, Out<T> f) const
      requires(!std::is_same_v<T, Pack<4>> && !std::is_same_v<T, Pack<8>>) {
    f[0] = -q[0];
  }
};
TEST(Allocation, NeitherDoStagesOneAfterTheOther) {
  const auto model =
      make_model({.name = "unpacked", .title = "", .reference = "", .initial = {1, 0}}, Unpacked{});
  for (const char* name : {"gauss", "gauss-darboux"})
    for (const char* stages : {"2", "5", "8"}) {
      const auto stepper =
          integrators().get(name, "integrator").make({{"stages", stages}})->stepper(model, 0.0);
      EXPECT_EQ(allocations_of_steps(*stepper, *model, 0.1, 4), 0) << name << ' ' << stages;
    }
}

// A lattice of n particles has n forces of three particles each: setting up and stepping take memory, and
// with it time, in proportion to n where no matrix is made. A matrix that is made in vain takes n^2.
TEST(Allocation, OfCollocationIsLinearInTheSizeOfALattice) {
  const auto bytes_for = [](const char* method, const std::string& system, const char* size) {
    return static_cast<double>(testing::bytes_of([&] {
      const auto model = system_named(system).make({{"n", size}});
      const auto stepper = integrators().get(method, "integrator").make({})->stepper(model, 0.0);
      std::vector<double> z;
      for (const Real& x : model->initial()) z.push_back(double(x));
      std::int64_t completed = 0;
      EXPECT_EQ(stepper->advance(0.0, 0, 0.1, 4, z, completed), Status::converged) << method;
    }));
  };
  for (const std::string& system : {std::string("fermi-pasta-ulam-tsingou"),
                                    std::string(PFAFF_GOLDEN) + "/../../examples/models/lattice.toml"})
    for (const char* method : {"verlet", "gauss", "implicit-midpoint"})
      EXPECT_LE(bytes_for(method, system, "800"), 2.5 * bytes_for(method, system, "400"))
          << method << " on " << system;
}

// What the counter must see: a method that makes a vector in each step.
struct Careless {
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, NoWork& /*work*/) const {
    std::vector<Scalar<P>> rate(z.size());
    p.field(t, z, rate);
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = z[k] + h * rate[k];
    return Status::converged;
  }
};

TEST(Allocation, OfACarelessMethodIsSeen) {
  const Problem<double> problem(systems().get("kepler", "system").make({}));
  problem.prepare(Formula::field);
  auto z = problem.make_state();
  z[0] = 1;
  NoWork work(Careless(), problem);
  std::int64_t completed = 0;
  const long seen =
      allocations_of([&] { advance(Careless(), problem, 0.0, 0, 0.01, 10, z, work, completed); });
  EXPECT_EQ(completed, 10);
  EXPECT_EQ(seen, 10);
}

TEST(Allocation, InsideTheLibraryIsSeen) {
  const auto model = systems().get("kepler", "system").make({});
  const auto method = integrators().get("gauss", "integrator").make({});
  EXPECT_GT(allocations_of([&] { (void)method->stepper(model, 0.0); }), 1);
}

TEST(Allocation, OfOverAlignedNumbersIsSeen) {
  EXPECT_EQ(allocations_of([] { std::vector<StepDual<double>> numbers(3); }), 1);
}

}  // namespace
}  // namespace pfaff
