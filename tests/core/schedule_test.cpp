// Schedules: each instruction once and after what it reads, the same bits as one instruction after the other,
// and few runs on long tapes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/operands.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/core/tape/schedule.hpp>

#include "../formula_values.hpp"
#include "random_formula.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::RandomFormula;
using pfaff::testing::shared;

// The slots of a tape, computed one after the other.
std::vector<double> one_by_one(const Tape& tape, double t, const std::vector<double>& z) {
  std::vector<double> x(tape.code.size());
  for (std::size_t k = 0; k < x.size(); ++k) {
    const Instruction& i = tape.code[k];
    const auto at = [&](int slot) { return x[static_cast<std::size_t>(slot)]; };
    const auto constant = [&](int index) { return tape.constants[static_cast<std::size_t>(index)]; };
    switch (i.operation) {
      case Operation::constant:
        x[k] = constant(i.a).value();
        break;
      case Operation::time:
        x[k] = t;
        break;
      case Operation::input:
        x[k] = z[static_cast<std::size_t>(i.a)];
        break;
      case Operation::negate:
        x[k] = -at(i.a);
        break;
      case Operation::add:
        x[k] = at(i.a) + at(i.b);
        break;
      case Operation::subtract:
        x[k] = at(i.a) - at(i.b);
        break;
      case Operation::multiply:
        x[k] = at(i.a) * at(i.b);
        break;
      case Operation::divide:
        x[k] = at(i.a) / at(i.b);
        break;
      case Operation::square_root:
        x[k] = std::sqrt(at(i.a));
        break;
      case Operation::exponential:
        x[k] = std::exp(at(i.a));
        break;
      case Operation::logarithm:
        x[k] = std::log(at(i.a));
        break;
      case Operation::sine:
        sine_cosine(at(i.a), x[k], x[k + 1]);
        break;
      case Operation::power:
        x[k] = pow(at(i.a), constant(i.b));
        break;
      case Operation::special:
        x[k] = special(static_cast<SpecialFunction>(i.c), at(i.a), at(i.b));
        break;
      case Operation::select:
        x[k] = at(i.a) > 0 ? at(i.b) : at(i.c);
        break;
      case Operation::solve: {
        const LinearSystem& system = tape.solves[static_cast<std::size_t>(i.a)];
        TapeSolver<double>(system.size)(system, x, k);
        break;
      }
      case Operation::cosine:
      case Operation::solve_next:
        break;
    }
  }
  return x;
}

std::size_t slots_without_constants(const Tape& tape) {
  return tape.code.size() - static_cast<std::size_t>(tape.time_begin);
}
Schedule schedule_of(const Tape& tape, ScheduleOrder order) {
  return {tape, static_cast<std::size_t>(tape.time_begin), tape.code.size(), order};
}

// Every slot is written once, after all that the instruction reads.
void expect_sound(const Tape& tape, const Schedule& schedule) {
  std::vector<int> written(tape.code.size(), 0);
  for (std::size_t k = 0; k < static_cast<std::size_t>(tape.time_begin); ++k) written[k] = 1;
  std::size_t next = 0;
  for (const OperationRun& run : schedule.runs) {
    ASSERT_EQ(run.begin, next);
    for (; next < run.end; ++next) {
      const auto slot = static_cast<std::size_t>(schedule.instructions[next].slot);
      const Instruction& i = tape.code[slot];
      ASSERT_EQ(i.operation, run.operation);
      ASSERT_EQ(group_start(tape.code, slot), slot);
      operands(i, tape.solves, [&](int read) { ASSERT_EQ(written[static_cast<std::size_t>(read)], 1); });
      for (std::size_t k = slot; k < tape.code.size() && group_start(tape.code, k) == slot; ++k) ++written[k];
    }
  }
  EXPECT_EQ(next, schedule.instructions.size());
  for (const int times : written) EXPECT_EQ(times, 1);
}

TEST(Schedule, WritesEverySlotOnceAndAfterWhatItReads) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const Tape tape = RandomFormula{seed, 3, 2, 40}.tape();
    expect_sound(tape, schedule_of(tape, ScheduleOrder::by_operation));
    expect_sound(tape, schedule_of(tape, ScheduleOrder::recorded));
  }
}

TEST(Schedule, GivesTheBitsOfOneInstructionAfterTheOther) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> number(-2, 2);
  for (unsigned seed = 0; seed < 50; ++seed) {
    const auto tape = shared(RandomFormula{seed, 3, 2, 40}.tape());
    Replay<double> replay(tape);
    for (int point = 0; point < 4; ++point) {
      const double t = number(random);
      const std::vector<double> z{number(random), number(random), number(random)};
      std::vector<double> outputs(2);
      replay(t, z.data(), outputs.data());
      EXPECT_EQ(replay.slots(), one_by_one(*tape, t, z)) << seed;
    }
  }
}

TEST(Schedule, OfScalarsThatRecordIsTheOrderOfTheTape) {
  EXPECT_EQ(detail::schedule_order<double>, ScheduleOrder::by_operation);
  EXPECT_EQ((detail::schedule_order<Dual<double, 1>>), ScheduleOrder::by_operation);
  EXPECT_EQ(detail::schedule_order<Recorded>, ScheduleOrder::recorded);
  EXPECT_EQ((detail::schedule_order<Dual<Recorded, 1>>), ScheduleOrder::recorded);
  const Tape tape = RandomFormula{3, 3, 2, 40}.tape();
  const Schedule schedule = schedule_of(tape, ScheduleOrder::recorded);
  EXPECT_TRUE(std::is_sorted(schedule.instructions.begin(), schedule.instructions.end(),
                             [](const auto& a, const auto& b) { return a.slot < b.slot; }));
}

TEST(Schedule, OfLongTapesHasFewRuns) {
  const auto model = systems().get("fermi-pasta-ulam-tsingou", "system").make({{"n", "64"}});
  const Tape& tape = *model->tape(Formula::field);
  ASSERT_GT(slots_without_constants(tape), 400U);
  EXPECT_LT(schedule_of(tape, ScheduleOrder::by_operation).runs.size(), 20U);
  EXPECT_GT(schedule_of(tape, ScheduleOrder::recorded).runs.size(), 200U);  // the control
}

}  // namespace
