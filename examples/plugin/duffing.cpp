// The undamped Duffing oscillator, H = p^2/2 + alpha q^2/2 + beta q^4/4.
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct Duffing {
  static constexpr int dimension = 2;
  Real alpha = -1, beta = 1;
  static std::vector<Parameter> parameters() {
    return {parameter(&Duffing::alpha, "alpha", "1/s^2", -10, 10, "linear stiffness"),
            parameter(&Duffing::beta, "beta", "1/(m s)^2", 0, 10, "cubic stiffness")};
  }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    const T square = q[0] * q[0];
    return alpha * square / 2 + beta * square * square / 4;
  }
};

const System<Duffing> registered{
    {.name = "duffing",
     .title = "Duffing oscillator, q'' + alpha q + beta q^3 = 0",
     .reference = "duffing1918",
     .description = "A particle in a double well without friction, the example of a plug-in outside the "
                    "tree. Take it as a start for a system of your own. It conserves its energy and has an "
                    "unstable point at the origin, where motions separate.",
     .coordinates = {{"q", "m"}, {"p", "m/s"}},
     .initial = {0.5_r, 0}}};
}  // namespace
