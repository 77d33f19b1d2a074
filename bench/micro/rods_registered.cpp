// Right-hand sides of rods as the programs of Pfaff compute them, with system and formulation found by name
// and one indirect call, for small ones also compiled as by --compile, and steps of RATTLE.
#include <cstdint>
#include <memory>
#include <stdexcept>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/core/native/compiled_model.hpp>
#include <pfaff/core/system.hpp>

#include "rods.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::micro;

void add_evaluations(const std::string& shape, const std::string& what, const std::string& path,
                     const std::shared_ptr<const Model>& model) {
  std::vector<double> state;
  for (const Real& x : model->initial()) state.push_back(x.value());
  add_rods(shape, what, path, static_cast<double>(model->source().constraint_names.size()),
           [evaluator = make_evaluator<double>(model, Formula::field), state,
            rate = std::vector<double>(state.size())]() mutable {
             benchmark::DoNotOptimize(state.data());
             evaluator.call(evaluator.context, 0.0, state.data(), rate.data());
             benchmark::ClobberMemory();
           });
}

void add_field(const std::string& shape, const std::string& what, const std::string& system,
               const Assignments& parameters, const std::string& formulation) {
  const auto model = formulations()
                         .get(formulation, "formulation")
                         .apply(systems().get(system, "system").make(parameters), {});
  add_evaluations(shape, what, "registered", model);
  constexpr std::size_t most = 16;  // rods
  if (model->source().constraint_names.size() <= most)
    add_evaluations(shape, what, "compiled", compiled(model));
}

// A hundred steps of h = 1e-3 s in each call. The runs start from a horizontal pendulum whose rods turn at
// random.
void add_rattle(const std::string& shape, int count, const std::string& dimension) {
  constexpr int steps = 100;
  const auto model =
      systems().get("n-pendulum", "system").make({{"bobs", std::to_string(count)}, {"dimension", dimension}});
  const std::shared_ptr<const MethodInstance> method = integrators().get("rattle", "integrator").make({});
  std::vector<double> start;
  for (const Real& x : model->initial()) start.push_back(x.value());
  const std::shared_ptr<Stepper<double>> stepper = method->stepper(model, double());
  add_rods(shape, "rattle", "registered", static_cast<double>(steps * count),
           [method, stepper, start, state = start, done = std::int64_t{0}]() mutable {
             if (done == 5000) {  // start over after five seconds, since the chain moves faster later
               state = start;
               done = 0;
               stepper->forget();
             }
             std::int64_t completed = 0;
             if (stepper->advance(0.0, done, 1e-3, steps, state, completed) != Status::converged)
               throw std::runtime_error("a step of RATTLE failed");
             done += steps;
           });
}

void add_steps() {
  for (const int axes : {2, 3}) {
    const std::string dimension = std::to_string(axes);
    for (const int count : chain_sizes)
      add_rattle("chain-" + dimension + "d-" + std::to_string(count), count, dimension);
  }
}

void add_fields() {
  for (const char* formulation : {"dirac", "lmm"}) {
    for (const int axes : {2, 3}) {
      const std::string dimension = std::to_string(axes);
      for (const int count : chain_sizes) {
        const std::string n = std::to_string(count);
        add_field("chain-" + dimension + "d-" + n, formulation, "n-pendulum",
                  {{"bobs", n}, {"dimension", dimension}}, formulation);
        add_field("ring-" + dimension + "d-" + n, formulation, "ring",
                  {{"beads", n}, {"dimension", dimension}}, formulation);
      }
    }
    add_field("humanoid", formulation, "humanoid", {{"friction", "0"}}, formulation);
  }
}

[[maybe_unused]] const bool added = (add_fields(), add_steps(), true);
}  // namespace
