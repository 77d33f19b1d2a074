// What a motion looks like early and late: all steps of some stretches of a run, beside the exact motion.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <pfaff/runs/measure.hpp>
#include <pfaff/runs/support/plane.hpp>
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
    return {{.name = "x axis", .kind = Column::Kind::text},
            {.name = "y axis", .kind = Column::Kind::text},
            {.name = "stretch", .digits = 3},
            {.name = "x", .digits = 8},
            {.name = "y", .digits = 8},
            {.name = "exact_x", .digits = 8},
            {.name = "exact_y", .digits = 8},
            {.name = "exact_x_between", .digits = 8},
            {.name = "exact_y_between", .digits = 8}};
  }
  [[nodiscard]] std::string refuses(const Model& model, const MethodInstance& /*method*/) const {
    if (model.dimension() < 2)
      return "needs a system of two coordinates, of which " + model.name() + " has one";
    if (x.empty() != y.empty()) return "needs both or neither of x and y";
    (void)plane_of(model, x, y);
    return "";
  }

  // Stretches lie as far apart as they are long, or there is one, which begins with the run.
  template <class T>
  [[nodiscard]] std::vector<std::int64_t> looks(const Measured<T>& run) const {
    std::int64_t length = one_turn(run);
    const std::int64_t count = std::clamp<std::int64_t>(run.steps / (2 * length), 1, stretches);
    if (count == 1) length = std::min<std::int64_t>(run.steps, most);
    std::vector<std::int64_t> found;
    for (std::int64_t k = 0; k < count; ++k) {
      const std::int64_t begin = count == 1 ? 0 : (run.steps - length) * k / (count - 1);
      for (std::int64_t step = begin; step <= begin + length; ++step) found.push_back(step);
    }
    return found;
  }
  template <class T>
  struct Work {
    std::pair<std::size_t, std::size_t> plane;
    std::shared_ptr<const ReferenceSolution> solution;  // null where it is not asked for
    std::int64_t before = -1;                           // the step looked at last
    int stretch = 0;
    Work(const MotionOfRun& measure, const Measured<T>& run)
        : plane(plane_of(*run.start.model(), measure.x, measure.y)) {
      if (measure.exact)
        solution = run.solution.to(Quad(static_cast<double>(run.steps)) * Quad(run.start.step()));
    }
  };
  template <class T>
  bool look(const Measured<T>& run, const RunState<T>& at, Work<T>& work, Row& row) const {
    const bool begins = at.step != work.before + 1 || work.stretch == 0;
    if (begins) ++work.stretch;
    work.before = at.step;
    const std::size_t first = work.plane.first, second = work.plane.second;
    const std::vector<Coordinate>& all = run.start.model()->coordinates();
    row = {with_unit(all[first].name, all[first].unit), with_unit(all[second].name, all[second].unit),
           double(work.stretch), at.z[first], at.z[second]};
    row.resize(columns(*run.start.model()).size(), std::numeric_limits<double>::quiet_NaN());
    const auto put_exact = [&](std::size_t column, double steps) {
      const Quad t = Quad(run.start.time()) + Quad(steps) * Quad(run.start.step());
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
    constexpr double h = 0.1;
    constexpr int steps = 500;
    const auto of = [](const char* column, double expected, bool fault) {
      return MeasureControl{.system = "harmonic-oscillator",
                            .method = "implicit-midpoint",
                            .step = "0.1",
                            .steps = steps,
                            .column = column,
                            .expected = expected,
                            .allowed = 5e-8,  // eight digits are written
                            .fault = fault};
    };
    return {of("x", std::cos(steps * 2 * std::atan(h / 2)), false), of("exact_x", std::cos(steps * h), false),
            of("x", std::cos(steps * h), true)};
  }

 private:
  static constexpr std::int64_t fewest = 12;

  // The number of steps in which the track in the plane has turned once, either way: that of the exact
  // motion, so that the stretches of all methods are alike, or else of the run itself.
  template <class T>
  [[nodiscard]] std::int64_t one_turn(const Measured<T>& run) const {
    const std::int64_t longest = std::min<std::int64_t>(run.steps, most);
    const auto [first, second] = plane_of(*run.start.model(), x, y);
    const std::span<const T> z = run.start.state();
    const Quad t0 = Quad(run.start.time()), h = Quad(run.start.step());
    const auto solution = exact ? run.solution.to(Quad(static_cast<double>(longest)) * h) : nullptr;
    std::optional<Integration<T>> along;
    if (solution == nullptr) along.emplace(run.start.beside({z.begin(), z.end()}));
    std::array<double, 2> last{double(z[first]), double(z[second])}, before{};
    double turned = 0;  // the sum of the angles between steps
    for (std::int64_t step = 1; step <= longest; ++step) {
      std::array<double, 2> here{};
      if (along) {
        if (!along->steps(step - along->steps_taken()).reached()) return step;
        here = {double(along->state()[first]), double(along->state()[second])};
      } else {
        const Quad t = t0 + Quad(static_cast<double>(step)) * h;
        if (!solution->covers(t)) return longest;
        const std::vector<Quad> solved = solution->at(t);
        here = {double(solved[first]), double(solved[second])};
      }
      const double u = here[0] - last[0], v = here[1] - last[1];
      if (step > 1)
        turned += std::abs(std::atan2(before[0] * v - before[1] * u, before[0] * u + before[1] * v));
      before = {u, v}, last = here;
      if (step >= fewest && turned >= 2 * std::numbers::pi) return step;
    }
    return longest;
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
