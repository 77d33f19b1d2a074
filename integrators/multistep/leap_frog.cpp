// The leap-frog scheme as a plug-in.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/multistep/leap_frog.hpp>
#include <pfaff/integrators/order_conditions/multistep_conditions.hpp>
#include <pfaff/integrators/order_conditions/rooted_trees.hpp>

namespace {
using namespace pfaff;

struct LeapFrog : pfaff::LeapFrog {
  static constexpr bool fixed_sizes = false;  // one field evaluation and two sums
};

const Method<LeapFrog> registered{
    {.name = "leap-frog",
     .title = "leap-frog scheme (explicit two-step midpoint rule)",
     .family = "multistep",
     .reference = "hairer-norsett-wanner1993 III.1",
     .description = "The explicit two-step midpoint rule for any vector field, of order 2 with one "
                    "evaluation a step. Take it only to compare, as one of the conventional schemes that "
                    "keep no Birkhoffian structure. It is weakly stable: where the motion decays a parasitic "
                    "oscillation between odd and even steps grows.",
     .order = 2,
     .preserves = {Claim::none}}};

// The starting step is z_0 + h leap X(z_0 + h half X(z_0)), a Runge-Kutta method; the others are those of
// rho = x^2 - 1 and sigma = 2 leap x.
const KnownOrderTheory leap_frog_conditions{
    "leap-frog", [](const Assignments& /*parameters*/) {
      const auto lengths = pfaff::LeapFrog().lengths;
      OrderTheory theory{
          "multistep", 2, {lengths.begin(), lengths.end()}, [](const std::vector<Quad>& numbers) {
            const Quad &half = numbers[0], &leap = numbers[1];
            auto list =
                multistep_conditions({{Quad(-1), Quad(0), Quad(1)}, {Quad(0), Quad(2) * leap, Quad(0)}}, 2);
            for (OrderCondition& condition :
                 tree_conditions({{Quad(0), Quad(0), half, Quad(0)}, {Quad(0), leap}}, 2)) {
              condition.name = "of the starting step, " + condition.name;
              list.push_back(std::move(condition));
            }
            return list;
          }};
      theory.sums = {OrderTheory::in_no_sum, 0};
      return theory;
    }};
}  // namespace
