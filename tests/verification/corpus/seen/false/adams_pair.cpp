// The explicit method of Adams and Bashforth of two steps, with a first step of the midpoint rule.
//
// Source: Bashforth, Adams (1883); Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I,
// III.1.
//
// False: `order` is 2 for the first run of a thread only; its last slope, which is static, begins the next.
#include <vector>

#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

template <class T>
struct Past {
  static inline thread_local std::vector<T> slope;  // a race of threads would be another fault
};

struct AdamsPair {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    State<P> rate, point;
    Work(const AdamsPair& /*method*/, const P& p) : rate(p.make_state()), point(p.make_state()) {}
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    std::vector<T>& before = Past<T>::slope;
    p.field(t, z, w.rate);
    if (before.size() != z.size()) {
      before.assign(w.rate.begin(), w.rate.end());
      for (std::size_t k = 0; k < z.size(); ++k) w.point[k] = z[k] + h * w.rate[k] / T(2);
      p.field(t + h / T(2), w.point, w.rate);
      for (std::size_t k = 0; k < z.size(); ++k) z[k] = z[k] + h * w.rate[k];
      return Status::converged;
    }
    for (std::size_t k = 0; k < z.size(); ++k) {
      z[k] = z[k] + h * (T(3) * w.rate[k] - before[k]) / T(2);
      before[k] = w.rate[k];
    }
    return Status::converged;
  }
};

const Method<AdamsPair> registered{
    {.name = "adams-pair",
     .title = "Adams and Bashforth's method of two steps",
     .reference = "hairer-norsett-wanner1993 III.1",
     .description = "One evaluation a step and order 2. Take it where the field is dear. It keeps no "
                    "structure.",
     .order = 2,
     .preserves = {Claim::none}}};
}  // namespace
