// Watchers that are taken off an integration, between its calls and while they look.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pfaff/runs/integrate.hpp>

#include "notes.hpp"

namespace pfaff {
namespace {

using ::testing::ElementsAre;
using testing::Notes;
using testing::state_of;

TEST(Unwatched, AWatcherIsTakenOffBetweenCallsAndMayEndBeforeTheIntegration) {
  auto run = integrate("kepler", {}, "verlet", {}, {.step = "0.1"});
  Notes stays;
  run.watch(stays, 2);
  {
    Notes leaves, never;
    run.watch(leaves);
    run.watch(leaves, 3);
    EXPECT_TRUE(run.steps(3).reached());
    run.unwatch(never);
    run.unwatch(leaves);
    EXPECT_THAT(leaves.steps, ElementsAre(0, 0, 1, 2, 3, 3));
  }
  EXPECT_TRUE(run.steps(3).reached());
  EXPECT_THAT(stays.steps, ElementsAre(0, 2, 4, 6));
  EXPECT_EQ(state_of(run), stays.states.back());
}

// Takes watchers off, itself among them, in the call of `in_end` or of look().
class Removes final : public Watcher<double> {
 public:
  Removes(Integration<double>& run, Watcher<double>& other, bool in_end)
      : run_(run), other_(other), in_end_(in_end) {}
  void start(const Integration<double>& /*run*/) override {}
  std::size_t end(const Integration<double>& /*run*/, const Block<double>& block) override {
    if (in_end_) remove();
    return block.rows;
  }
  void look(const Integration<double>& /*run*/, const Block<double>& /*block*/) override {
    ++looks;
    if (!in_end_) remove();
  }
  int looks = 0;

 private:
  void remove() {
    run_.unwatch(*this);
    run_.unwatch(other_);
  }
  Integration<double>& run_;
  Watcher<double>& other_;
  bool in_end_;
};

TEST(Unwatched, WatchersTakeOffThemselvesAndOthersWhileTheyLook) {
  for (const bool in_end : {true, false})
    for (const bool first : {true, false}) {
      auto run = integrate("kepler", {}, "verlet", {}, {.step = "0.1", .block_rows = 4});
      Notes other, stays;
      Removes removes(run, other, in_end);
      if (first) run.watch(removes);
      run.watch(other, 2);
      if (!first) run.watch(removes);
      run.watch(stays);
      EXPECT_TRUE(run.steps(10).reached());
      EXPECT_EQ(removes.looks, in_end ? 0 : 1);
      // What was shown to it before the removal, in the block at which it was removed, it has seen.
      if (in_end || first) {
        EXPECT_THAT(other.steps, ElementsAre(0));
      } else {
        EXPECT_THAT(other.steps, ElementsAre(0, 2, 4));
      }
      EXPECT_EQ(stays.steps.size(), 11U);
      EXPECT_EQ(state_of(run), stays.states.back());
    }
}

}  // namespace
}  // namespace pfaff
