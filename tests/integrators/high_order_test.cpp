// Generating functions of orders 13 to 20 in quad, which verification cannot measure because their errors
// reach round-off at its steps. One large step is compared with two half steps of Gauss collocation of order
// 32.
#include <gtest/gtest.h>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/runs/support/structure.hpp>

#include "methods.hpp"

namespace pfaff {
namespace {

using ModelPointer = std::shared_ptr<const Model>;
using testing::after_steps;
using testing::generating_scheme;
using testing::initial_state;

std::vector<Quad> stepped(const MethodInstance& method, const ModelPointer& model, const Quad& h, int count) {
  return after_steps(method, model, h, count, initial_state(*model), Quad(1) / Quad(4));
}
Quad local_error(const MethodInstance& method, const MethodInstance& reference, const ModelPointer& model,
                 const Quad& h) {
  const auto z = stepped(method, model, h, 1), exact = stepped(reference, model, h / Quad(2), 2);
  Quad worst(0);
  for (std::size_t k = 0; k < z.size(); ++k) worst = std::max(worst, abs(z[k] - exact[k]));
  return worst;
}

// Between the two steps errors of order 21 are still far above 1e-33, and the local exponent is within 1/2 of
// m + 1, or of m + 2 where an odd order gains one; a slope one order off is a whole unit away.
TEST(HighOrders, AreReachedInOneStep) {
  const auto reference = integrators().get("gauss", "integrator").make({{"stages", "16"}});
  const std::vector<std::pair<const char*, Quad>> cases{{"damped-pendulum", Quad(1) / Quad(4)},
                                                        {"lotka-volterra", Quad(1) / Quad(10)}};
  for (const auto& [name, h] : cases) {
    const ModelPointer model = systems().get(name, "system").make({});
    for (int order = 13; order <= 20; ++order)
      for (const char* variant : {"P", "S"}) {
        if (order % 2 == 1 && variant[0] == 'S') continue;
        // The leading term of odd orders is small as the damping, and shows at steps too small for quad only.
        if (order % 2 == 1 && !model->chart_autonomous()) continue;
        const auto method = generating_scheme(order, variant);
        const Quad coarse = local_error(*method, *reference, model, h);
        const Quad fine = local_error(*method, *reference, model, h / Quad(2));
        EXPECT_GT(fine, Quad(1e-32)) << name << " " << order << variant << ": nothing left to measure";
        EXPECT_NEAR(static_cast<double>(log(coarse / fine) / log(Quad(2))), method->order(*model) + 1, 0.5)
            << name << " " << order << variant;
      }
  }
}

TEST(HighOrders, KeepTheStructure) {
  for (const char* name : {"damped-pendulum", "lotka-volterra", "henon-heiles", "dense-time-structure"}) {
    const ModelPointer model = systems().get(name, "system").make({});
    for (int order = 13; order <= 20; ++order) {
      const auto method = generating_scheme(order, "auto");
      StructureResidual<Quad> residual(*method, model);
      const std::vector<Quad> z = initial_state(*model);
      EXPECT_LE(residual(Quad(1) / Quad(4), Quad(1) / Quad(10), z), Quad(1e-31)) << name << " " << order;
    }
    // The control: what does not keep it.
    StructureResidual<Quad> residual(*integrators().get("rk4", "integrator").make({}), model);
    EXPECT_GT(residual(Quad(1) / Quad(4), Quad(1) / Quad(10), initial_state(*model)), Quad(1e-12)) << name;
  }
}

}  // namespace
}  // namespace pfaff
