// The energies of beads on rods and what their symmetries keep, in one scalar: what does not change from
// state to state, such as masses in that scalar and the tables of potentials, is made once.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include <pfaff/systems/bead_rod/formulas.hpp>
#include <pfaff/systems/bead_rod/graph.hpp>

namespace pfaff {

/// A checked description and the graph of its rods, shared by all formulas of a model.
struct BeadRodParts {
  /// InputError as BeadRodDescription::check().
  explicit BeadRodParts(BeadRodDescription d);
  std::shared_ptr<const BeadRodDescription> description;
  std::shared_ptr<const RodGraph> graph;
};

/// V(q), with buffers of its own.
template <class T>
class PotentialEnergy {
 public:
  PotentialEnergy() = default;
  PotentialEnergy(const PotentialEnergy&) = delete;
  PotentialEnergy& operator=(const PotentialEnergy&) = delete;
  virtual ~PotentialEnergy() = default;
  virtual T operator()(In<T> q) = 0;
};
/// Instantiated for the scalars of methods, for recording and for packs. In packs pairs cannot be sorted:
/// with a cut-off their sums have other bits.
template <class T>
std::unique_ptr<PotentialEnergy<T>> potential_energy(const BeadRodParts& parts);

/// What the symmetries of a description keep, beside the energy: momenta along `axes`, and angular momenta
/// in the planes of pairs of axes.
struct Momenta {
  Momenta() = default;
  explicit Momenta(const BeadRodDescription& description);
  std::vector<std::size_t> axes;
  std::vector<std::pair<std::size_t, std::size_t>> planes;
};

template <class T>
class BeadRodEnergies {
 public:
  BeadRodEnergies(const BeadRodParts& parts, Momenta momenta)
      : description_(parts.description),
        momenta_(std::move(momenta)),
        potential_(potential_energy<T>(parts)) {
    for (const Real& m : description_->masses) twice_masses_.push_back(T(2 * m));
  }

  [[nodiscard]] T kinetic(const T& /*t*/, In<T> p) const {
    return rod_kinetic_energy<T>(
        *description_, [this](std::size_t i) -> const T& { return twice_masses_[i]; }, p);
  }
  [[nodiscard]] T potential(const T& /*t*/, In<T> q) const { return (*potential_)(q); }
  void invariants(const T& t, In<T> z, Out<T> values) const {
    const std::size_t n = z.size() / 2, axes = description_->axes();
    values[0] = kinetic(t, z.subspan(n)) + potential(t, z.first(n));
    std::size_t at = 1;
    for (const std::size_t x : momenta_.axes) {
      T sum(0);
      for (std::size_t k = x; k < n; k += axes) sum = sum + z[n + k];
      values[at++] = sum;
    }
    for (const auto& [x, y] : momenta_.planes) {
      T sum(0);
      for (std::size_t k = 0; k < n; k += axes)
        sum = sum + (z[k + x] * z[n + k + y] - z[k + y] * z[n + k + x]);
      values[at++] = sum;
    }
  }

 private:
  std::shared_ptr<const BeadRodDescription> description_;
  Momenta momenta_;
  std::vector<T> twice_masses_;
  std::unique_ptr<PotentialEnergy<T>> potential_;
};

}  // namespace pfaff
