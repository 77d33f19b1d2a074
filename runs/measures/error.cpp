// How far a run is from the solution of its problem, an exact one where the system has it.
#include <cmath>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/runs/measure.hpp>
#include <pfaff/runs/support/linear_step.hpp>
#include <pfaff/runs/watched/solution_errors.hpp>

namespace {
using namespace pfaff;

struct ErrorOfRun {
  int count = 200;

  static std::vector<Parameter> parameters() {
    return {parameter(&ErrorOfRun::count, "looks", "", 1, 1000000, "at steps of the run")};
  }
  // What is conserved has its drift for an error.
  [[nodiscard]] std::vector<Column> columns(const Model& model) const {
    std::vector<Column> columns{{.name = "error", .digits = 6}};
    for (const Invariant& i : model.invariants())
      if (i.behaviour != Behaviour::conserved)
        columns.push_back({.name = i.name + ":error", .unit = i.unit, .digits = 6});
    return columns;
  }
  template <class T>
  [[nodiscard]] std::vector<std::int64_t> looks(const Measured<T>& run) const {
    return evenly(run.steps, count);
  }
  template <class T>
  struct Work {
    std::shared_ptr<const ReferenceSolution> solution;
    SolutionErrors<T> errors;
    Problem<T> problem;
    std::vector<T> invariants;
    Work(const ErrorOfRun& /*measure*/, const Measured<T>& run)
        : solution(run.solution.to(run.duration(static_cast<double>(run.steps)))),
          errors(run.start.model(), *solution),
          problem(run.start.model()),
          invariants(run.start.model()->invariants().size()) {}
  };
  template <class T>
  bool look(const Measured<T>& run, const RunState<T>& at, Work<T>& work, Row& row) const {
    const Quad exact = run.time_after(static_cast<double>(at.step));
    if (!work.solution->covers(exact)) throw RunError(work.solution->ended());
    row = {static_cast<T>(work.errors(exact, at.z))};
    if (work.errors.changing().empty()) return true;
    work.problem.invariants(at.t, {at.z.begin(), at.z.end()}, work.invariants);
    for (const Quad& off : work.errors.of_invariants(work.invariants)) row.push_back(static_cast<T>(off));
    return true;
  }

  // Of the oscillator a step of RK4 is a turn that also shrinks. With the implicit midpoint rule it is a
  // turn, too fast or too slow.
  static std::vector<MeasureControl> controls() {
    constexpr double h = 0.1;
    constexpr int steps = 100;
    const std::complex<double> rk4 = factor_of_rk4({0, h});
    const double of_rk4 =
        std::abs(std::polar(std::pow(std::abs(rk4), steps), steps * (std::arg(rk4) - h)) - 1.0);
    const double of_midpoint = 2 * std::abs(std::sin(steps * (2 * std::atan(h / 2) - h) / 2));
    const auto of = [](const char* method) {
      return MeasureControl::of("harmonic-oscillator", method, "0.1", steps);
    };
    const double known = 1e-13;  // after a hundred steps, each with some roundings
    return {of("rk4").gives("error", of_rk4, known), of("rk4").does_not_give("error", 0, known),
            of("implicit-midpoint").gives("error", of_midpoint, known)};
  }
};

const Measure<ErrorOfRun> registered{{.name = "error",
                                      .title = "How far a run is from the solution of its problem",
                                      .description = "The distance of the state from the solution, over the "
                                                     "size of the solution, and by how much quantities "
                                                     "that change along the motion are off. The solution is "
                                                     "the exact one where the system has it, otherwise "
                                                     "a Taylor series in quad; the table ends where that "
                                                     "does. Every coordinate counts alike, whatever its "
                                                     "unit."}};
}  // namespace
