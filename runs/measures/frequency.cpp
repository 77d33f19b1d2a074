// How fast vectors turn that the motion carries along, and how much faster than in the motion itself: the
// position of a planet, or the direction of its pericentre. Rates are those of turning.hpp; the error is that
// of the angle between the vector of the method and that of the solution, so that it has all its digits.
#include <cmath>

#include <pfaff/runs/measure.hpp>
#include <pfaff/runs/support/turning_in_text.hpp>

namespace {
using namespace pfaff;

struct Frequency {
  std::string names = "vector", x, y, definitions;
  Real time = 0;

  static std::vector<Parameter> parameters() {
    return {
        text_parameter(&Frequency::names, "name", "NAME", "of the vector; several have a | between them"),
        text_parameter(&Frequency::x, "x", "EXPRESSION", "its first component; of several with a |"),
        text_parameter(&Frequency::y, "y", "EXPRESSION", "its second component; of several with a |"),
        text_parameter(&Frequency::definitions, "let", "NAME = EXPRESSION; ...",
                       "what components have in common; of several vectors with a |"),
        parameter(&Frequency::time, "time", "", 0, 1e30, "that is compared; 0: that of a thousand steps")};
  }
  [[nodiscard]] std::vector<Column> columns(const Model& model) const {
    const std::string rate = "rad/" + (model.time_unit().empty() ? "1" : model.time_unit());
    return {{.name = "vector", .kind = Column::Kind::text},
            {.name = "frequency", .unit = rate, .digits = 12},
            {.name = "error", .unit = rate, .digits = 6},
            {.name = "change", .unit = rate, .digits = 3}};
  }
  [[nodiscard]] VectorTexts texts() const { return {names, x, y, definitions}; }
  [[nodiscard]] std::string refuses(const Model& model, const MethodInstance& /*method*/) const {
    if (std::string objection = texts().objection(); !objection.empty()) return objection;
    (void)VectorsInText(texts(), model);
    return "";
  }
  template <class T>
  [[nodiscard]] std::int64_t steps_of(const Measured<T>& run) const {
    if (time.is(0)) return std::min<std::int64_t>(run.steps, 1000);
    const double count = time.value() / std::abs(static_cast<double>(run.start.step())) * (1 + 1e-12);
    return static_cast<std::int64_t>(std::min(count, static_cast<double>(run.steps)));
  }
  template <class T>
  [[nodiscard]] std::vector<std::int64_t> looks(const Measured<T>& run) const {
    return evenly(steps_of(run), 4000);
  }
  template <class T>
  struct Work {
    VectorsInText vectors;
    std::shared_ptr<const ReferenceSolution> solution;
    Work(const Frequency& measure, const Measured<T>& run)
        : vectors(measure.texts(), *run.start.model()),
          solution(run.solution.to(run.duration(static_cast<double>(measure.steps_of(run))))) {}
  };
  // The table has rows at the end alone.
  template <class T>
  bool look(const Measured<T>& run, const RunState<T>& at, Work<T>& work, Row& row) const {
    row.clear();
    const auto steps = static_cast<double>(at.step);
    const Quad exact = run.time_after(steps);
    if (!work.solution->covers(exact)) throw RunError(work.solution->ended());
    const std::vector<Quad> solved = work.solution->at(exact);
    work.vectors.look(static_cast<double>(run.duration(steps)), static_cast<double>(at.t),
                      {at.z.begin(), at.z.end()}, {solved.begin(), solved.end()});
    return true;
  }
  template <class T>
  std::vector<Row> end(const Measured<T>& /*run*/, Work<T>& work) const {
    std::vector<Row> rows;
    for (const TurnedVector& vector : work.vectors.turned())
      rows.push_back({vector.name, vector.of_solution.rate, vector.error.rate, vector.error.change});
    return rows;
  }
  // A step of Verlet or of the midpoint rule turns the oscillator about an ellipse by an angle that is known;
  // the swings on the ellipse leave what the window does of them.
  static std::vector<MeasureControl> controls() {
    constexpr double h = 0.2;
    const auto of = [](const char* method) {
      MeasureControl control = MeasureControl::of("harmonic-oscillator", method, "0.2", 1000);
      control.settings = {{"x", "q"}, {"y", "p"}};
      return control;
    };
    return {of("verlet").gives("error", 1 - 2 / h * std::asin(h / 2), 1e-10),
            of("implicit-midpoint").gives("error", 1 - 2 / h * std::atan(h / 2), 1e-13),
            of("verlet").does_not_give("error", 0, 1e-10)};
  }
};

const Measure<Frequency> registered{
    {.name = "frequency",
     .title = "How fast vectors in a plane turn, and how much faster than in the motion itself",
     .description =
         "The rate at which a vector of the state turns in the exact motion, and by how much more with the "
         "method, over the same time: the phase that a method loses is this times the time. The change is "
         "that of the error from the first half of the time to the second. Cells are empty where the vector "
         "of the solution turns by more than a third of a turn between two looks.",
     .version = 2,
     .over = Over::step}};
}  // namespace
