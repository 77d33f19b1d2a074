// Energies and momenta of beads on rods at eight states side by side: every lane has the bits that its state
// has alone. Where pairs are sorted by a cut-off, whose sums packs would add up in another order, no such
// evaluator is offered.
#include <gtest/gtest.h>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

// The lanes in which a formula differs from what it is alone; -1 where it is not offered in lanes.
int lanes_that_differ(const std::shared_ptr<const Model>& model, Formula formula, std::size_t results) {
  const auto lanes = make_evaluator_in_lanes<8>(model, formula);
  if (lanes.call == nullptr) return -1;
  const auto one = make_evaluator<double>(model, formula);
  std::vector<Pack<8>> states(model->initial().size()), together(results);
  std::vector<std::vector<double>> rows(8);
  for (std::size_t lane = 0; lane < 8; ++lane)
    for (std::size_t k = 0; k < states.size(); ++k) {
      rows[lane].push_back(model->initial()[k].value() + 0.01 * static_cast<double>(lane * (k % 5)));
      states[k].set(lane, rows[lane][k]);
    }
  lanes.call(lanes.context, Pack<8>(0.0), states.data(), together.data());
  int differ = 0;
  for (std::size_t lane = 0; lane < 8; ++lane) {
    std::vector<double> alone(results);
    one.call(one.context, 0, rows[lane].data(), alone.data());
    for (std::size_t k = 0; k < results; ++k)
      if (alone[k] != together[k][lane]) ++differ;
  }
  return differ;
}

TEST(BeadRodLanes, EveryLaneHasTheBitsOfItsStateAlone) {
  for (const auto& [system, parameters] :
       {std::pair<const char*, Assignments>{"n-pendulum", {{"bobs", "16"}}},
        {"n-pendulum", {{"bobs", "3"}, {"dimension", "3"}}},
        {"chain-molecule", {{"cutoff", "0"}, {"strength", "1"}}}}) {
    const auto model = systems().get(system, "system").make(parameters);
    EXPECT_EQ(lanes_that_differ(model, Formula::hamiltonian, 1), 0) << system;
    EXPECT_EQ(lanes_that_differ(model, Formula::invariants, model->invariants().size()), 0) << system;
  }
}

TEST(BeadRodLanes, NoneAreOfferedWherePairsAreSorted) {
  const auto model = systems().get("chain-molecule", "system").make({{"cutoff", "3"}, {"strength", "1"}});
  EXPECT_EQ(lanes_that_differ(model, Formula::hamiltonian, 1), -1);
  EXPECT_EQ(make_evaluator_in_lanes<8>(model, Formula::holonomic).call, nullptr);
}
}  // namespace
