// Methods that claim what they do not keep, for the search of counterexamples to find. Each keeps its claim
// on systems that a hasty test would take.
#include <array>
#include <vector>

#include <pfaff/core/integrator.hpp>
#include <pfaff/core/numbers/gauss_legendre.hpp>
#include <pfaff/integrators/constrained/projection.hpp>
#include <pfaff/integrators/multistep/leap_frog.hpp>
#include <pfaff/integrators/runge_kutta/gauss.hpp>

namespace {
using namespace pfaff;

// A singly diagonally implicit method of two stages and order 2,
//
//   a_11 = a_22 = 1/4, a_21 = 1/3, b = (1/4, 3/4).
//
// Its stability function is ((1 + x/4)/(1 - x/4))^2, since b_2 a_21 = 1/4 makes the numerator (1 + x/4)^2; a
// step is therefore symplectic on every linear system. It is not on others: b_1 a_11 + b_1 a_11 = 1/8 and
// b_1^2 = 1/16.
struct SinglyDiagonal {
  template <class P>
  struct Work {
    State<P> start, point, rate, first;
    Work(const SinglyDiagonal& /*method*/, const P& p)
        : start(p.make_state()), point(p.make_state()), rate(p.make_state()), first(p.make_state()) {}
  };

  // rate = X(start + h/4 rate), iterated until the change is rounding; duals are iterated once more for each
  // iteration that their values have needed.
  template <class P>
  static Status stage(const P& p, const Scalar<P>& t, const Scalar<P>& h, Work<P>& w) {
    using T = Scalar<P>;
    p.field(t, w.start, w.rate);
    for (int iteration = 0; iteration < 200; ++iteration) {
      for (std::size_t k = 0; k < w.point.size(); ++k) w.point[k] = w.start[k] + h / T(4) * w.rate[k];
      p.field(t, w.point, w.rate);
    }
    for (const T& x : w.rate)
      if (!isfinite(value_of(x))) return Status::non_finite;
    return Status::converged;
  }

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    for (std::size_t k = 0; k < z.size(); ++k) w.start[k] = z[k];
    if (const Status status = stage(p, t + h / T(4), h, w); status != Status::converged) return status;
    for (std::size_t k = 0; k < z.size(); ++k) {
      w.first[k] = w.rate[k];
      w.start[k] = z[k] + h / T(3) * w.rate[k];
    }
    if (const Status status = stage(p, t + T(7) * h / T(12), h, w); status != Status::converged)
      return status;
    for (std::size_t k = 0; k < z.size(); ++k)
      z[k] = z[k] + h / T(4) * w.first[k] + T(3) * h / T(4) * w.rate[k];
    return Status::converged;
  }
};
const Method<SinglyDiagonal> singly_diagonal{{.name = "false-singly-diagonal",
                                              .title = "symplectic on linear systems only",
                                              .reference = "",
                                              .order = 2,
                                              .preserves = {Claim::symplectic}}};

// A symmetric projection is symplectic where the constraints are linear, since it then moves along constant
// directions; elsewhere it is not.
struct ProjectedMidpoint : SymmetricallyProjected<ImplicitMidpoint, SurfaceShift> {};
const Method<ProjectedMidpoint> projected{{.name = "false-projection",
                                           .title = "symplectic where constraints are linear",
                                           .reference = "",
                                           .order = 2,
                                           .preserves = {Claim::constrained_symplectic}}};

// The midpoint rule keeps every constant structure, which is what a linear one-form has.
struct Midpoint : ImplicitMidpoint {};
const Method<Midpoint> midpoint{{.name = "false-midpoint",
                                 .title = "K-symplectic where K is constant",
                                 .reference = "",
                                 .order = 2,
                                 .preserves = {Claim::k_symplectic}}};

struct Leaping : LeapFrog {};
const Method<Leaping> leaping{{.name = "false-leap-frog",
                               .title = "symmetric as a map of two steps, and not as one of one",
                               .reference = "",
                               .order = 2,
                               .preserves = {Claim::symmetric, Claim::energy}}};

// The same leaps after a first step by the midpoint rule. That step is symmetric, and so is the claim where
// only a single step is looked at; the parasitic oscillation of the leaps shows when steps go on and are then
// taken back.
struct WellStarted {
  template <class P>
  struct Work {
    State<P> before, point, rate;
    bool started = false;
    Work(const WellStarted& /*method*/, const P& p)
        : before(p.make_state()), point(p.make_state()), rate(p.make_state()) {}
  };
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    p.field(t, z, w.rate);
    if (!w.started) {
      for (std::size_t k = 0; k < z.size(); ++k) w.before[k] = z[k];
      for (int iteration = 0; iteration < 200; ++iteration) {
        for (std::size_t k = 0; k < z.size(); ++k) w.point[k] = z[k] + h / T(2) * w.rate[k];
        p.field(t + h / T(2), w.point, w.rate);
      }
    }
    const T span = w.started ? h + h : h;
    for (std::size_t k = 0; k < z.size(); ++k) {
      const T next = w.before[k] + span * w.rate[k];
      w.before[k] = z[k];
      z[k] = next;
    }
    w.started = true;
    return Status::converged;
  }
};
const Method<WellStarted> well_started{{.name = "false-two-step",
                                        .title = "symmetric in its first step only",
                                        .reference = "",
                                        .order = 2,
                                        .preserves = {Claim::symmetric}}};

// The mean of the rates along the straight line from the old state to the new one, by four nodes of Gauss and
// Legendre. The integral keeps T(p) + V(q), and so do four nodes for polynomials up to degree eight; on
// others the energy is lost.
struct AveragedRates {
  std::vector<QuadratureNode> nodes = gauss_legendre(4);
  template <class P>
  struct Work {
    State<P> next, mean;
    std::vector<Scalar<P>> point, rate;
    Work(const AveragedRates& /*method*/, const P& p)
        : next(p.make_state()), mean(p.make_state()), point(p.size() / 2), rate(p.size() / 2) {}
  };
  template <HasSeparable P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const std::size_t d = z.size() / 2;
    for (std::size_t k = 0; k < z.size(); ++k) w.next[k] = z[k];
    for (int iteration = 0; iteration < 200; ++iteration) {
      for (std::size_t k = 0; k < z.size(); ++k) w.mean[k] = T(0);
      for (const QuadratureNode& node : nodes)
        for (const std::size_t first : {d, std::size_t{0}}) {
          for (std::size_t k = 0; k < d; ++k)
            w.point[k] = z[first + k] + T(node.place) * (w.next[first + k] - z[first + k]);
          if (first == d) {
            p.velocity(t, w.point, w.rate);
          } else {
            p.force(t, w.point, w.rate);
          }
          for (std::size_t k = 0; k < d; ++k)
            w.mean[d - first + k] = w.mean[d - first + k] + T(node.weight) * w.rate[k];
        }
      for (std::size_t k = 0; k < z.size(); ++k) w.next[k] = z[k] + h * w.mean[k];
    }
    for (std::size_t k = 0; k < z.size(); ++k) {
      z[k] = w.next[k];
      if (!isfinite(value_of(z[k]))) return Status::non_finite;
    }
    return Status::converged;
  }
};
const Method<AveragedRates> averaged{{.name = "false-averaged",
                                      .title = "keeps energies that are polynomials up to degree eight",
                                      .reference = "",
                                      .order = 2,
                                      .preserves = {Claim::energy}}};

// The midpoint rule, which is symplectic, and with another setting than the one it is verified with a step
// that is not.
struct SometimesMidpoint : ImplicitMidpoint {
  int wrong = 0;
  static std::vector<Parameter> parameters() {
    return {parameter(&SometimesMidpoint::wrong, "wrong", "", 0, 3, "anything but 0 spoils the step")};
  }
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    const Status status = ImplicitMidpoint::step(p, t, h, z, w);
    if (wrong != 0) z[0] = z[0] + h * h * h * z[0];
    return status;
  }
};
const Method<SometimesMidpoint> sometimes{{.name = "false-with-parameters",
                                           .title = "symplectic with the parameters it is verified with",
                                           .reference = "",
                                           .order = 2,
                                           .preserves = {Claim::symplectic}}};

// The midpoint rule with an error of 1e-16 that changes with every bit of its arguments, as rounding does, in
// both precisions. Its claims are true up to rounding, so that nothing may be found here.
struct Noisy : ImplicitMidpoint {
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const Status status = ImplicitMidpoint::step(p, t, h, z, w);
    const T size(Real::fraction(1, 10000000000000000)), frequency(Real::fraction(100000000000000, 1));
    for (T& x : z) x = x + size * sin(frequency * (x + h));
    return status;
  }
};
const Method<Noisy> noisy{{.name = "noisy-midpoint",
                           .title = "symmetric up to rounding",
                           .reference = "",
                           .order = 2,
                           .preserves = {Claim::symmetric}}};

}  // namespace
