#include <pfaff/verify/random_checks.hpp>

#include <algorithm>
#include <set>

#include <pfaff/runs/motion.hpp>
#include <pfaff/verify/claim_checks.hpp>

namespace pfaff {

namespace {

constexpr std::uint64_t seed = 20041;
// Jacobians and Taylor series in quad of larger systems cost too much.
constexpr std::size_t most_variables = 8;

// Three kinds out of those that fit, the first, one in the middle and the last, and one of them in later
// turns.
std::set<SystemKind> some_of(const std::vector<SystemKind>& kinds, std::size_t turn) {
  if (kinds.empty()) return {};
  if (turn > 0) return {kinds[turn % kinds.size()]};
  return {kinds.front(), kinds[kinds.size() / 2], kinds.back()};
}

}  // namespace

std::shared_ptr<const Model> model_in_scope(const MethodInstance& method, Claim claim,
                                            const std::shared_ptr<const Model>& model) {
  std::shared_ptr<const Model> fitting = model;
  if (!method.refuses(*model).empty()) {
    if (model->moves() || !model->restricted() || !default_formulation(*model).refuses(*model).empty())
      return nullptr;
    fitting = motion_of(model);
    if (!method.refuses(*fitting).empty()) return nullptr;
  }
  return in_scope(claim, *fitting) ? fitting : nullptr;
}

std::shared_ptr<const Model> model_claimed_on(const MethodInstance& method, Claim claim,
                                              const std::shared_ptr<const Model>& model) {
  const auto fitting = model_in_scope(method, claim, model);
  if (fitting == nullptr) return nullptr;
  const std::vector<Claim> made = method.preserves(*fitting);
  return std::find(made.begin(), made.end(), claim) != made.end() ? fitting : nullptr;
}

std::vector<Check> check_on_random_systems(const MethodInstance& method, const Assignments& parameters,
                                           std::size_t turn, bool every_kind) {
  std::set<SystemKind> chosen;
  for (const ClaimRow& row : claim_table) {
    std::vector<SystemKind> kinds;
    for (const SystemKind kind : system_kinds) {
      // Registered systems have functions that are no polynomials; the random ones add what these lack.
      if (kind == SystemKind::transcendental) continue;
      const Recipe recipe = random_recipe(kind, seed, verified_size);
      if (recipe.dimension <= most_variables &&
          model_claimed_on(method, row.claim, model_of(system_of(recipe))) != nullptr)
        kinds.push_back(kind);
    }
    if (every_kind)
      chosen.insert(kinds.begin(), kinds.end());
    else
      chosen.merge(some_of(kinds, turn));
  }
  std::vector<Check> checks;
  for (const SystemKind kind : chosen) {
    const PolynomialSystem system = system_of(random_recipe(kind, seed, verified_size));
    const auto model = motion_for(method, model_of(system));
    for (Check& check : check_in_short_runs(method, parameters, system.name, model))
      checks.push_back(std::move(check));
  }
  return checks;
}

}  // namespace pfaff
