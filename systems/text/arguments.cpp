#include <pfaff/systems/text/arguments.hpp>

#include <algorithm>

namespace pfaff::text {

Arguments arguments_of(Formula formula) {
  switch (formula) {
    case Formula::kinetic:
    case Formula::velocity:
      return Arguments::momenta;
    case Formula::potential:
    case Formula::force:
    case Formula::holonomic:
      return Arguments::positions;
    case Formula::chart_inverse:
    case Formula::chart_hamiltonian:
    case Formula::chart_field:
      return Arguments::chart;
    case Formula::alpha:
      return Arguments::pair;
    case Formula::exact_solution:
      return Arguments::elapsed;
    default:
      return Arguments::state;
  }
}

TextNames::TextNames(const TextDeclaration& declaration, const std::vector<Real>& values)
    : velocities_(declaration.velocities), chart_coordinates_(declaration.chart_coordinates) {
  define(constants_, declaration.parameters, values, declaration.definitions);
  for (const TextCoordinate& c : declaration.coordinates) {
    const Block block{c.name, coordinates_.size(), count_of(c, constants_), c.count.has_value()};
    for (std::size_t k = 1; k <= block.count; ++k)
      coordinates_.push_back({block.several ? c.name + std::to_string(k) : c.name, c.unit, c.range});
    blocks_.push_back(block);
  }
}

std::size_t TextNames::inputs(Arguments arguments) const {
  const std::size_t n = dimension();
  switch (arguments) {
    case Arguments::positions:
    case Arguments::momenta:
      return n / 2;
    case Arguments::motion:
      return n + n / 2;
    case Arguments::pair:
      return 2 * n + 1;
    case Arguments::elapsed:
      return n + 1;
    case Arguments::none:
      return 0;
    default:
      return n;
  }
}

void TextNames::define_state(Scope& scope, const std::vector<Recorded>& values,
                             const std::string& prefix) const {
  for (const Block& block : blocks_) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(block.first);
    if (block.several) {
      scope.define(prefix + block.name,
                   std::vector<Recorded>(begin, begin + static_cast<std::ptrdiff_t>(block.count)));
    } else {
      scope.define(prefix + block.name, *begin);
    }
  }
}

// The coordinates from `first` on, as many as there are values; the others are known and not to be read,
// which an error explains by what the formula is a function `of`, besides the time.
void TextNames::define_half(Scope& scope, std::size_t first, const std::vector<Recorded>& values,
                            const std::string& what, const std::string& of) const {
  for (const Block& block : blocks_) {
    if (block.first < first || block.first + block.count > first + values.size()) {
      scope.withhold(block.name, "is no argument of " + what + ", a function of " + of + " and time");
      continue;
    }
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(block.first - first);
    if (block.several) {
      scope.define(block.name,
                   std::vector<Recorded>(begin, begin + static_cast<std::ptrdiff_t>(block.count)));
    } else {
      scope.define(block.name, *begin);
    }
  }
}

void TextNames::define_list(Scope& scope, const std::vector<std::string>& names, const std::string& otherwise,
                            const std::vector<Recorded>& values) {
  if (names.empty()) scope.define(otherwise, values);
  for (std::size_t k = 0; k < std::min(names.size(), values.size()); ++k) scope.define(names[k], values[k]);
}

Scope TextNames::scope(Arguments arguments, const std::string& what, const Recorded& time,
                       const std::vector<Recorded>& inputs) const {
  Scope scope = constants_;
  const auto n = static_cast<std::ptrdiff_t>(dimension());
  switch (arguments) {
    case Arguments::state:
      define_state(scope, inputs);
      break;
    case Arguments::positions:
      define_half(scope, 0, inputs, what, "positions");
      break;
    case Arguments::momenta:
      define_half(scope, dimension() / 2, inputs, what, "momenta");
      break;
    case Arguments::velocities:
      define_half(scope, 0, {inputs.begin(), inputs.begin() + n / 2}, what, "positions, velocities");
      define_list(scope, velocities_, "v", {inputs.begin() + n / 2, inputs.end()});
      break;
    case Arguments::motion:
      define_state(scope, {inputs.begin(), inputs.begin() + n});
      define_list(scope, velocities_, "v", {inputs.begin() + n, inputs.end()});
      break;
    case Arguments::chart:
      for (const Block& block : blocks_)
        scope.withhold(block.name, "is no argument of " + what + ", a function of the chart's coordinates");
      define_list(scope, chart_coordinates_, "y", inputs);
      break;
    case Arguments::pair:
      define_state(scope, {inputs.begin(), inputs.begin() + n}, "new_");
      define_state(scope, {inputs.begin() + n, inputs.begin() + 2 * n}, "old_");
      scope.define("t0", inputs.back());
      break;
    case Arguments::elapsed:
      define_state(scope, {inputs.begin(), inputs.begin() + n});
      scope.define("t0", inputs.back());
      scope.define("elapsed", time);
      scope.withhold("t", "is no argument of an exact solution; expected elapsed, the time since t0");
      return scope;
    case Arguments::flow:
      define_state(scope, inputs);
      scope.define("h", time);
      scope.withhold(
          "t", "is no argument of " + what + "; parts do not depend on the time, h is that of the flow");
      return scope;
    case Arguments::none:
      for (const Block& block : blocks_)
        scope.withhold(block.name, "is a coordinate; " + what + " is made of parameters alone");
      scope.withhold("t", "is the time; " + what + " is made of parameters alone");
      return scope;
  }
  scope.define("t", time);
  return scope;
}

void TextNames::check_definitions(const TextDeclaration& declaration) const {
  if (declaration.definitions.empty()) return;
  const std::size_t n = dimension();
  Recorder recorder(static_cast<int>(4 * n + 1));
  const std::vector<Recorded> x = recorder.inputs();
  const auto part = [&](std::size_t k, std::size_t count) {
    const auto begin = x.begin() + static_cast<std::ptrdiff_t>(k * n);
    return std::vector<Recorded>(begin, begin + static_cast<std::ptrdiff_t>(count));
  };
  Scope scope = constants_;
  define_state(scope, part(0, n));
  if (declaration.has(Formula::alpha)) {
    define_state(scope, part(1, n), "new_");
    define_state(scope, part(2, n), "old_");
  }
  if (declaration.has(Formula::chart)) define_list(scope, chart_coordinates_, "y", part(3, n));
  if (declaration.lagrangian) define_list(scope, velocities_, "v", part(1, n / 2));
  for (const char* time : {"t", "t0", "elapsed"}) scope.define(time, recorder.time());
  if (!declaration.parts.empty()) scope.define("h", recorder.time());
  std::vector<Recorded> values;
  for (const TextDefinition& definition : declaration.definitions)
    scope.append(Expression(Source{definition.name, declaration.path}), values);
}

}  // namespace pfaff::text
