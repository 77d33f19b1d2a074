// The pendulum as a plug-in.
#include <pfaff/core/system.hpp>
#include <pfaff/systems/pendulum.hpp>

namespace {
using namespace pfaff;

struct Pendulum : pfaff::Pendulum {};

const System<Pendulum> registered{{.name = "pendulum",
                                   .title = "pendulum, q'' + omega^2 sin q = 0",
                                   .reference = "hairer-lubich-wanner2006 (I.1.13)",
                                   .coordinates = {{"q", "rad"}, {"p", "rad/s"}},
                                   .initial = {1, 0.5_r},
                                   .invariants = {conserved("energy", "rad^2/s^2")}}};
}  // namespace
