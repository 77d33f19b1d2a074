// Blocks of states: what a stepper writes into them is, bit by bit, what steps taken one row after the other
// give, with every registered method; and how they end.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include <pfaff/core/errors/budget.hpp>
#include <pfaff/core/facets/block.hpp>
#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/runs/motion.hpp>
#include <pfaff/verify/falsification/many_steps.hpp>

#include "../formula_values.hpp"
#include "explosion.hpp"

namespace pfaff {
namespace {

template <class T>
std::vector<T> row_of(const Block<T>& block, std::size_t row) {
  std::vector<T> z(block.states.components());
  block.states.get(row, z);
  return z;
}

template <class T>
Block<T> block_for(const Model& model, std::int64_t stride, const T& h, std::size_t capacity) {
  Block<T> block(static_cast<std::size_t>(model.dimension()), capacity);
  block.stride = block.first = stride;
  block.h = h;
  return block;
}

// True where both ways of stepping end alike after the same steps with the same states. `nudge` is a fault:
// what is added to a number of the first row that is compared.
template <class T>
bool same_bits(const MethodInstance& method, const std::shared_ptr<const Model>& model, const T& h,
               std::size_t rows, std::int64_t stride, bool nudge = false) {
  const auto in_blocks = method.stepper(model, T()), one_by_one = method.stepper(model, T());
  std::vector<T> z = testing::initial_state<T>(*model), expected = z;
  auto block = block_for<T>(*model, stride, h, rows);
  std::int64_t completed = -1, counted = 0;
  const Status status = in_blocks->fill(block, rows, z, completed);
  if (nudge) const_cast<T*>(block.states.tile(0))[0] *= T(1) + std::numeric_limits<T>::epsilon();
  Status last = Status::converged;
  std::size_t row = 0;
  for (; row < rows && last == Status::converged; ++row) {
    std::int64_t taken = 0;
    last = one_by_one->advance(T(0), counted, h, stride, expected, taken);
    counted += taken;
    if (last != Status::converged) break;
    if (row >= block.rows || row_of(block, row) != expected) return false;
  }
  return status == last && block.rows == row && completed == counted && z == expected &&
         in_blocks->counters().steps == one_by_one->counters().steps;
}

template <class T>
void every_method_gives_the_bits_of_single_rows() {
  int compared = 0;
  for (const MethodPlugin* plugin : integrators().all())
    for (const Assignments& parameters : plugin->instances(false)) {
      const auto method = plugin->make(parameters);
      int systems_left = 4;
      for (const SystemPlugin* system : systems().all()) {
        const auto model = motion_for(*method, system->make({}));
        if (!method->refuses(*model).empty() || model->dimension() > 16) continue;
        if (systems_left-- == 0) break;
        const T h = T(Real::fraction(1, 50));
        EXPECT_TRUE(same_bits<T>(*method, model, h, 11, 1)) << method->called() << " on " << model->name();
        EXPECT_TRUE(same_bits<T>(*method, model, h, 3, 2)) << method->called() << " on " << model->name();
        ++compared;
      }
    }
  EXPECT_GT(compared, 200);
}
TEST(Blocks, EveryMethodGivesTheBitsOfSingleRowsInDouble) {
  every_method_gives_the_bits_of_single_rows<double>();
}
TEST(Blocks, EveryMethodGivesTheBitsOfSingleRowsInQuad) {
  every_method_gives_the_bits_of_single_rows<Quad>();
}
TEST(Blocks, ALastBitThatDiffersIsSeen) {
  const auto model = testing::model_named("kepler");
  const auto method = integrators().get("verlet", "integrator").make({});
  EXPECT_TRUE(same_bits<double>(*method, model, 0.01, 11, 1));
  EXPECT_FALSE(same_bits<double>(*method, model, 0.01, 11, 1, true));
}

// Several steps as one have the times, the states and the counted steps of blocks too.
TEST(Blocks, OfSeveralStepsAsOne) {
  const auto model = testing::model_named("kepler");
  const auto leap_frog = integrators().get("leap-frog", "integrator").make({});
  for (const std::int64_t stride : {1, 2})
    EXPECT_TRUE(same_bits<double>(ManySteps(*leap_frog, 3), model, 0.03, 5, stride)) << stride;
}

TEST(Blocks, RowsHaveTheirTimesAndSteps) {
  Block<double> block(3, 20);
  block.first = 5, block.stride = 5, block.t0 = 1, block.h = 0.25, block.rows = 20;
  EXPECT_EQ(block.step(3), 20);
  EXPECT_EQ(block.time(3), 6);
  EXPECT_EQ(block.row_of(20), 3U);
  for (const std::int64_t none : {0, 4, 21, 105}) EXPECT_EQ(block.row_of(none), 20U) << none;
  block.times.assign(20, 7);
  EXPECT_EQ(block.time(3), 7);
}

template <class T>
void tiles_hold_rows() {
  constexpr std::size_t components = 3, rows = 21;
  Tiles<T> tiles(components, rows);
  for (std::size_t row = 0; row < rows; ++row) {
    std::array<T, components> z;
    for (std::size_t i = 0; i < components; ++i) z[i] = T(static_cast<double>(10 * row + i));
    tiles.put(row, z.data());
  }
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t i = 0; i < components; ++i)
      EXPECT_EQ(tiles.at(row, i), T(static_cast<double>(10 * row + i)));
  // Components of a tile stand one behind the other.
  EXPECT_EQ(tiles.tile(1)[0], T(10.0 * lanes<T>));
  EXPECT_EQ(tiles.tile(1)[2 * lanes<T>], T(10.0 * lanes<T> + 2));
  tiles.fill_behind(19);
  constexpr std::size_t last = lanes<T> == 1 ? 18 : 20;  // of the tile in which row 18 lies
  EXPECT_EQ(tiles.at(last, 1), tiles.at(18, 1));

  EXPECT_EQ(tiles.first_not_finite(19), 19U);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (const std::size_t row : {18U, 9U, 8U, 0U}) {
      const std::array<T, components> wrong{T(1), T(bad), T(2)}, right{T(1), T(1), T(2)};
      tiles.put(row, wrong.data());
      EXPECT_EQ(tiles.first_not_finite(19), row);
      EXPECT_EQ(tiles.first_not_finite(row), row);  // the rows before it are all right
      tiles.put(row, right.data());
    }
}
TEST(Blocks, TilesHoldRows) {
  tiles_hold_rows<double>();
  tiles_hold_rows<Quad>();
}
// Large numbers, whose sum is beyond the range, are finite each.
TEST(Blocks, LargeNumbersAreFinite) {
  Tiles<double> tiles(2, 8);
  const std::array<double, 2> z{1.7e308, 1.7e308};
  for (std::size_t row = 0; row < 8; ++row) tiles.put(row, z.data());
  EXPECT_EQ(tiles.first_not_finite(8), 8U);
}

TEST(Blocks, EndWithTheLastFiniteRow) {
  const auto model = testing::explosion();
  const auto method = integrators().get("rk4", "integrator").make({});
  for (const std::int64_t stride : {1, 3}) {
    EXPECT_TRUE(same_bits<double>(*method, model, 0.125, 64, stride)) << stride;
    const auto stepper = method->stepper(model, 0.0);
    auto block = block_for<double>(*model, stride, 0.125, 64);
    std::vector<double> z{1};
    std::int64_t completed = 0;
    EXPECT_EQ(stepper->fill(block, 64, z, completed), Status::non_finite);
    ASSERT_GT(block.rows, 0U);
    ASSERT_LT(block.rows, 64U);
    EXPECT_TRUE(std::isfinite(z[0]));
    EXPECT_EQ(z, row_of(block, block.rows - 1));
    EXPECT_EQ(completed, static_cast<std::int64_t>(block.rows) * stride);
  }
}

// A budget that ends between two rows leaves the rows before it, and the state that was reached.
TEST(Blocks, EndWithTheirBudget) {
  const auto model = testing::model_named("henon-heiles");
  const auto method = integrators().get("gauss", "integrator").make({{"stages", "3"}});
  for (const std::int64_t allowed : {1, 7, 12}) {
    const auto stepper = method->stepper(model, 0.0), other = method->stepper(model, 0.0);
    auto block = block_for<double>(*model, 3, 0.1, 8);
    std::vector<double> z = testing::initial_state<double>(*model), expected = z;
    std::int64_t completed = 0, taken = 0;
    {
      const Budget budget({.steps = allowed});
      EXPECT_THROW((void)stepper->fill(block, 8, z, completed), BudgetSpent);
    }
    EXPECT_EQ(completed, allowed);
    EXPECT_EQ(block.rows, static_cast<std::size_t>(allowed / 3));
    EXPECT_EQ(other->advance(0.0, 0, 0.1, allowed, expected, taken), Status::converged);
    EXPECT_EQ(z, expected);
  }
}

}  // namespace
}  // namespace pfaff
