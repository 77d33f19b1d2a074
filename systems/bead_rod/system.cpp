#include <pfaff/systems/bead_rod/system.hpp>

#include <algorithm>
#include <tuple>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/numbers/random_numbers.hpp>
#include <pfaff/systems/bead_rod/evaluators.hpp>

namespace pfaff {

namespace {
std::shared_ptr<const BeadRodDescription> checked(BeadRodDescription d) {
  d.check();
  return std::make_shared<const BeadRodDescription>(std::move(d));
}
}  // namespace

BeadRodParts::BeadRodParts(BeadRodDescription d)
    : description(checked(std::move(d))), graph(std::make_shared<const RodGraph>(*description)) {}

template <class T>
std::unique_ptr<PotentialEnergy<T>> potential_energy(const BeadRodParts& parts) {
  return parts.description->dimension == 2 ? detail::potential_energy<T, 2>(parts)
                                           : detail::potential_energy<T, 3>(parts);
}
template std::unique_ptr<PotentialEnergy<Pack<8>>> potential_energy(const BeadRodParts& parts);
template <class T>
std::unique_ptr<HolonomicConstraints<T>> rod_constraints(const BeadRodParts& parts) {
  return parts.description->dimension == 2 ? detail::rod_constraints<T, 2>(parts)
                                           : detail::rod_constraints<T, 3>(parts);
}

namespace detail {
// Emits both for every scalar of the list.
template <class List>
struct RodInstances;
template <class... T>
struct RodInstances<Scalars<T...>> {
  static constexpr std::tuple energies{&pfaff::potential_energy<T>...};
  static constexpr std::tuple constraints{&pfaff::rod_constraints<T>...};
};
template struct RodInstances<FormulaScalars>;
}  // namespace detail

void start_at_random(BeadRodDescription& description, int seed) {
  RandomNumbers random(seed);
  description.momenta.clear();
  for (const Real& m : description.masses)
    for (std::size_t x = 0; x < description.axes(); ++x) description.momenta.push_back(m * random.next());
  const BeadRodParts parts(description);
  const auto constraints = rod_constraints<Quad>(parts);
  std::vector<Quad> q, p, multipliers(description.rods.size()), change(description.momenta.size());
  for (const Real& x : description.positions) q.push_back(x.quad());
  for (const Real& x : description.momenta) p.push_back(x.quad());
  constraints->linearise(Quad(0), q, p);
  // Twice: the second time removes the rounding errors of the first.
  for (int pass = 0; pass < 2; ++pass) {
    constraints->hidden_values(Quad(0), q, p, multipliers);
    constraints->solve(multipliers, multipliers);
    constraints->apply_transpose(multipliers, change);
    for (std::size_t k = 0; k < p.size(); ++k) p[k] = p[k] - change[k];
  }
  for (std::size_t k = 0; k < p.size(); ++k) description.momenta[k] = Real(p[k]);
}

Momenta::Momenta(const BeadRodDescription& d) {
  if (!d.fields.empty() || !d.traps.empty() || !d.friction.empty()) return;
  const auto weightless = [&](std::size_t x) { return d.gravity.empty() || d.gravity[x].is(0); };
  const auto anchored_at_zero = [&](std::size_t x) {
    return std::all_of(d.anchors.begin(), d.anchors.end(),
                       [x](const Anchor& a) { return a.position[x].is(0); });
  };
  for (std::size_t x = 0; x < d.axes(); ++x)
    if (weightless(x) && d.anchors.empty()) axes.push_back(x);
  for (std::size_t x = 0; x < d.axes(); ++x)
    for (std::size_t y = x + 1; y < d.axes(); ++y)
      if (weightless(x) && weightless(y) && anchored_at_zero(x) && anchored_at_zero(y))
        planes.emplace_back(x, y);
}

}  // namespace pfaff
