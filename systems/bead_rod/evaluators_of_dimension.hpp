// The definitions that the files of each dimension instantiate.
#pragma once

#include <tuple>

#include <pfaff/systems/bead_rod/evaluators.hpp>
#include <pfaff/systems/bead_rod/rod_constraints.hpp>

namespace pfaff::detail {

template <class T, int D>
class PotentialEnergyIn final : public PotentialEnergy<T> {
 public:
  explicit PotentialEnergyIn(const BeadRodParts& parts) : potentials_(parts.description, *parts.graph) {}
  T operator()(In<T> q) override { return potentials_.energy(q); }

 private:
  Potentials<T, D> potentials_;
};

template <class T, int D>
std::unique_ptr<PotentialEnergy<T>> potential_energy(const BeadRodParts& parts) {
  return std::make_unique<PotentialEnergyIn<T, D>>(parts);
}

template <class T, int D>
std::unique_ptr<HolonomicConstraints<T>> rod_constraints(const BeadRodParts& parts) {
  return std::make_unique<RodConstraints<T, D>>(parts.description, parts.graph);
}

/// Emits both for every scalar of the list.
template <int D, class List>
struct EvaluatorInstances;
template <int D, class... T>
struct EvaluatorInstances<D, Scalars<T...>> {
  static constexpr std::tuple energies{&potential_energy<T, D>...};
  static constexpr std::tuple constraints{&rod_constraints<T, D>...};
};

}  // namespace pfaff::detail
