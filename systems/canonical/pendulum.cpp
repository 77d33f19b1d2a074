// The pendulum as a plug-in.
#include <pfaff/core/system.hpp>
#include <pfaff/systems/canonical/pendulum.hpp>

namespace {
using namespace pfaff;

const System<Pendulum> registered{
    {.name = "pendulum",
     .title = "pendulum, q'' + omega^2 sin q = 0",
     .reference = "hairer-lubich-wanner2006 (I.1.13)",
     .description = "The mathematical pendulum, swinging or revolving, with its exact solution in elliptic "
                    "functions. Take it as the simplest nonlinear problem: orders and structure are verified "
                    "on it. Near the separatrix its motion depends on the initial state exponentially, so "
                    "that errors there say little about a method.",
     .coordinates = {{"q", "rad"}, {"p", "rad/s"}},
     .initial = {1, 0.5_r},
     .invariants = {conserved("energy", "rad^2/s^2")}}};
}  // namespace
