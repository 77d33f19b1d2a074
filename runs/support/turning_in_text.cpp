#include <pfaff/runs/support/turning_in_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/text/scope.hpp>

namespace pfaff {

namespace {

constexpr char between_vectors = '|';
constexpr double largest_turn = 2 * std::numbers::pi / 3;  // between two looks

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

// Both components of the vector `of`, recorded with the coordinates of the model as inputs.
Tape recorded(const Model& model, const std::string& of, const std::string& x, const std::string& y,
              const std::string& definitions) {
  Recorder recorder(static_cast<int>(model.dimension()));
  text::Scope scope;
  scope.define("t", recorder.time());
  for (const auto& [name, value] : model.parameters())
    if (const auto number = Real::parse(value)) scope.define(name, Recorded(*number));
  const std::vector<Recorded> inputs = recorder.inputs();
  for (std::size_t i = 0; i < inputs.size(); ++i) scope.define(model.coordinates()[i].name, inputs[i]);
  for (const std::string& definition : parts_of(definitions, ';')) {
    if (definition.empty()) continue;
    const std::vector<std::string> sides = parts_of(definition, '=');
    if (sides.size() != 2) throw InputError(of + "let: expected NAME = EXPRESSION, got '" + definition + "'");
    scope.define(sides[0], text::Expression({sides[1], of + "'" + sides[0] + "'"}));
  }
  const std::array components{scope.evaluate(text::Expression({x, of + "component x"})),
                              scope.evaluate(text::Expression({y, of + "component y"}))};
  return recorder.finish(components);
}

}  // namespace

std::string VectorTexts::objection() const {
  if (x.empty() || y.empty()) return "needs the components of a vector, as in frequency(x=q, y=p)";
  const std::size_t vectors = parts_of(x, between_vectors).size();
  for (const std::string* other : {&y, &names})
    if (parts_of(*other, between_vectors).size() != vectors)
      return "needs as many of y and of name as of x, which are " + std::to_string(vectors) +
             ", with a | between them";
  if (!definitions.empty() && parts_of(definitions, between_vectors).size() > vectors)
    return "needs a list 'let' for each vector at most";
  return "";
}

VectorsInText::VectorsInText(const VectorTexts& texts, const Model& model) {
  const std::vector<std::string> names = parts_of(texts.names, between_vectors),
                                 x = parts_of(texts.x, between_vectors),
                                 y = parts_of(texts.y, between_vectors),
                                 common = parts_of(texts.definitions, between_vectors);
  for (std::size_t k = 0; k < x.size(); ++k) {
    const std::string of = "frequency '" + names[k] + "', ";
    vectors_.push_back({names[k], Replay<double>(std::make_shared<const Tape>(
                                      recorded(model, of, x[k], y[k], k < common.size() ? common[k] : "")))});
  }
}

TurningVector VectorsInText::Followed::at(double t, const std::vector<double>& z) {
  std::array<double, 2> values{};
  components(t, z.data(), values.data());
  return {values[0], values[1]};
}

void VectorsInText::look(double elapsed, double t, const std::vector<double>& of_method,
                         const std::vector<double>& of_solution) {
  times_.push_back(elapsed);
  for (Followed& vector : vectors_) {
    vector.of_method.push_back(vector.at(t, of_method));
    vector.of_solution.push_back(vector.at(t, of_solution));
  }
}

std::vector<TurnedVector> VectorsInText::turned() const {
  std::vector<TurnedVector> found;
  for (const Followed& vector : vectors_) {
    const std::vector<double> angles = angles_of(vector.of_solution);
    bool followed = true;
    for (std::size_t i = 1; i < angles.size(); ++i)
      followed = followed && std::abs(angles[i] - angles[i - 1]) <= largest_turn;
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    found.push_back({vector.name, {none, none}, {none, none}});
    if (!followed) continue;
    found.back().of_solution = turning_rate(times_, angles);
    found.back().error = turning_rate(times_, angles_ahead(vector.of_method, vector.of_solution));
  }
  return found;
}

}  // namespace pfaff
