#include <pfaff/bench/random_systems/polynomial_system.hpp>

#include <pfaff/core/tape/recorder.hpp>

namespace pfaff {

namespace {

std::vector<std::string> counted(const std::string& letter, std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t k = 1; k <= count; ++k) names.push_back(letter + std::to_string(k));
  return names;
}

}  // namespace

std::shared_ptr<const Model> model_of(const PolynomialSystem& system) {
  ModelSource source;
  source.name = system.name;
  source.dimension = static_cast<int>(system.dimension);
  source.canonical = system.canonical;
  source.damping = system.damping;
  source.invariants = system.invariants;
  source.initial = system.initial;
  for (const std::string& name : counted("z", system.dimension)) source.coordinates.push_back({name, ""});
  for (const auto& [formula, results] : system.formulas) {
    const auto& divisors = system.chart_divisors;
    const bool divided = formula == Formula::chart_inverse && !divisors.empty();
    source.given[index(formula)] = std::make_shared<const Tape>(
        record(static_cast<int>(results.front().variables()), static_cast<int>(results.size()),
               [&, &made_of = results](const Recorded& t, In<Recorded> x, Out<Recorded> out) {
                 for (std::size_t k = 0; k < made_of.size(); ++k) {
                   out[k] = made_of[k](t, x);
                   if (divided) out[k] = out[k] / divisors[k](t, x);
                 }
               }));
    if (formula == Formula::holonomic || formula == Formula::constraints)
      source.constraint_names = counted("phi", results.size());
    if (formula == Formula::velocity_constraints)
      source.velocity_constraint_names = counted("psi", results.size() / (system.dimension / 2));
  }
  return std::make_shared<const Model>(std::move(source));
}

}  // namespace pfaff
