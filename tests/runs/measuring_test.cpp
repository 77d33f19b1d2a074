// Measures as plug-ins: what they are shown, and that a fault of one is its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include <pfaff/core/errors/budget.hpp>

#include "explosion.hpp"
#include "measured_table.hpp"

namespace pfaff {
namespace {

using ::testing::HasSubstr;

// What a measure of a test does at a look.
enum class Deed { nothing, throws, is_not_finite, few_cells, ends, looks_back, looks_on, goes_beside };

// Looks at every third step, at all blocks, and at the end.
struct Trial {
  Deed deed = Deed::nothing;
  [[nodiscard]] std::vector<Column> columns(const Model& /*model*/) const { return {{"x"}, {"seen"}}; }
  template <class T>
  [[nodiscard]] std::vector<std::int64_t> looks(const Measured<T>& run) const {
    if (deed == Deed::looks_back) return {3, 2};
    if (deed == Deed::looks_on) return {3, run.steps + 1};
    std::vector<std::int64_t> numbers;
    for (std::int64_t step = 0; step <= run.steps; step += 3) numbers.push_back(step);
    return numbers;
  }
  template <class T>
  struct Work {
    T seen{0};
    Integration<T> beside;  // from twice as far
    Work(const Trial& /*trial*/, const Measured<T>& run) : beside(run.start.beside(twice(run))) {}
    static std::vector<T> twice(const Measured<T>& run) {
      std::vector<T> z(run.start.state().begin(), run.start.state().end());
      for (T& x : z) x *= T(2);
      return z;
    }
  };
  template <class T>
  void block(const Measured<T>& /*run*/, const Block<T>& block, Work<T>& work) const {
    for (std::size_t row = 0; row < block.rows; ++row) work.seen += block.states.at(row, 0);
  }
  template <class T>
  bool look(const Measured<T>& /*run*/, const RunState<T>& at, Work<T>& work, Row& row) const {
    const bool now = at.step == 6;
    if (now && deed == Deed::throws) throw std::runtime_error("no more");
    if (now && deed == Deed::ends) return false;
    if (deed == Deed::goes_beside) carry_to(at.step, work.beside);
    row = {now && deed == Deed::is_not_finite ? T(std::nan("")) : at.z[0], work.seen};
    if (now && deed == Deed::few_cells) row.pop_back();
    return true;
  }
  template <class T>
  std::vector<Row> end(const Measured<T>& run, Work<T>& work) const {
    return {{T(static_cast<double>(run.steps)), work.seen}};
  }
};

std::vector<MeasuredTable> tables_of(const std::vector<Deed>& deeds, std::int64_t steps = 10,
                                     const std::shared_ptr<const Model>& model = nullptr) {
  static const Measure<Trial> plugin{{.name = "trial", .title = ""}};
  const auto run = model == nullptr
                       ? integrate("harmonic-oscillator", {}, "verlet", {}, {.step = "0.1"})
                       : integrate<double>(model, integrators().get("rk4", "integrator").make({}), 0.125);
  std::vector<std::unique_ptr<MeasureInstance>> trials;
  std::vector<const MeasureInstance*> asked;
  for (const Deed deed : deeds)
    asked.push_back(
        trials.emplace_back(std::make_unique<detail::MeasureWith<Trial>>(plugin, Trial{deed})).get());
  return measured(run, steps, asked);
}

// Looks come after the blocks that lead to them, and the start is seen too.
TEST(Measuring, ShowsTheStatesOfTheRun) {
  const MeasuredTable table = tables_of({Deed::nothing}).front();
  ASSERT_EQ(table.lines.size(), 5U);  // after 0, 3, 6 and 9 steps, and at the end
  auto run = integrate("harmonic-oscillator", {}, "verlet", {}, {.step = "0.1"});
  double seen = run.state()[0];
  for (std::int64_t step = 0; step <= 10; ++step) {
    if (step > 0) {
      EXPECT_TRUE(run.steps(1).reached());
      seen += run.state()[0];
    }
    if (step % 3 != 0) continue;
    const MeasuredTable::Line& line = table.lines[static_cast<std::size_t>(step / 3)];
    EXPECT_EQ(line.step, step);
    EXPECT_EQ(testing::number(line, 0), run.state()[0]);
    EXPECT_EQ(testing::number(line, 1), seen);
  }
  EXPECT_EQ(table.lines.back().step, 10);
  EXPECT_EQ(testing::number(table.lines.back(), 0), 10);
  EXPECT_EQ(testing::number(table.lines.back(), 1), seen);
  EXPECT_EQ(table.ended, "");
}

TEST(Measuring, AFaultOfAMeasureIsItsOwn) {
  const auto tables = tables_of({Deed::nothing, Deed::throws, Deed::is_not_finite, Deed::few_cells,
                                 Deed::ends, Deed::looks_back, Deed::looks_on});
  const auto alone = tables_of({Deed::nothing}).front();
  EXPECT_EQ(tables[0].lines.size(), 5U);
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_EQ(testing::number(tables[0].lines[k], 1), testing::number(alone.lines[k], 1));
  EXPECT_EQ(tables[1].lines.size(), 2U);
  EXPECT_EQ(tables[1].ended, "no more");
  ASSERT_EQ(tables[2].lines.size(), 5U);
  EXPECT_EQ(text_of(tables[2].lines[2].cells[0], tables[2].columns[0]), "");
  EXPECT_NE(text_of(tables[2].lines[3].cells[0], tables[2].columns[0]), "");
  EXPECT_EQ(tables[3].lines.size(), 2U);
  EXPECT_THAT(tables[3].ended, HasSubstr("expected a row of 2 cells, got 1"));
  EXPECT_EQ(tables[4].lines.size(), 2U);
  EXPECT_THAT(tables[4].ended, HasSubstr("the measure has no row from t = "));
  EXPECT_EQ(tables[5].lines.size(), 0U);
  EXPECT_THAT(tables[5].ended, HasSubstr("in increasing order"));
  EXPECT_THAT(tables[6].ended, HasSubstr("expected numbers of steps from 0 to the "));
}

// Looks at every fourth step, leaves no row there and two at the end.
struct AtTheEnd {
  [[nodiscard]] std::vector<Column> columns(const Model& /*model*/) const { return {{"x"}}; }
  template <class T>
  [[nodiscard]] std::vector<std::int64_t> looks(const Measured<T>& /*run*/) const {
    return {0, 4, 8};
  }
  template <class T>
  struct Work {
    std::shared_ptr<const ReferenceSolution> solution;
    Work(const AtTheEnd& /*measure*/, const Measured<T>& run) : solution(run.solution.to(Quad(1))) {}
  };
  template <class T>
  bool look(const Measured<T>& /*run*/, const RunState<T>& /*at*/, Work<T>& /*work*/, Row& row) const {
    row.clear();
    return true;
  }
  template <class T>
  std::vector<Row> end(const Measured<T>& /*run*/, Work<T>& work) const {
    return {{work.solution->at(Quad(1))[0]}, {2.0}};
  }
};

// They stand behind the last look: no step is taken behind that. The solution is that of the run.
TEST(Measuring, LeavesSeveralRowsAtTheEnd) {
  static const Measure<AtTheEnd> plugin{{.name = "at-the-end", .title = ""}};
  const auto run = integrate("harmonic-oscillator", {}, "verlet", {}, {.step = "0.1"});
  const auto measure = plugin.make({});
  const MeasuredTable table = measured(run, 100, {measure.get()}).front();
  ASSERT_EQ(table.lines.size(), 2U);
  EXPECT_EQ(table.lines[0].step, 8);
  EXPECT_EQ(table.lines[1].step, 8);
  const double q = run.state()[0], p = run.state()[1];
  EXPECT_NEAR(static_cast<double>(std::get<Quad>(table.lines[0].cells[0])),
              q * std::cos(1.0) + p * std::sin(1.0), 1e-15);  // the last digit of the right-hand side
  EXPECT_EQ(std::get<double>(table.lines[1].cells[0]), 2);
}

// A shorter solution is the one that is there; a longer one is made anew, and both agree.
TEST(SharedSolution, IsMadeOnce) {
  const auto run = integrate("pendulum", {}, "verlet", {}, {.step = "0.1"});
  const SharedSolution solution(run.model(), Quad(0), {Quad(1), Quad(0)});
  const auto first = solution.to(Quad(2));
  EXPECT_EQ(solution.to(Quad(1)), first);
  const auto longer = solution.to(Quad(3));
  EXPECT_NE(longer, first);
  EXPECT_EQ(solution.to(Quad(2)), longer);
  EXPECT_LT(abs(first->at(Quad(1.5))[0] - longer->at(Quad(1.5))[0]), Quad(1e-28));
  EXPECT_TRUE(solution.to(Quad(-1))->covers(Quad(-1)));
}

// A state beside the run may leave the range of numbers before the run does.
TEST(Measuring, TablesSayWhatEndedAStateBesideTheRun) {
  const auto tables = tables_of({Deed::nothing, Deed::goes_beside}, 9, testing::explosion());
  EXPECT_GT(tables[0].lines.size(), tables[1].lines.size());
  EXPECT_GT(tables[1].lines.size(), 1U);
  EXPECT_THAT(tables[1].ended, HasSubstr("beside the run the state or the structure left the range"));
}

// Where the run fails, tables end and say so.
TEST(Measuring, TablesEndWhereTheRunDoes) {
  const MeasuredTable table = tables_of({Deed::nothing}, 1000, testing::explosion()).front();
  EXPECT_GT(table.lines.size(), 2U);
  EXPECT_LT(table.lines.size(), 20U);
  EXPECT_THAT(table.ended, HasSubstr("left the range of numbers at t = "));
}

// So they do where the solution ends, x' = x^2 at t = 1, before the steps of the method do. The control: over
// the half of that time the same vector has a row.
TEST(Measuring, AFrequencySaysThatItsSolutionEnds) {
  const auto run =
      integrate<double>(testing::explosion(), integrators().get("rk4", "integrator").make({}), 0.125);
  const auto frequency = measure_asked_for("frequency(x=cos(x), y=sin(x))");
  const MeasuredTable ended = measured(run, 9, {frequency.get()}).front();
  EXPECT_TRUE(ended.lines.empty());
  EXPECT_THAT(ended.ended, HasSubstr("the solution was found up to t = "));
  const MeasuredTable whole = measured(run, 4, {frequency.get()}).front();
  EXPECT_EQ(whole.lines.size(), 1U);
  EXPECT_EQ(whole.ended, "");

  // The row stands at the end of what was compared, also beside a measure that goes on to the end of the run.
  const auto beginning = measure_asked_for("frequency(x=q, y=p, time=0.25)"),
             drift = measure_asked_for("drift");
  const auto both = measured(integrate("harmonic-oscillator", {}, "verlet", {}, {.step = "0.125"}), 8,
                             {beginning.get(), drift.get()});
  ASSERT_EQ(both[0].lines.size(), 1U) << both[0].ended;
  EXPECT_EQ(both[0].lines[0].step, 2);
  EXPECT_EQ(both[1].lines[0].step, 8);
}

TEST(Measuring, EndsWithTheBudget) {
  const Budget budget({.steps = 5});
  EXPECT_THROW((void)tables_of({Deed::nothing}), BudgetSpent);
}

TEST(Measuring, CellsAreWrittenWithTheDigitsOfTheirColumns) {
  EXPECT_EQ(text_of(Cell(0.1), {.name = "all"}), "0.10000000000000001");
  EXPECT_EQ(text_of(Cell(0.1), {.name = "three", .digits = 3}), "0.1");
  EXPECT_EQ(text_of(Cell(Quad(1) / Quad(3)), {.name = "all"}).size(), 38U);  // "0." and 36 digits
  EXPECT_EQ(text_of(Cell(std::numeric_limits<double>::infinity()), {.name = "x"}), "");
  EXPECT_EQ(text_of(Cell(std::string("by, and")), {.name = "x", .kind = Column::Kind::text}), "by, and");
}

// Its columns have the names that it is given; a look leaves a text in the first of them.
struct Named {
  std::vector<std::string> names;
  [[nodiscard]] std::vector<Column> columns(const Model& /*model*/) const {
    if (names.empty()) throw std::runtime_error("no\nnames");
    std::vector<Column> columns;
    for (const std::string& name : names) columns.push_back({name});
    return columns;
  }
  template <class T>
  [[nodiscard]] std::vector<std::int64_t> looks(const Measured<T>& /*run*/) const {
    return {0, 4};
  }
  template <class T>
  struct Work {
    Work(const Named& /*measure*/, const Measured<T>& /*run*/) {}
  };
  template <class T>
  bool look(const Measured<T>& /*run*/, const RunState<T>& at, Work<T>& /*work*/, Row& row) const {
    row[0] = 1.0;
    if (at.step > 0) row[0] = std::string("even");
    return true;
  }
};

TEST(Measuring, RefusesColumnsThatCannotStandInATable) {
  static const Measure<Named> plugin{{.name = "named", .title = ""}};
  const auto model = systems().get("harmonic-oscillator", "system").make({});
  const auto method = integrators().get("verlet", "integrator").make({});
  const auto refused = [&](const std::vector<std::string>& names) {
    return detail::MeasureWith<Named>(plugin, Named{names}).refuses(*model, *method);
  };
  EXPECT_EQ(refused({"x", "y"}), "");
  EXPECT_EQ(refused({"x", "x"}), "named has two columns 'x'");
  EXPECT_EQ(refused({"x", "step"}),
            "named has a column 'step', which every table of a measure has before its own");
  EXPECT_EQ(refused({""}), "named has a column without a name");
  EXPECT_EQ(refused({}), "named fails: no names");

  const detail::MeasureWith<Named> texts(plugin, Named{{"x"}});
  const auto tables =
      measured(integrate("harmonic-oscillator", {}, "verlet", {}, {.step = "0.1"}), 10, {&texts});
  EXPECT_EQ(tables[0].lines.size(), 1U);
  EXPECT_EQ(tables[0].ended, "column x: expected a number, got 'even'");
}

TEST(Measuring, RefusesWhatIsNoMeasure) {
  const auto words_of = [](const std::string& text) -> std::string {
    try {
      (void)measure_asked_for(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_THAT(words_of("poincare-lop"), HasSubstr("did you mean 'poincare-loop'"));
  EXPECT_THAT(words_of("poincare-loop(look=3)"), HasSubstr("'looks'"));
  EXPECT_THAT(words_of("poincare-loop(looks=0)"), HasSubstr("1"));
  EXPECT_THAT(words_of("poincare-loop(looks"), HasSubstr("measure"));
}

}  // namespace
}  // namespace pfaff
