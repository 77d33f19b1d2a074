// Bead-rod systems allocate no memory in anything a run asks of them. The global operator new of this program
// counts allocations while counting is switched on.
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/formulation.hpp>

#include "../counted_allocations.hpp"
#include "bead_rod_files.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::allocations_of;

template <class T>
void expect_none(const std::string& system, const Assignments& parameters) {
  const auto model = systems().get(system, "system").make(parameters);
  std::vector<T> z, rate(static_cast<std::size_t>(model->dimension()));
  for (const Real& x : model->initial()) z.push_back(T(x));
  const std::size_t n = z.size() / 2;
  const In<T> q(z.data(), n), p(z.data() + n, n);
  for (const char* formulation : {"dirac", "simplified-dirac", "lmm", "ggl"}) {
    const auto field =
        make_evaluator<T>(formulations().get(formulation, "formulation").apply(model, {}), Formula::field);
    EXPECT_EQ(allocations_of([&] { field.call(field.context, T(0), z.data(), rate.data()); }), 0)
        << system << ' ' << formulation;
  }
  const auto constraints = model->holonomic_constraints<T>();
  std::vector<T> phi(constraints->count()), along(n);
  EXPECT_EQ(allocations_of([&] {
              constraints->values(T(0), q, phi);
              constraints->hidden_values(T(0), q, p, phi);
              constraints->velocity(T(0), q, p, along);
              constraints->force(T(0), q, p, along);
              constraints->linearise(T(0), q, p);
              constraints->apply(q, phi);
              constraints->solve(phi, phi);
              constraints->apply_transpose(phi, along);
              constraints->place(T(0), q, p);
              constraints->factor_friction();
              constraints->solve_friction(phi, phi);
            }),
            0)
      << system;
}

TEST(BeadRodAllocation, NoneInAnEvaluation) {
  // The counter counts: a vector is an allocation.
  EXPECT_EQ(allocations_of([] { const std::vector<double> v(100); }), 1);
  const Assignments cells{{"beads", "40"}, {"cutoff", "2.5"}, {"friction", "0.2"}};
  expect_none<double>("chain-molecule", cells);
  expect_none<Quad>("chain-molecule", cells);
  expect_none<double>("n-pendulum", {{"bobs", "33"}});
  expect_none<double>("ring", {{"beads", "12"}, {"friction", "0.1"}});
  expect_none<double>("humanoid", {});
  expect_none<Quad>("humanoid", {});
  expect_none<double>("four-bar", {});
}

}  // namespace
