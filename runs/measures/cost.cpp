// What the steps of a run cost, counted, where no clock is read.
#include <cmath>

#include <pfaff/runs/measure.hpp>
#include <pfaff/runs/support/counter_fields.hpp>

namespace {
using namespace pfaff;

struct Cost {
  [[nodiscard]] std::vector<Column> columns(const Model& /*model*/) const {
    std::vector<Column> columns;
    for (const CounterField& field : counter_fields) columns.push_back({std::string(field.per_step)});
    for (Column& column : columns) column.digits = 6;
    return columns;
  }
  template <class T>
  struct Work {
    Work(const Cost& /*measure*/, const Measured<T>& /*run*/) {}
  };
  template <class T>
  std::vector<Row> end(const Measured<T>& run, Work<T>& /*work*/) const {
    const Counters& counters = run.now.counters();
    Row row;
    for (const CounterField& field : counter_fields)
      row.push_back(static_cast<double>(counters.*field.count) / static_cast<double>(counters.steps));
    return {row};
  }

  // A step of RK4 has four stages. Each iteration of a Gauss method evaluates all of its stages.
  static std::vector<MeasureControl> controls() {
    const auto of = [](const char* system, const char* method) {
      return MeasureControl::of(system, method, "0.1", 10);
    };
    // Counts are whole numbers.
    return {of("harmonic-oscillator", "rk4").gives("rhs_per_step", 4, 0),
            of("kepler", "rk4").gives("rhs_per_step", 4, 0),
            of("kepler", "leap-frog").does_not_give("rhs_per_step", 4, 0)};
  }
};

const Measure<Cost> registered{
    {.name = "cost",
     .title = "What a step costs: evaluations, iterations and factorisations",
     .description =
         "Right-hand sides, Jacobians, iterations of implicit solves and factorisations of matrices, "
         "of the whole run over the number of its steps. Times are measured apart, in cost.csv, since "
         "they belong to a machine.",
     .over = Over::step}};
}  // namespace
