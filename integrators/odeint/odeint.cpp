// Boost.Odeint's steppers as registered methods: the methods that everyone has, as the yardstick.
//
// Traps of that library that do not arise here, because Pfaff drives the steps itself: its steppers are
// copied into the integrate functions (state and history with them), and integrate_times and
// integrate_adaptive shorten steps to hit output times, which breaks the structure of fixed-step methods.
// Coefficients are doubles, so no claims are made in quad. The adaptive step is the controlled dopri5, whose
// errors are weighed by the scales of the coordinates (core/facets/tolerance.hpp).
#include <algorithm>
#include <boost/numeric/odeint/algebra/algebra_dispatcher.hpp>
#include <boost/numeric/odeint/algebra/range_algebra.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/symplectic_rkn_sb3a_mclachlan.hpp>

#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/odeint/odeint_containers.hpp>

namespace {
using namespace pfaff;
namespace odeint = boost::numeric::odeint;

// A stepper of the vector field, one fixed step at a time.
template <template <class...> class OdeintStepper>
struct FieldStepper {
  template <class P>
  struct Work {
    using T = Scalar<P>;
    OdeintStepper<ContainerOf<P>, double, ContainerOf<P>, T, odeint::range_algebra> stepper;
    ContainerOf<P> state;
    Work(const FieldStepper& /*method*/, const P& p) : state(sized<ContainerOf<P>>(p.size())) {}
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    std::copy(z.begin(), z.end(), w.state.begin());
    w.stepper.do_step(
        [&](const ContainerOf<P>& x, ContainerOf<P>& rate, const Scalar<P>& time) { p.field(time, x, rate); },
        w.state, t, h);
    std::copy(w.state.begin(), w.state.end(), z.begin());
    return Status::converged;
  }
};

template <class... A>
using Rk4Stepper = odeint::runge_kutta4<A...>;
struct OdeintRk4 : FieldStepper<Rk4Stepper> {};

// dopri5 keeps its last slope (FSAL) between steps; here every step of a given size starts from its own
// state, so that it is a function of (t, z, h) alone.
template <class... A>
using Dopri5Stepper = odeint::runge_kutta_dopri5<A...>;
struct OdeintDopri5 : FieldStepper<Dopri5Stepper> {
  template <class P>
  struct Work : FieldStepper::Work<P> {
    ControlledWork<P> controlled;
    Work(const OdeintDopri5& method, const P& p) : FieldStepper::Work<P>(method, p), controlled(p) {}
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    w.stepper.reset();
    return FieldStepper::step(p, t, h, z, w);
  }

  template <HasVectorField P>
  requires std::is_same_v < Scalar<P>,
  double > Status advance_to(const P& p, double& t, double end, const Tolerance<double>& tolerance,
                             State<P>& z, Work<P>& w) const {
    using C = ContainerOf<P>;
    using Pair = Dopri5Stepper<C, double, C, double, OwnScaleAlgebra, OwnScaleOperations>;
    odeint::controlled_runge_kutta<Pair> controlled;
    ControlledWork<P>& c = w.controlled;
    const auto system = [&](const C& x, C& rate, double time) { p.field(time, x, rate); };
    return controlled_steps(
        p, t, end, tolerance, z, c,
        [&](double& h) {
          return controlled.try_step(system, c.from, c.rate, t, c.end, c.end_rate, h) == odeint::success;
        },
        [&] { std::swap(c.rate, c.end_rate); });
  }
};

// McLachlan's symplectic Runge-Kutta-Nystroem method of order 4 on (q, p).
struct OdeintMcLachlan {
  template <class P>
  struct Work {
    using T = Scalar<P>;
    using Half = HalfOf<P, 0>;
    odeint::symplectic_rkn_sb3a_mclachlan<Half, Half, double, Half, Half, T, odeint::range_algebra> stepper;
    std::pair<Half, Half> state;
    Work(const OdeintMcLachlan& /*method*/, const P& p)
        : state(sized<Half>(p.size() / 2), sized<Half>(p.size() / 2)) {}
  };

  [[nodiscard]] static std::string refuses(const Model& model) {
    return model.autonomous() ? std::string()
                              : "takes no time in its force; " + model.name() + " depends on time";
  }

  template <HasSeparable P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using Half = HalfOf<P, 0>;
    const auto half = static_cast<std::ptrdiff_t>(z.size() / 2);
    std::copy(z.begin(), z.begin() + half, w.state.first.begin());
    std::copy(z.begin() + half, z.end(), w.state.second.begin());
    const auto velocity = [&](const Half& momentum, Half& v) { p.velocity(t, momentum, v); };
    const auto force = [&](const Half& q, Half& f) { p.force(t, q, f); };
    w.stepper.do_step(std::make_pair(velocity, force), w.state, t, h);
    std::copy(w.state.first.begin(), w.state.first.end(), z.begin());
    std::copy(w.state.second.begin(), w.state.second.end(), z.begin() + half);
    return Status::converged;
  }
};

const Method<OdeintRk4> rk4{
    {.name = "odeint-rk4",
     .title = "Boost.Odeint runge_kutta4",
     .family = "explicit",
     .reference = "ahnert-mulansky2011",
     .description = "Boost.Odeint's classical Runge-Kutta method of order 4, driven step by step. Take it to "
                    "compare cost with a library that everyone has. Its coefficients are doubles, so that "
                    "nothing is claimed of it in quad precision, and it keeps no structure.",
     .order = 4,
     .preserves = {Claim::none},
     .double_coefficients = true}};
const Method<OdeintDopri5> dopri5{
    {.name = "odeint-dopri5",
     .title = "Boost.Odeint runge_kutta_dopri5 (Dormand-Prince)",
     .family = "explicit",
     .reference = "ahnert-mulansky2011; dormand-prince1980",
     .description = "Boost.Odeint's Dormand and Prince pair of order 5, with steps of one size or controlled "
                    "by a tolerance. Take it as the usual general-purpose method, for short runs to a given "
                    "accuracy. Its coefficients are doubles and it keeps no structure: over long runs "
                    "invariants drift at the rate of the tolerance.",
     .order = 5,
     .preserves = {Claim::none},
     .double_coefficients = true}};
const Method<OdeintMcLachlan> mclachlan{
    {.name = "odeint-mclachlan",
     .title = "Boost.Odeint symplectic_rkn_sb3a_mclachlan",
     .family = "splitting",
     .reference = "ahnert-mulansky2011; mclachlan1995",
     .description =
         "Boost.Odeint's symplectic Runge-Kutta-Nystroem method of McLachlan, explicit, symmetric and of "
         "order 4 for separable energies. Take it to compare with symplectic methods of this order here. Its "
         "coefficients are doubles, so that its order and structure end near round-off of double precision.",
     .order = 4,
     .preserves = {Claim::symplectic, Claim::symmetric, Claim::reversible},
     .double_coefficients = true}};
}  // namespace
