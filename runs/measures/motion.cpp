// What a motion looks like early and late: all steps of some stretches of a run, beside the exact motion.
#include <cmath>
#include <limits>

#include <pfaff/runs/measure.hpp>
#include <pfaff/runs/stretches.hpp>
#include <pfaff/runs/support/with_unit.hpp>

namespace {
using namespace pfaff;

struct MotionOfRun {
  std::string x, y;
  int stretches = 5, most = 400;
  bool exact = true;

  static std::vector<Parameter> parameters() {
    return {text_parameter(&MotionOfRun::x, "x", "COORDINATE", "to the right; none: found from the units"),
            text_parameter(&MotionOfRun::y, "y", "COORDINATE", "upwards, where x is named"),
            parameter(&MotionOfRun::stretches, "stretches", "", 1, 100, "of consecutive steps"),
            parameter(&MotionOfRun::most, "most", "", 1, 1000000, "steps of a stretch"),
            parameter(&MotionOfRun::exact, "exact", "whether the exact motion is beside")};
  }
  [[nodiscard]] std::vector<Column> columns(const Model& /*model*/) const {
    std::vector<Column> all{{.name = "x axis", .kind = Column::Kind::text},
                            {.name = "y axis", .kind = Column::Kind::text},
                            {.name = "stretch", .digits = 3}};
    for (const char* name : {"x", "y", "exact_x", "exact_y", "exact_x_between", "exact_y_between"})
      all.push_back({.name = name, .digits = 8});
    return all;
  }
  [[nodiscard]] std::string refuses(const Model& model, const MethodInstance& /*method*/) const {
    if (model.dimension() < 2) return "needs two coordinates, of which " + model.name() + " has one";
    if (x.empty() != y.empty()) return "needs both or neither of x and y";
    (void)plane_of(model, x, y);
    return "";
  }
  template <class T>
  [[nodiscard]] auto solution_of(const Measured<T>& run, std::int64_t steps) const {
    return exact ? run.solution.to(run.duration(static_cast<double>(steps))) : nullptr;
  }
  template <class T>
  [[nodiscard]] std::vector<std::int64_t> looks(const Measured<T>& run) const {
    const std::int64_t longest = std::min<std::int64_t>(run.steps, most);
    const std::int64_t turn =
        steps_of_a_turn(run, plane_of(*run.start.model(), x, y), solution_of(run, longest).get(), longest);
    return pfaff::stretches(run.steps, turn, stretches, most);
  }
  template <class T>
  struct Work {
    Plane plane;
    std::shared_ptr<const ReferenceSolution> solution;  // null where it is not asked for
    std::int64_t before = -1;                           // the step looked at last
    int stretch = 0;
    Work(const MotionOfRun& measure, const Measured<T>& run)
        : plane(plane_of(*run.start.model(), measure.x, measure.y)),
          solution(measure.solution_of(run, run.steps)) {}
  };
  template <class T>
  bool look(const Measured<T>& run, const RunState<T>& at, Work<T>& work, Row& row) const {
    const bool begins = at.step != std::exchange(work.before, at.step) + 1 || work.stretch == 0;
    if (begins) ++work.stretch;
    const std::size_t first = work.plane.first, second = work.plane.second;
    const std::vector<Coordinate>& all = run.start.model()->coordinates();
    row = {with_unit(all[first].name, all[first].unit), with_unit(all[second].name, all[second].unit),
           double(work.stretch), at.z[first], at.z[second]};
    row.resize(columns(*run.start.model()).size(), std::numeric_limits<double>::quiet_NaN());
    const auto put_exact = [&](std::size_t column, double steps) {
      const Quad t = run.time_after(steps);
      if (work.solution == nullptr || !work.solution->covers(t)) return;
      const std::vector<Quad> solved = work.solution->at(t);
      row[column] = static_cast<T>(solved[first]), row[column + 1] = static_cast<T>(solved[second]);
    };
    const auto steps = static_cast<double>(at.step);
    if (!begins) put_exact(7, steps - 0.5);
    put_exact(5, steps);
    return true;
  }

  // The implicit midpoint rule turns the oscillator, by another angle than the motion does.
  static std::vector<MeasureControl> controls() {
    constexpr double h = 0.1, steps = 500, known = 5e-8;  // eight digits are written
    const MeasureControl run = MeasureControl::of("harmonic-oscillator", "implicit-midpoint", "0.1", 500);
    return {run.gives("x", std::cos(steps * 2 * std::atan(h / 2)), known),
            run.gives("exact_x", std::cos(steps * h), known),
            run.does_not_give("x", std::cos(steps * h), known)};
  }
};

const Measure<MotionOfRun> registered{
    {.name = "motion",
     .title = "What the motion looks like early and late, beside the exact one",
     .description =
         "Every step of some stretches of the run, from its start to its end, in the plane of two "
         "coordinates, and the solution at the same times and half a step before. The first stretch ends "
         "where the track has turned once; all have as many steps. The solution is the exact one where the "
         "system has it, otherwise a Taylor series in quad; its cells are empty where that ends.",
     .version = 2,
     .usual = true}};
}  // namespace
