// The splitting methods as plug-ins.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/order_conditions/word_conditions.hpp>
#include <pfaff/integrators/splitting/splitting.hpp>

namespace {
using namespace pfaff;

struct Verlet : pfaff::Verlet {
  using Composed = Composition<pfaff::Verlet>;
};

const Method<Verlet> verlet{
    {.name = "verlet",
     .title = "Stoermer-Verlet, position form",
     .family = "splitting",
     .reference = "hairer-lubich-wanner2006 (I.1.17)",
     .description =
         "The Stoermer-Verlet method, drift, kick, drift: explicit, symplectic, symmetric and of order 2 for "
         "separable energies. Take it first for mechanical systems, and for long runs with many bodies, "
         "where one force a step decides the cost. It is unstable for steps beyond h omega = 2 of the "
         "fastest oscillation, and at high accuracy higher orders are cheaper.",
     .order = 2,
     .preserves = {Claim::symplectic, Claim::symmetric, Claim::reversible}}};
const Method<SymplecticEuler> symplectic_euler{
    {.name = "symplectic-euler",
     .title = "symplectic Euler: kick, then drift",
     .family = "splitting",
     .reference = "hairer-lubich-wanner2006 (I.1.9)",
     .description = "A kick and then a drift: explicit, symplectic and of order 1 for separable energies. "
                    "Take it to study what structure alone gives, as it is the smallest symplectic method. "
                    "It is conjugate to Stoermer-Verlet, which costs the same and is of order 2.",
     .order = 1,
     .preserves = {Claim::symplectic}}};

template <Part First, std::size_t N>
OrderTheory theory_of(const Splitting<First, N>& method, int order) {
  OrderTheory theory{"words",
                     order,
                     {method.coefficient.begin(), method.coefficient.end()},
                     [order](const std::vector<Quad>& lengths) {
                       std::vector<PartialFlow> flows;
                       for (std::size_t k = 0; k < lengths.size(); ++k)
                         flows.push_back({(k + (First == Part::kick ? 1 : 0)) % 2, lengths[k]});
                       return splitting_conditions(flows, order);
                     }};
  for (std::size_t k = 0; k < N; ++k) theory.sums.push_back(static_cast<int>(k % 2));
  return theory;
}
const KnownOrderTheory verlet_conditions{
    "verlet", [](const Assignments& /*parameters*/) { return theory_of(pfaff::Verlet(), 2); }};
const KnownOrderTheory euler_conditions{"symplectic-euler", [](const Assignments& /*parameters*/) {
                                          return theory_of(pfaff::SymplecticEuler(), 1);
                                        }};
}  // namespace
