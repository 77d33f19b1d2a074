// What bead-rod systems have in common: canonical coordinates q (positions, bead by bead) and p, the energy
//
//   H = sum_i |p_i|^2/(2 m_i) + V(q),   phi_k = (|D_k|^2 - l_k^2)/2,   friction lambda_i of bead i,
//
// as formulas compiled for every scalar, and the batched operations of the constraints. The author's struct
// derives from BeadRods<itself> and writes describe().
#pragma once

#include <algorithm>
#include <memory>

#include <pfaff/core/facets/holonomic.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/systems/bead_rod/energies.hpp>

namespace pfaff {

/// Instantiated for the scalars of methods and for recording.
template <class T>
std::unique_ptr<HolonomicConstraints<T>> rod_constraints(const BeadRodParts& parts);

/// Momenta of velocities in -1 .. 1 m/s from a seed, made consistent with the rods by M^-1-orthogonal
/// projection in quad precision.
void start_at_random(BeadRodDescription& description, int seed);

template <class S>
class BeadRodSystem {
 public:
  static constexpr bool batched = true;

  [[nodiscard]] int dimension() const { return static_cast<int>(2 * degrees()); }
  [[nodiscard]] int constraint_count() const { return static_cast<int>(description().rods.size()); }
  [[nodiscard]] std::vector<Coordinate> coordinates() const {
    std::vector<Coordinate> names;
    for (const char* prefix : {"", "p"})
      for (std::size_t i = 0; i < description().beads(); ++i)
        for (std::size_t x = 0; x < description().axes(); ++x)
          names.push_back(
              {prefix + std::string(1, "xyz"[x]) + std::to_string(i), *prefix == 'p' ? "kg m/s" : "m"});
    return names;
  }
  [[nodiscard]] std::vector<std::string> constraint_names() const {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < description().rods.size(); ++k) names.push_back("rod" + std::to_string(k));
    return names;
  }
  [[nodiscard]] std::vector<Invariant> invariant_list() const {
    const Momenta momenta = kept();
    const BeadRodDescription& d = description();
    // Without forces the energy is kinetic, a quadratic form.
    const bool free = d.gravity.empty() && d.pairs.empty() && d.springs.empty() && d.angles.empty() &&
                      d.fields.empty() && d.traps.empty();
    std::vector<Invariant> list{!d.friction.empty() ? decreasing("energy", "J")
                                : free              ? conserved_quadratic("energy", "J")
                                                    : conserved("energy", "J")};
    for (const std::size_t x : momenta.axes)
      list.push_back(conserved("momentum-" + std::string(1, "xyz"[x]), "kg m/s"));
    for (const auto& [x, y] : momenta.planes)
      list.push_back(conserved_quadratic(
          "angular-momentum-" + std::string(1, "xyz"[x]) + std::string(1, "xyz"[y]), "kg m^2/s"));
    return list;
  }
  template <class T>
  void initial(Out<T> z) const {
    for (std::size_t k = 0; k < degrees(); ++k) {
      z[k] = T(description().positions[k]);
      z[degrees() + k] = T(description().momenta[k]);
    }
  }
  /// What the symmetries of the rods keep, unless S says otherwise.
  [[nodiscard]] Momenta momenta() const { return Momenta(description()); }
  template <class T>
  [[nodiscard]] BeadRodEnergies<T> prepared() const {
    return {parts(), kept()};
  }
  /// Pairs within a cut-off are added up in the order in which they are found, which packs cannot.
  [[nodiscard]] bool fits_lanes() const {
    const auto& pairs = description().pairs;
    return std::none_of(pairs.begin(), pairs.end(),
                        [](const PairPotential& p) { return p.cutoff.has_value(); });
  }
  template <class T>
  T kinetic(const T& t, In<T> p) const {
    return prepared<T>().kinetic(t, p);
  }
  template <class T>
  T potential(const T& t, In<T> q) const {
    return prepared<T>().potential(t, q);
  }
  template <class T>
  void holonomic(const T& /*t*/, In<T> q, Out<T> phi) const {
    rod_constraint_values<T>(
        description(), [this](std::size_t k) -> const Real& { return description().rods[k].length; }, q, phi);
  }
  template <class T>
  void friction(const T& /*t*/, In<T> /*z*/, Out<T> lambda) const {
    const BeadRodDescription& d = description();
    for (std::size_t k = 0; k < degrees(); ++k)
      lambda[k] = d.friction.empty() ? T(0) : T(d.friction[k / d.axes()]);
  }
  template <class T>
  [[nodiscard]] std::unique_ptr<HolonomicConstraints<T>> constraint_evaluator() const {
    return rod_constraints<T>(parts());
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    prepared<T>().invariants(t, z, values);
  }

  [[nodiscard]] const BeadRodDescription& description() const { return *parts().description; }

 private:
  [[nodiscard]] Momenta kept() const { return static_cast<const S*>(this)->momenta(); }
  // Made when it is first asked for. That is while the model is made, when the parameters are fixed.
  [[nodiscard]] const BeadRodParts& parts() const {
    if (parts_ == nullptr)
      parts_ = std::make_shared<const BeadRodParts>(static_cast<const S*>(this)->describe());
    return *parts_;
  }
  [[nodiscard]] std::size_t degrees() const { return description().beads() * description().axes(); }

  mutable std::shared_ptr<const BeadRodParts> parts_;
};

/// The formulas of a description.
struct BeadRodFormulas : BeadRodSystem<BeadRodFormulas> {
  BeadRodDescription described;
  [[nodiscard]] const BeadRodDescription& describe() const { return described; }
};

/// The model of a description, compiled once for all systems of beads and rods alone; `parameters` are what
/// it was described with.
std::shared_ptr<const Model> bead_rod_model(const SystemDescriptor& descriptor,
                                            BeadRodDescription description, Assignments parameters = {});

/// A system S that writes describe().
template <class S>
struct BeadRods {
  [[nodiscard]] int constraint_count() const { return static_cast<int>(self().describe().rods.size()); }
  [[nodiscard]] std::shared_ptr<const Model> shared_model(const SystemDescriptor& descriptor,
                                                          Assignments parameters) const {
    return bead_rod_model(descriptor, self().describe(), std::move(parameters));
  }

 private:
  [[nodiscard]] const S& self() const { return static_cast<const S&>(*this); }
};

}  // namespace pfaff
