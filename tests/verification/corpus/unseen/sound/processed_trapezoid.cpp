// The trapezoidal rule as a processed midpoint rule. With w = z + h/2 X(z, t) before the first step, steps of
// the midpoint rule in w, and the solution z of z + h/2 X(z, t) = w after the last one, n steps are n steps
// of the trapezoidal rule
//
//   z' = z + h/2 (X(z, t) + X(z', t + h)),   while the kernel is w' = w + h X((w + w')/2, t + h).
//
// The whole step is symmetric and of order 2.
//
// Source: Dahlquist, Error analysis for a class of methods for stiff nonlinear initial value problems (1976);
// Hairer, Lubich, Wanner, Geometric Numerical Integration, VI.8.1.
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/solve/convergence.hpp>

namespace {
using namespace pfaff;

struct ProcessedTrapezoid {
  static constexpr bool fixed_sizes = false;
  [[nodiscard]] bool processed() const { return true; }

  template <class P>
  struct Work {
    State<P> rate, next, middle, start;
    Work(const ProcessedTrapezoid& /*method*/, const P& p)
        : rate(p.make_state()), next(p.make_state()), middle(p.make_state()), start(p.make_state()) {}
  };

  template <HasVectorField P>
  Status preprocess(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    p.field(t, z, w.rate);
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = z[k] + h / T(2) * w.rate[k];
    return Status::converged;
  }
  template <HasVectorField P>
  Status kernel(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    return solve(p, t + h, h, Scalar<P>(1) / Scalar<P>(2), z, w);
  }
  // z = w - h/2 X(z, t), by the time at which the last step ends.
  template <HasVectorField P>
  Status postprocess(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    return solve(p, t, T(-h / T(2)), T(1), z, w);
  }
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    for (std::size_t k = 0; k < z.size(); ++k) w.start[k] = z[k];
    Status status = preprocess(p, t, h, z, w);
    if (status == Status::converged) status = kernel(p, t, h, z, w);
    if (status == Status::converged) status = postprocess(p, t + h, h, z, w);
    if (status != Status::converged)
      for (std::size_t k = 0; k < z.size(); ++k) z[k] = w.start[k];
    return status;
  }

 private:
  // x = z + length X(z + share (x - z), time), which takes the place of z where it is found.
  template <class P>
  static Status solve(const P& p, const Scalar<P>& time, const Scalar<P>& length, const Scalar<P>& share,
                      State<P>& z, Work<P>& w) {
    using T = Scalar<P>;
    for (std::size_t k = 0; k < z.size(); ++k) w.next[k] = z[k];
    Convergence<T> convergence(Corrections::uneven);
    do {
      for (std::size_t k = 0; k < z.size(); ++k) w.middle[k] = z[k] + share * (w.next[k] - z[k]);
      p.field(time, w.middle, w.rate);
      convergence.begin_iteration();
      for (std::size_t k = 0; k < z.size(); ++k) {
        const T found = z[k] + length * w.rate[k];
        convergence.add(found - w.next[k], z[k], found);
        w.next[k] = found;
      }
    } while (!convergence.finished(300));
    if (convergence.status() == Status::converged)
      for (std::size_t k = 0; k < z.size(); ++k) z[k] = w.next[k];
    return convergence.status();
  }
};

const Method<ProcessedTrapezoid> registered{
    {.name = "processed-trapezoid",
     .title = "trapezoidal rule as a processed midpoint rule",
     .reference = "hairer-lubich-wanner2006 VI.8",
     .description = "The trapezoidal rule, whose steps in a row are those of the midpoint rule between a "
                    "processor and its inverse. "
                    "It is conjugate to a symplectic method and not symplectic itself.",
     .order = 2,
     .preserves = {Claim::symmetric, Claim::reversible}}};
}  // namespace
