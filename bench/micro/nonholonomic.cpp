// Steps of the methods for velocity constraints on the registered path, beside Runge-Kutta steps of the
// formulation `nonholonomic`, whose field makes the same projections.
#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/core/system.hpp>

#include "cases.hpp"
#include "rods.hpp"

namespace pfaff::micro {

inline std::shared_ptr<const Model> velocity_constrained(const char* name) {
  return systems().get(name, "system").make({});
}
template <std::size_t Size>
std::array<double, Size> initial_state(const char* name) {
  const auto model = velocity_constrained(name);
  std::array<double, Size> z{};
  for (std::size_t k = 0; k < Size; ++k) z[k] = model->initial().at(k).value();
  return z;
}

struct Sleigh {};
template <>
struct Case<Sleigh> {
  static constexpr const char* name = "sleigh";
  inline static const auto start = initial_state<6>(name);
};
struct ContactOscillator {};
template <>
struct Case<ContactOscillator> {
  static constexpr const char* name = "contact-oscillator";
  inline static const auto start = initial_state<6>(name);
};
struct QuarticNonholonomic {};  // with n = 3
template <>
struct Case<QuarticNonholonomic> {
  static constexpr const char* name = "quartic-nonholonomic";
  inline static const auto start = initial_state<14>(name);
};

}  // namespace pfaff::micro

namespace {
using namespace pfaff;
using namespace pfaff::micro;

template <class S>
void add_methods() {
  const auto constrained = velocity_constrained(Case<S>::name);
  const auto motion = formulations().get("nonholonomic", "formulation").apply(constrained, {});
  for (const char* name :
       {"rk4", "odeint-dopri5", "dla", "gni", "nonholonomic-leap-frog", "mclachlan-perlmutter",
        "nonholonomic-discrete-gradient", "velocity-projected-rk4"}) {
    const auto method = integrators().get(name, "integrator").make({});
    const auto& model = method->refuses(*constrained).empty() ? constrained : motion;
    add<S>(name, "registered",
           [stepper = std::shared_ptr<Stepper<double>>(method->stepper(model, 0.0))](auto& z, double h) {
             std::int64_t completed = 0;
             stepper->advance(0, 0, h, chunk, z, completed);
           });
  }
}

// Right-hand sides of a chain of rods with a skate; times are divided by the number of constraints.
void add_chains() {
  for (const int count : chain_sizes) {
    const auto chain = systems().get("skate-chain", "system").make({{"beads", std::to_string(count)}});
    const auto motion = formulations().get("nonholonomic", "formulation").apply(chain, {});
    std::vector<double> state;
    for (const Real& x : motion->initial()) state.push_back(x.value());
    add_rods("skate-chain-" + std::to_string(count), "nonholonomic", "registered", count + 1.0,
             [evaluator = make_evaluator<double>(motion, Formula::field), state,
              rate = std::vector<double>(state.size())]() mutable {
               benchmark::DoNotOptimize(state.data());
               evaluator.call(evaluator.context, 0.0, state.data(), rate.data());
               benchmark::ClobberMemory();
             });
  }
}

[[maybe_unused]] const bool added = (add_methods<Sleigh>(), add_methods<ContactOscillator>(),
                                     add_methods<QuarticNonholonomic>(), add_chains(), true);
}  // namespace
