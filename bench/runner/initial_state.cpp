#include <pfaff/bench/runner/initial_state.hpp>

#include <pfaff/bench/runner/expressions.hpp>
#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/facets/momenta_of_velocities.hpp>
#include <pfaff/runs/asked_for.hpp>

namespace pfaff {

namespace {
// As many numbers as `expected`. Each is named by `what` and its coordinate, all of them by `all`.
std::vector<Real> numbers_of(const Model& model, const std::vector<std::string>& texts, std::size_t expected,
                             const std::string& what, const std::string& all) {
  if (texts.size() != expected)
    throw InputError(all + " of " + model.name() + ": expected " + std::to_string(expected) +
                     " numbers, got " + std::to_string(texts.size()));
  std::vector<Real> numbers;
  for (std::size_t k = 0; k < expected; ++k)
    numbers.push_back(finite_number(evaluated(texts[k], what, model.parameters()),
                                    what + " " + model.coordinates()[k].name + " of " + model.name()));
  return numbers;
}

// The state that the system starts from by itself.
std::vector<Real> own_state(const Model& model) {
  const auto dimension = static_cast<std::size_t>(model.dimension());
  const std::vector<Real>& own = model.initial();
  if (!own.empty() && own.size() != dimension)
    throw InputError("system " + model.name() + " lists an initial state of " + std::to_string(own.size()) +
                     " numbers; expected " + std::to_string(dimension) + ", or --set initial=");
  if (own.empty())
    throw InputError("system " + model.name() + " has no initial state of its own; expected --set initial=");
  return own;
}

std::vector<Real> state_of_velocities(const Model& model, const AskedState& asked, const Real& t) {
  const std::string what = "initial_velocities";
  const auto energy = energy_of_velocities(model);
  if (energy == nullptr) {
    std::string names;
    for (const Coordinate& c : model.coordinates()) names += (names.empty() ? "" : ", ") + c.name;
    throw InputError(what + ": momenta of " + model.name() +
                     " do not follow from velocities; expected a system with a canonical energy, or "
                     "--set initial= with a state (" +
                     names + ")");
  }
  const std::size_t half = static_cast<std::size_t>(model.dimension()) / 2;
  std::vector<Real> z;
  if (asked.coordinates.empty()) {
    z = own_state(model);
    z.resize(half);
  } else {
    z = numbers_of(model, asked.coordinates, half, "initial", "initial positions beside " + what);
  }
  const std::vector<Real> v = numbers_of(model, asked.velocities, half, what, what);
  try {
    const std::vector<Real> p = momenta_of_velocities(energy, t, z, v);
    z.insert(z.end(), p.begin(), p.end());
  } catch (const InputError& error) {
    throw InputError(what + " of " + model.name() + ": " + error.what());
  }
  return z;
}
}  // namespace

std::vector<Real> state_numbers(const Model& model, const std::vector<std::string>& texts,
                                const std::string& what) {
  return numbers_of(model, texts, static_cast<std::size_t>(model.dimension()), what, what + " state");
}

std::vector<Real> initial_state(const Model& model, const AskedState& asked, const Real& t) {
  if (model.coordinates().size() != static_cast<std::size_t>(model.dimension()))
    throw InputError("system " + model.name() + " names " + std::to_string(model.coordinates().size()) +
                     " coordinates; expected " + std::to_string(model.dimension()));
  if (!asked.velocities.empty()) return state_of_velocities(model, asked, t);
  return asked.coordinates.empty() ? own_state(model) : state_numbers(model, asked.coordinates, "initial");
}

}  // namespace pfaff
