// How fast vectors turn that the motion carries along, and how much faster than in the motion itself.
//
// A vector in a plane has two expressions of the coordinates, the parameters and the time t, written as in
// systems as text: the position of a planet, or the direction of its pericentre, whose frequency is a secular
// one. Rates are those of turning.hpp; the error is that of the angle between the vector of the method and
// that of the solution, so that it has all its digits.
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <pfaff/core/tape/replay.hpp>
#include <pfaff/core/text/scope.hpp>
#include <pfaff/runs/measure.hpp>
#include <pfaff/runs/support/turning.hpp>

namespace {
using namespace pfaff;

constexpr char between_vectors = '|';

// The parts of a text between separators, without the spaces around them.
std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    const std::size_t first = std::min(text.find_first_not_of(' ', begin), end);
    const std::size_t last = text.find_last_not_of(' ', end == 0 ? 0 : end - 1);
    parts.push_back(first == end ? "" : text.substr(first, last - first + 1));
    begin = end + 1;
  }
  return parts;
}

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
  [[nodiscard]] std::string refuses(const Model& model, const MethodInstance& /*method*/) const {
    if (x.empty() || y.empty()) return "needs the components of a vector, as in frequency(x=q, y=p)";
    const std::size_t vectors = parts_of(x, between_vectors).size();
    for (const std::string* other : {&y, &names})
      if (parts_of(*other, between_vectors).size() != vectors)
        return "needs as many of y and of name as of x, which are " + std::to_string(vectors) +
               ", with a | between them";
    if (!definitions.empty() && parts_of(definitions, between_vectors).size() > vectors)
      return "needs a list 'let' for each vector at most";
    (void)tapes(model);
    return "";
  }
  template <class T>
  [[nodiscard]] std::vector<std::int64_t> looks(const Measured<T>& run) const {
    return evenly(steps_of(run), looks_at_vectors);
  }

  template <class T>
  struct Work {
    std::vector<Replay<double>> vectors;
    std::shared_ptr<const ReferenceSolution> solution;
    std::vector<double> times;  // elapsed
    std::vector<std::vector<TurningVector>> of_method, of_solution;

    Work(const Frequency& measure, const Measured<T>& run)
        : solution(
              run.solution.to(Quad(static_cast<double>(measure.steps_of(run))) * Quad(run.start.step()))) {
      for (auto& tape : measure.tapes(*run.start.model())) vectors.emplace_back(std::move(tape));
      of_method.resize(vectors.size());
      of_solution.resize(vectors.size());
    }
    template <class Z>
    void append(double t, const Z& state, std::vector<std::vector<TurningVector>>& tracks) {
      std::vector<double> z;
      for (const auto& x : state) z.push_back(static_cast<double>(x));
      for (std::size_t k = 0; k < vectors.size(); ++k) {
        std::array<double, 2> components{};
        vectors[k](t, z.data(), components.data());
        tracks[k].push_back({components[0], components[1]});
      }
    }
  };

  // The table has rows at the end alone.
  template <class T>
  bool look(const Measured<T>& run, const RunState<T>& at, Work<T>& work, Row& row) const {
    row.clear();
    const Quad elapsed = Quad(static_cast<double>(at.step)) * Quad(run.start.step());
    const Quad exact = Quad(run.start.time()) + elapsed;
    if (!work.solution->covers(exact)) throw RunError(work.solution->ended());
    work.times.push_back(static_cast<double>(elapsed));
    work.append(static_cast<double>(at.t), at.z, work.of_method);
    work.append(static_cast<double>(at.t), work.solution->at(exact), work.of_solution);
    return true;
  }
  template <class T>
  std::vector<Row> end(const Measured<T>& /*run*/, Work<T>& work) const {
    std::vector<Row> rows;
    const std::vector<std::string> called = parts_of(names, between_vectors);
    for (std::size_t k = 0; k < work.vectors.size(); ++k) {
      const std::vector<double> angles = angles_of(work.of_solution[k]);
      bool followed = true;
      for (std::size_t i = 1; i < angles.size(); ++i)
        followed = followed && std::abs(angles[i] - angles[i - 1]) <= largest_turn;
      const TurningRate of_solution = turning_rate(work.times, angles);
      const TurningRate error =
          turning_rate(work.times, angles_ahead(work.of_method[k], work.of_solution[k]));
      if (followed) {
        rows.push_back({called[k], of_solution.rate, error.rate, error.change});
      } else {
        rows.push_back({called[k], undefined, undefined, undefined});
      }
    }
    return rows;
  }

  // A step of Verlet or of the midpoint rule turns the oscillator about an ellipse by an angle that is known;
  // the swings on the ellipse leave what the window does of them.
  static std::vector<MeasureControl> controls() {
    constexpr double h = 0.2;
    const auto oscillator = [](const char* method, double expected, double allowed, bool fault) {
      return MeasureControl{.system = "harmonic-oscillator",
                            .method = method,
                            .settings = {{"x", "q"}, {"y", "p"}},
                            .step = "0.2",
                            .steps = 1000,
                            .column = "error",
                            .expected = expected,
                            .allowed = allowed,
                            .fault = fault};
    };
    return {oscillator("verlet", 1 - 2 / h * std::asin(h / 2), 1e-10, false),
            oscillator("implicit-midpoint", 1 - 2 / h * std::atan(h / 2), 1e-13, false),
            oscillator("verlet", 0, 1e-10, true)};
  }

 private:
  static constexpr std::int64_t some_steps = 1000;
  static constexpr int looks_at_vectors = 4000;
  static constexpr double largest_turn = 2 * std::numbers::pi / 3;  // between two looks
  static constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

  // At most, so many steps of those of the run.
  template <class T>
  [[nodiscard]] std::int64_t steps_of(const Measured<T>& run) const {
    if (time.is(0)) return std::min(run.steps, some_steps);
    const double count = time.value() / std::abs(static_cast<double>(run.start.step())) * (1 + 1e-12);
    return count < static_cast<double>(run.steps) ? static_cast<std::int64_t>(count) : run.steps;
  }
  // The components of each vector, recorded with the coordinates of a model as inputs. TextError where an
  // expression is none, or has names that the model does not know.
  [[nodiscard]] std::vector<std::shared_ptr<const Tape>> tapes(const Model& model) const {
    const std::vector<std::string> called = parts_of(names, between_vectors),
                                   first = parts_of(x, between_vectors),
                                   second = parts_of(y, between_vectors),
                                   common = parts_of(definitions, between_vectors);
    std::vector<std::shared_ptr<const Tape>> found;
    for (std::size_t k = 0; k < first.size(); ++k) {
      Recorder recorder(static_cast<int>(model.dimension()));
      text::Scope scope;
      scope.define("t", recorder.time());
      for (const auto& [name, value] : model.parameters())
        if (const auto number = Real::parse(value)) scope.define(name, Recorded(*number));
      const std::vector<Recorded> inputs = recorder.inputs();
      for (std::size_t i = 0; i < inputs.size(); ++i) scope.define(model.coordinates()[i].name, inputs[i]);
      const std::string of = "frequency '" + called[k] + "', ";
      for (const std::string& definition : parts_of(k < common.size() ? common[k] : "", ';')) {
        if (definition.empty()) continue;
        const std::vector<std::string> sides = parts_of(definition, '=');
        if (sides.size() != 2)
          throw InputError(of + "let: expected NAME = EXPRESSION, got '" + definition + "'");
        scope.define(sides[0], text::Expression({sides[1], of + "'" + sides[0] + "'"}));
      }
      const std::array components{scope.evaluate(text::Expression({first[k], of + "component x"})),
                                  scope.evaluate(text::Expression({second[k], of + "component y"}))};
      found.push_back(std::make_shared<const Tape>(recorder.finish(components)));
    }
    return found;
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
