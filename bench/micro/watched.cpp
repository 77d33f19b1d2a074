// Steps by an Integration: a chunk of them in a row that nobody watches, and one whose invariants are watched
// at every step.
#include <pfaff/runs/integrate.hpp>
#include <pfaff/runs/invariant_errors.hpp>

#include "cases.hpp"
#include "rods.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::micro;

struct Watched {
  Watched(Integration<double> made, bool watch) : run(std::move(made)) {
    if (watch) run.watch(errors);
  }
  Watched(const char* system, const char* method, const Assignments& parameters, bool watch)
      : Watched(integrate(system, {}, method, parameters, {.step = "0.01"}), watch) {}
  Integration<double> run;
  InvariantErrors<double> errors;
};

// An integration goes on from chunk to chunk, as runs do. What is damped begins anew in every chunk, before
// it dies away, as the registered step does.
template <class S>
void add_integration(const std::string& name, const char* method, const Assignments& parameters = {},
                     bool anew = false) {
  for (const bool watch : {false, true}) {
    const auto watched = std::make_shared<Watched>(Case<S>::name, method, parameters, watch);
    const std::vector<double> start(watched->run.state().begin(), watched->run.state().end());
    add<S>(name, watch ? "watched" : "integration", [=](auto& z, double) {
      if (anew) watched->run.go_on_from(start, 0, watched->run.step());
      watched->run.steps(chunk).expect_reached();
      z[0] = watched->run.state()[0];
    });
  }
}

// The chain and the steps of chain-2d-16/rattle/registered (rods_registered.cpp), which starts over as often.
void add_rattle() {
  constexpr int steps = 100, count = 16;
  for (const bool watch : {false, true}) {
    const auto fresh = std::make_shared<Integration<double>>(
        integrate("n-pendulum", {{"bobs", std::to_string(count)}}, "rattle", {}, {.step = "1e-3"}));
    const std::vector<double> start(fresh->state().begin(), fresh->state().end());
    add_rods("chain-2d-16", "rattle", watch ? "watched" : "integration", steps * count,
             [=, run = std::shared_ptr<Watched>()]() mutable {
               if (run == nullptr || run->run.steps_taken() >= 5000)
                 run = std::make_shared<Watched>(fresh->at(0, start), watch);
               run->run.steps(steps).expect_reached();
             });
  }
}

[[maybe_unused]] const bool added =
    (add_integration<HarmonicOscillator>("verlet", "verlet"), add_integration<Kepler>("verlet", "verlet"),
     add_integration<Kepler>("gauss-4", "gauss", {{"stages", "2"}}),
     add_integration<Kepler>("gauss-8", "gauss", {{"stages", "4"}}),
     add_integration<DampedPendulum>("generating-function-8", "generating-function",
                                     {{"order", "8"}, {"extra", "0"}}, true),
     add_rattle(), true);
}  // namespace
