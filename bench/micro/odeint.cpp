// Boost.Odeint's steppers on the same formulas, with concrete systems in std::array, for comparison with a
// widely used library.
#include <algorithm>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/symplectic_euler.hpp>
#include <boost/numeric/odeint/stepper/symplectic_rkn_sb3a_mclachlan.hpp>
#include <boost/numeric/odeint/stepper/velocity_verlet.hpp>

#include <pfaff/core/facets/static_problem.hpp>

#include "cases.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::micro;
namespace odeint = boost::numeric::odeint;

template <class S>
using Whole = std::array<double, static_cast<std::size_t>(S::dimension)>;
template <class S>
using Half = std::array<double, static_cast<std::size_t>(S::dimension / 2)>;

// A stepper of the vector field.
template <class S, class Stepper>
void add_field_stepper(const std::string& name) {
  const StaticProblem<S> problem;
  add<S>(name, "odeint", [problem](auto& z, double h) {
    Stepper stepper;
    const auto system = [&](const Whole<S>& x, Whole<S>& rate, double t) { problem.field(t, x, rate); };
    for (std::int64_t k = 0; k < chunk; ++k) stepper.do_step(system, z, static_cast<double>(k) * h, h);
  });
}

// A stepper of (q, p) pairs.
template <class S, class Stepper, class System>
void add_pair_stepper(const std::string& name, System system) {
  add<S>(name, "odeint", [system](auto& z, double h) {
    Stepper stepper;
    std::pair<Half<S>, Half<S>> x;
    constexpr auto half = static_cast<std::ptrdiff_t>(S::dimension / 2);
    std::copy(z.begin(), z.begin() + half, x.first.begin());
    std::copy(z.begin() + half, z.end(), x.second.begin());
    if constexpr (requires { stepper.initialize(system, x.first, x.second, 0.0); })
      stepper.initialize(system, x.first, x.second, 0.0);
    for (std::int64_t k = 0; k < chunk; ++k) stepper.do_step(system, x, static_cast<double>(k) * h, h);
    std::copy(x.first.begin(), x.first.end(), z.begin());
    std::copy(x.second.begin(), x.second.end(), z.begin() + half);
  });
}

template <class S>
void add_methods() {
  const StaticProblem<S> problem;
  const auto force = [problem](const Half<S>& q, Half<S>& f) { problem.force(0, q, f); };
  const auto velocity = [problem](const Half<S>& p, Half<S>& v) { problem.velocity(0, p, v); };
  const auto acceleration = [problem](const Half<S>& q, const Half<S>& /*p*/, Half<S>& a, double t) {
    problem.force(t, q, a);
  };
  add_field_stepper<S, odeint::runge_kutta4<Whole<S>>>("rk4");
  add_field_stepper<S, odeint::runge_kutta_dopri5<Whole<S>>>("dopri5");
  add_pair_stepper<S, odeint::velocity_verlet<Half<S>>>("velocity-verlet", acceleration);
  add_pair_stepper<S, odeint::symplectic_euler<Half<S>>>("symplectic-euler", std::make_pair(velocity, force));
  add_pair_stepper<S, odeint::symplectic_rkn_sb3a_mclachlan<Half<S>>>("mclachlan",
                                                                      std::make_pair(velocity, force));
}

[[maybe_unused]] const bool added =
    (add_methods<HarmonicOscillator>(), add_methods<Pendulum>(), add_methods<Kepler>(), true);
}  // namespace
