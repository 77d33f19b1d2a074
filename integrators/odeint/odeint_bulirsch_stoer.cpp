// Boost.Odeint's Bulirsch-Stoer method. With a tolerance it is odeint's bulirsch_stoer, which chooses order
// and step (and allocates in every step). That class has no step of a given size: a fixed step is odeint's
// modified_midpoint of 2, 4, 6 and 8 substeps, extrapolated in h^2 as there, and so of order 8; every
// number in it is a fraction, so that it steps in quad too.
#include <algorithm>
#include <array>
#include <boost/numeric/odeint/algebra/algebra_dispatcher.hpp>
#include <boost/numeric/odeint/algebra/range_algebra.hpp>
#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <boost/numeric/odeint/stepper/modified_midpoint.hpp>
#include <span>

#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/odeint/odeint_containers.hpp>

namespace {
using namespace pfaff;
namespace odeint = boost::numeric::odeint;

struct OdeintBulirschStoer {
  static constexpr std::size_t rows = 4;
  /// Weights 1/((m_k/m_i)^2 - 1) of Neville's scheme for m = 2, 4, 6, 8 substeps, row k by row, i falling.
  std::array<Quad, rows*(rows - 1) / 2> weights = [] {
    std::array<Quad, rows*(rows - 1) / 2> w;
    std::size_t next = 0;
    for (int k = 2; k <= static_cast<int>(rows); ++k)
      for (int i = k - 1; i >= 1; --i) w[next++] = Quad(i * i) / Quad(k * k - i * i);
    return w;
  }();
  std::span<Quad> coefficients() { return weights; }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    odeint::modified_midpoint<ContainerOf<P>, double, ContainerOf<P>, T, odeint::range_algebra> midpoint;
    ContainerOf<P> state, rate;
    std::array<ContainerOf<P>, rows> table;
    ControlledWork<P> controlled;
    Work(const OdeintBulirschStoer& /*method*/, const P& p)
        : state(sized<ContainerOf<P>>(p.size())), rate(state), controlled(p) {
      table.fill(state);
    }
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    const auto system = [&](const ContainerOf<P>& x, ContainerOf<P>& rate, const Scalar<P>& time) {
      p.field(time, x, rate);
    };
    std::copy(z.begin(), z.end(), w.state.begin());
    system(w.state, w.rate, t);
    for (std::size_t k = 0; k < rows; ++k) {
      w.midpoint.set_steps(static_cast<unsigned short>(2 * (k + 1)));
      w.midpoint.do_step(system, w.state, w.rate, t, w.table[k], h);
      // Neville's scheme in h^2: after column j, row k - j has order 2 j + 2.
      for (std::size_t j = 1; j <= k; ++j) {
        const Scalar<P> weight = Scalar<P>(Real(weights[k * (k - 1) / 2 + j - 1]));
        ContainerOf<P>& row = w.table[k - j];
        for (std::size_t i = 0; i < row.size(); ++i)
          row[i] = w.table[k - j + 1][i] + (w.table[k - j + 1][i] - row[i]) * weight;
      }
    }
    std::copy(w.table[0].begin(), w.table[0].end(), z.begin());
    return Status::converged;
  }

  template <HasVectorField P>
  requires std::is_same_v < Scalar<P>,
  double > Status advance_to(const P& p, double& t, double end, const Tolerance<double>& tolerance,
                             State<P>& z, Work<P>& w) const {
    using C = ContainerOf<P>;
    odeint::bulirsch_stoer<C, double, C, double, OwnScaleAlgebra, OwnScaleOperations> stepper;
    ControlledWork<P>& c = w.controlled;
    const auto system = [&](const C& x, C& rate, double time) { p.field(time, x, rate); };
    return controlled_steps(
        p, t, end, tolerance, z, c,
        [&](double& h) { return stepper.try_step(system, c.from, c.rate, t, c.end, h) == odeint::success; },
        [&] { p.field(t, c.from, c.rate); });
  }
};

const Method<OdeintBulirschStoer> registered{
    {.name = "odeint-bulirsch-stoer",
     .title = "Boost.Odeint bulirsch_stoer; fixed steps of order 8",
     .family = "explicit",
     .reference = "ahnert-mulansky2011; hairer-norsett-wanner1993 II.9",
     .description =
         "Boost.Odeint's extrapolation of the modified midpoint rule, which chooses order and step for a "
         "tolerance; with steps of one size it is of order 8. Take it for smooth problems at high accuracy "
         "over short times. It keeps no structure, and with a tolerance it allocates in every step.",
     .order = 8,
     .preserves = {Claim::none}}};
}  // namespace
