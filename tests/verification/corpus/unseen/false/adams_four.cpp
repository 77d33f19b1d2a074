// The explicit Adams method of four steps, which starts by itself.
//
// Source: Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, III.1, (1.5).
//
// False: `order` is 3, not 4: the first three steps are of Heun's method of order 2, whose local error h^3
// stays in the solution.
#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

struct AdamsFour {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    std::array<State<P>, 4> rates;  // the newest first
    State<P> point, left;           // what the last step left
    Scalar<P> length{0};
    int known = 0;
    Work(const AdamsFour& /*method*/, const P& p)
        : rates{p.make_state(), p.make_state(), p.make_state(), p.make_state()},
          point(p.make_state()),
          left(p.make_state()) {}
    void restart() { known = 0; }
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    bool goes_on = value_of(w.length) == value_of(h);
    for (std::size_t k = 0; k < z.size(); ++k) goes_on = goes_on && value_of(w.left[k]) == value_of(z[k]);
    if (!goes_on) w.known = 0;
    auto& [newest, second, third, oldest] = w.rates;
    for (std::size_t k = 0; k < z.size(); ++k) {
      oldest[k] = third[k];
      third[k] = second[k];
      second[k] = newest[k];
    }
    p.field(t, z, newest);
    if (w.known < 3) {
      for (std::size_t k = 0; k < z.size(); ++k) w.point[k] = z[k] + h * newest[k];
      p.field(t + h, w.point, w.left);
      for (std::size_t k = 0; k < z.size(); ++k) z[k] = z[k] + h * (newest[k] + w.left[k]) / 2;
      ++w.known;
    } else {
      for (std::size_t k = 0; k < z.size(); ++k)
        z[k] = z[k] + h * (55 * newest[k] - 59 * second[k] + 37 * third[k] - 9 * oldest[k]) / 24;
    }
    for (std::size_t k = 0; k < z.size(); ++k) w.left[k] = z[k];
    w.length = h;
    return Status::converged;
  }
};

const Method<AdamsFour> registered{
    {.name = "adams-four",
     .title = "explicit Adams method of four steps",
     .reference = "hairer-norsett-wanner1993 III.1",
     .description =
         "The explicit Adams method of four steps with a start of its own. Take it where the field "
         "is dear and smooth. It starts anew whenever the step or the state is changed.",
     .order = 4,
     .preserves = {Claim::none}}};
}  // namespace
