#include <pfaff/verify/random_systems/polynomial_system.hpp>

#include <random>

#include <pfaff/core/tape/recorder.hpp>

namespace pfaff {

std::vector<std::string> numbered(const std::string& letter, std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t k = 1; k <= count; ++k) names.push_back(letter + std::to_string(k));
  return names;
}

namespace {

Recorded function_value(Function function, const Recorded& x) {
  switch (function) {
    case Function::sine:
      return sin(x);
    case Function::exponential:
      return exp(x);
    case Function::root:
      return sqrt(Recorded(1) + x * x);
    case Function::bell:
      break;
  }
  return Recorded(1) / (Recorded(1) + x * x);
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
  for (const std::string& name : numbered("z", system.dimension)) source.coordinates.push_back({name, ""});
  for (const auto& [formula, results] : system.formulas) {
    const auto& divisors = system.chart_divisors;
    const bool divided = formula == Formula::chart_inverse && !divisors.empty();
    const auto found = system.applied.find(formula);
    const auto applied = found == system.applied.end() ? std::vector<AppliedFunction>() : found->second;
    source.given[index(formula)] = std::make_shared<const Tape>(record(
        static_cast<int>(results.front().variables() - applied.size()), static_cast<int>(results.size()),
        [&, &made_of = results](const Recorded& t, In<Recorded> read, Out<Recorded> out) {
          std::vector<Recorded> x(read.begin(), read.end());
          for (const AppliedFunction& f : applied) x.push_back(function_value(f.function, read[f.variable]));
          for (std::size_t k = 0; k < made_of.size(); ++k) {
            out[k] = made_of[k](t, x);
            if (divided) out[k] = out[k] / divisors[k](t, x);
          }
        }));
    if (formula == Formula::holonomic || formula == Formula::constraints)
      source.constraint_names = numbered("phi", results.size());
    if (formula == Formula::velocity_constraints)
      source.velocity_constraint_names = numbered("psi", results.size() / (system.dimension / 2));
  }
  return std::make_shared<const Model>(std::move(source));
}

PolynomialSystem with_moving_constraints(PolynomialSystem system, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (const Formula formula : {Formula::holonomic, Formula::constraints}) {
    if (!system.formulas.contains(formula)) continue;
    for (SparsePolynomial& phi : system.formulas[formula]) {
      // t x_a x_b / 10 + t^2 x_c / 20, with one sign or the other.
      const std::size_t n = phi.variables();
      Powers twice(n + 1), once(n + 1);
      for (int k = 0; k < 2; ++k) ++twice[random() % n];
      ++once[random() % n];
      twice.back() = 1;
      once.back() = 2;
      phi.add(twice, Real::fraction(random() % 2 == 0 ? 1 : -1, 10));
      phi.add(once, Real::fraction(random() % 2 == 0 ? 1 : -1, 20));
    }
  }
  system.formulas.erase(Formula::invariants);
  system.formulas.erase(Formula::reversal);
  system.invariants.clear();
  return system;
}

}  // namespace pfaff
