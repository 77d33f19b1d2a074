// Steps by an Integration: a chunk of them in a row that nobody watches, and one whose invariants are watched
// at every step.
#include <pfaff/runs/integrate.hpp>
#include <pfaff/runs/invariant_errors.hpp>

#include "cases.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::micro;

struct Watched {
  Watched(const char* system, const char* method, const Assignments& parameters, bool watch)
      : run(integrate(system, {}, method, parameters, {.step = "0.01"})) {
    if (watch) run.watch(errors);
  }
  Integration<double> run;
  InvariantErrors<double> errors;
};

// An integration goes on from chunk to chunk, as runs do: making one costs as much as 50 steps of Verlet.
// What is damped begins anew in every chunk, before it dies away.
template <class S>
void add_integration(const std::string& name, const char* method, const Assignments& parameters = {},
                     bool anew = false) {
  for (const bool watch : {false, true}) {
    const auto make = [=] { return std::make_shared<Watched>(Case<S>::name, method, parameters, watch); };
    add<S>(name, watch ? "watched" : "integration", [=, watched = make()](auto& z, double) mutable {
      if (anew) watched = make();
      watched->run.steps(chunk).expect_reached();
      z[0] = watched->run.state()[0];
    });
  }
}

[[maybe_unused]] const bool added =
    (add_integration<HarmonicOscillator>("verlet", "verlet"), add_integration<Kepler>("verlet", "verlet"),
     add_integration<Kepler>("gauss-4", "gauss", {{"stages", "2"}}),
     add_integration<Kepler>("gauss-8", "gauss", {{"stages", "4"}}),
     add_integration<DampedPendulum>("generating-function-8", "generating-function",
                                     {{"order", "8"}, {"extra", "0"}}, true),
     true);
}  // namespace
