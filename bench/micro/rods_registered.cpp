// Right-hand sides of rods as every program of Pfaff has them: system and formulation found by name, one
// indirect call.
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/core/system.hpp>

#include "rods.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::micro;

void add_field(const std::string& shape, const std::string& what, const std::string& system,
               const Assignments& parameters, const std::string& formulation) {
  const auto raw = systems().get(system, "system").make(parameters);
  const auto model = formulations().get(formulation, "formulation").apply(raw, {});
  std::vector<double> state;
  for (const Real& x : model->initial()) state.push_back(x.value());
  add_rods(shape, what, "registered", static_cast<double>(raw->source().constraint_names.size()),
           [evaluator = make_evaluator<double>(model, Formula::field), state,
            rate = std::vector<double>(state.size())]() mutable {
             benchmark::DoNotOptimize(state.data());
             evaluator.call(evaluator.context, 0.0, state.data(), rate.data());
             benchmark::ClobberMemory();
           });
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

[[maybe_unused]] const bool added = (add_fields(), true);
}  // namespace
