// Concrete method types on concrete system types: how fast the formulas run when the compiler sees
// everything.
#include <memory>

#include <pfaff/core/facets/advance.hpp>
#include <pfaff/core/facets/static_problem.hpp>
#include <pfaff/integrators/generating/generating_function.hpp>
#include <pfaff/integrators/runge_kutta/explicit_runge_kutta.hpp>
#include <pfaff/integrators/runge_kutta/gauss.hpp>
#include <pfaff/integrators/splitting/splitting.hpp>

#include "cases.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::micro;

// The system S gives the formulas, the case C the name and the start.
template <class C, class S, class M>
void add_static(const std::string& name, const std::string& path, const M& method) {
  using P = StaticProblem<S>;
  const P problem;
  add<C>(name, path, [=, work = std::make_shared<Work<M, P>>(method, problem)](auto& start, double h) {
    State<P> z;
    std::copy(start.begin(), start.end(), z.begin());
    std::int64_t completed = 0;
    advance(method, problem, 0.0, 0, h, chunk, z, *work, completed);
    std::copy(z.begin(), z.end(), start.begin());
  });
}

GeneratingFunction generating_function(int order) {
  GeneratingFunction method;
  method.truncation = order;
  method.extra = "0";
  method.validate();
  return method;
}

template <class S>
void add_methods() {
  Verlet plain;
  plain.compensated = false;
  add_static<S, S>("verlet", "static", Verlet());
  add_static<S, S>("verlet-plain", "static", plain);
  add_static<S, EnergiesOnly<S>>("verlet", "static-derived", Verlet());
  add_static<S, EnergiesOnly<S>>("verlet-plain", "static-derived", plain);
  RungeKutta4 plain_rk4;
  plain_rk4.compensated = false;
  add_static<S, S>("rk4", "static", RungeKutta4());
  add_static<S, S>("rk4-plain", "static", plain_rk4);
  add_static<S, S>("implicit-midpoint", "static", ImplicitMidpoint());
  add_static<S, S>("gauss-4", "static", Collocation<2>());
  add_static<S, S>("gauss-8", "static", Collocation<4>());
  add_static<S, S>("generating-function-4", "static", generating_function(4));
  add_static<S, S>("generating-function-8", "static", generating_function(8));
}

[[maybe_unused]] const bool added =
    (add_methods<HarmonicOscillator>(), add_methods<Pendulum>(), add_methods<Kepler>(), true);
}  // namespace
