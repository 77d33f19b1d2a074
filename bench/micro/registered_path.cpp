// The methods as the programs of Pfaff run them: found by name, with one indirect call for each formula.
#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/system.hpp>

#include "cases.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::micro;

using SharedModel = std::shared_ptr<const Model>;

template <class S>
void add_registered(const std::string& name, const std::string& path, const SharedModel& model,
                    const std::string& integrator, const Assignments& parameters = {}) {
  const auto method = integrators().get(integrator, "integrator").make(parameters);
  add<S>(name, path,
         [stepper = std::shared_ptr<Stepper<double>>(method->stepper(model, 0.0))](auto& z, double h) {
           std::int64_t completed = 0;
           stepper->advance(0, 0, h, chunk, z, completed);
         });
}

// The same with derivatives in four directions, by which tangent maps and Jacobians of steps are found.
template <class S>
void add_tangent(const std::string& name, const SharedModel& model, const std::string& integrator,
                 const Assignments& parameters = {}) {
  using D = StepDual<double>;
  const auto method = integrators().get(integrator, "integrator").make(parameters);
  add<S>(name, "tangent",
         [stepper = std::shared_ptr<Stepper<D>>(method->stepper(model, D()))](auto& z, double h) {
           std::array<D, std::tuple_size_v<std::decay_t<decltype(z)>>> moved;
           for (std::size_t k = 0; k < z.size(); ++k) moved[k] = D::variable(z[k], static_cast<int>(k));
           std::int64_t completed = 0;
           stepper->advance(D(0), 0, D(h), chunk, moved, completed);
           for (std::size_t k = 0; k < z.size(); ++k) z[k] = moved[k].value;
         });
}

template <class S>
void add_methods() {
  const SharedModel model = systems().get(Case<S>::name, "system").make({});
  const SharedModel energies =
      make_model({.name = "energies-only", .title = {}, .reference = {}}, EnergiesOnly<S>());
  const Assignments plain{{"compensated", "no"}};
  add_registered<S>("verlet", "registered", model, "verlet");
  add_registered<S>("verlet-plain", "registered", model, "verlet", plain);
  add_registered<S>("verlet", "registered-derived", energies, "verlet");
  add_registered<S>("verlet-plain", "registered-derived", energies, "verlet", plain);
  add_registered<S>("rk4", "registered", model, "rk4");
  add_registered<S>("rk4-plain", "registered", model, "rk4", plain);
  add_registered<S>("implicit-midpoint", "registered", model, "implicit-midpoint");
  add_registered<S>("gauss-4", "registered", model, "gauss", {{"stages", "2"}});
  add_registered<S>("gauss-8", "registered", model, "gauss", {{"stages", "4"}});
  add_registered<S>("generating-function-4", "registered", model, "generating-function",
                    {{"order", "4"}, {"extra", "0"}});
  add_registered<S>("generating-function-8", "registered", model, "generating-function",
                    {{"order", "8"}, {"extra", "0"}});
  add_tangent<S>("verlet", model, "verlet");
  add_tangent<S>("rk4", model, "rk4");
  add_tangent<S>("gauss-4", model, "gauss", {{"stages", "2"}});
  add_tangent<S>("generating-function-4", model, "generating-function", {{"order", "4"}, {"extra", "0"}});
}

// Generating functions beside Gauss collocation of the same order in the chart, on systems where their
// structure matters.
template <class S>
void add_generating_functions() {
  const SharedModel model = systems().get(Case<S>::name, "system").make({});
  for (const int order : {4, 8, 12}) {
    const std::string m = std::to_string(order);
    add_registered<S>("gauss-" + m, "registered", model, model->canonical() ? "gauss" : "gauss-darboux",
                      {{"stages", std::to_string(order / 2)}});
    add_registered<S>("generating-function-" + m, "registered", model, "generating-function",
                      {{"order", m}, {"extra", "0"}});
  }
}

// A chain of N bodies, to show how the cost grows with its length.
template <int N>
void add_chain() {
  const SharedModel model =
      systems().get("coupled-damped-pendula", "system").make({{"count", std::to_string(N)}});
  add_registered<DampedChain<N>>("generating-function-8", "registered", model, "generating-function",
                                 {{"order", "8"}, {"extra", "0"}});
}

[[maybe_unused]] const bool added =
    (add_methods<HarmonicOscillator>(), add_methods<Pendulum>(), add_methods<Kepler>(),
     add_generating_functions<HenonHeiles>(), add_generating_functions<DampedPendulum>(),
     add_generating_functions<LotkaVolterra>(), add_chain<8>(), add_chain<16>(), add_chain<32>(),
     add_chain<64>(), add_chain<128>(), true);
}  // namespace
