#include <pfaff/verify/random_constraints.hpp>

#include <array>
#include <random>
#include <string>

#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/recorder.hpp>
#include <pfaff/systems/bead_rod/system.hpp>
#include <pfaff/verify/random_systems/recipe.hpp>

namespace pfaff {

namespace {

BeadRodDescription random_description() {
  BeadRodDescription d;
  d.origin = "random rods";
  d.dimension = 3;
  constexpr std::size_t beads = 9;
  std::mt19937 random(2718);
  const auto draw = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  };
  d.anchors.push_back({"origin", {0, 0, 0}});
  for (std::size_t i = 0; i < beads; ++i) {
    d.masses.push_back(Real::fraction(draw(50, 200), 100));
    d.friction.push_back(i % 3 == 0 ? Real(0) : Real::fraction(draw(10, 90), 100));
    for (int x = 0; x < 3; ++x) {
      d.positions.push_back(Real::fraction(draw(-150, 150), 100));
      d.momenta.push_back(Real::fraction(draw(-100, 100), 100));
    }
  }
  d.gravity = {0, 0, Real::fraction(-981, 100)};
  const auto join = [&](std::size_t a, std::size_t b) { d.rods.push_back({a, b, d.distance(a, b)}); };
  join(0, beads);
  for (std::size_t i = 1; i < beads; ++i) join(i, static_cast<std::size_t>(draw(0, static_cast<int>(i) - 1)));
  join(beads - 2, 1);  // a loop
  return d;
}

constexpr std::uint64_t seeds = 2;
constexpr std::array kinds{SystemKind::surface, SystemKind::revolution, SystemKind::rods,
                           SystemKind::second_class, SystemKind::rolling};

// The same system with applied forces, Q_k = q_k/3 - q_(k+1) p_(k+1)/2 + sin(t) p_k, which nothing keeps.
std::shared_ptr<const Model> with_applied_forces(const Model& model) {
  ModelSource source = model.source();
  source.name += "-forced";
  source.invariants.clear();
  source.given[index(Formula::invariants)] = source.given[index(Formula::reversal)] = nullptr;
  const auto n = static_cast<std::size_t>(source.dimension) / 2;
  source.given[index(Formula::applied_force)] = std::make_shared<const Tape>(record(
      source.dimension, static_cast<int>(n), [n](const Recorded& t, In<Recorded> z, Out<Recorded> force) {
        for (std::size_t k = 0; k < n; ++k)
          force[k] = z[k] / 3 - z[(k + 1) % n] * z[n + (k + 1) % n] / 2 + sin(t) * z[n + k];
      }));
  return std::make_shared<const Model>(std::move(source));
}

}  // namespace

std::shared_ptr<const Model> random_rods() {
  return bead_rod_model({.name = "random rods", .title = "", .reference = ""}, random_description());
}

std::vector<std::shared_ptr<const Model>> random_constraints() {
  std::vector<std::shared_ptr<const Model>> models;
  for (const SystemKind kind : kinds)
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      PolynomialSystem system = system_of(random_recipe(kind, seed, verified_size));
      system.name += "-" + std::to_string(seed);
      models.push_back(model_of(system));
      if (kind != SystemKind::second_class) models.push_back(with_applied_forces(*models.back()));
      // Angular momentum is kept where everything is symmetric about an axis, and nothing that moves is.
      if (kind == SystemKind::rolling || kind == SystemKind::revolution) continue;
      system.name += "-moving";
      models.push_back(model_of(with_moving_constraints(std::move(system), seed)));
    }
  return models;
}

}  // namespace pfaff
