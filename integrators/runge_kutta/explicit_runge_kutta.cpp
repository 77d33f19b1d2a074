// The explicit Runge-Kutta methods as plug-ins.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/order_conditions/rooted_trees.hpp>
#include <pfaff/integrators/runge_kutta/explicit_runge_kutta.hpp>

namespace {
using namespace pfaff;

struct RegisteredRungeKutta4 : pfaff::RungeKutta4 {};

const Method<RegisteredRungeKutta4> registered{
    {.name = "rk4",
     .title = "classical Runge-Kutta method of order 4",
     .family = "explicit",
     .reference = "hairer-norsett-wanner1993 II.1",
     .description =
         "The classical explicit Runge-Kutta method of order 4. Take it as the yardstick, and for short runs "
         "at moderate accuracy of any vector field. It keeps no structure: energies drift linearly over long "
         "runs, and here it is the control that every test of structure has to reject.",
     .order = 4,
     .preserves = {Claim::none}}};

// The lower triangle of a row by row, then b, as a tableau.
RungeKuttaTableau<Quad> tableau_of(const std::vector<Quad>& numbers) {
  constexpr std::size_t s = RegisteredRungeKutta4::stages;
  RungeKuttaTableau<Quad> tableau{std::vector<Quad>(s * s),
                                  std::vector<Quad>(numbers.end() - s, numbers.end())};
  for (std::size_t i = 1, k = 0; i < s; ++i)
    for (std::size_t j = 0; j < i; ++j) tableau.a[i * s + j] = numbers[k++];
  return tableau;
}

const KnownOrderTheory runge_kutta_4_conditions{
    "rk4", [](const Assignments& /*parameters*/) {
      const auto numbers = RegisteredRungeKutta4().tableau;
      return tree_theory(tableau_of({numbers.begin(), numbers.end()}), 4, true);
    }};
}  // namespace
