// What bead-rod systems have in common: canonical coordinates q (positions, bead by bead) and p, the energy
//
//   H = sum_i |p_i|^2/(2 m_i) + V(q),   phi_k = (|D_k|^2 - l_k^2)/2,   friction lambda_i of bead i,
//
// as formulas compiled for every scalar, and the batched operations of the constraints. The author's struct
// derives from BeadRods<itself> and writes describe().
#pragma once

#include <memory>

#include <pfaff/core/facets/holonomic.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/systems/bead_rod/description.hpp>
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

/// V(q). Instantiated, like the next, for the scalars of methods and for recording.
template <class T>
T potential_energy(const BeadRodParts& parts, In<T> q);
template <class T>
std::unique_ptr<HolonomicConstraints<T>> rod_constraints(const BeadRodParts& parts);

/// Momenta of velocities in -1 .. 1 m/s from a seed, made consistent with the rods by M^-1-orthogonal
/// projection in quad precision.
void start_at_random(BeadRodDescription& description, int seed);

/// What the symmetries of a description keep, beside the energy: momenta along `axes`, and angular momenta
/// in the planes of pairs of axes.
struct Momenta {
  explicit Momenta(const BeadRodDescription& description);
  std::vector<std::size_t> axes;
  std::vector<std::pair<std::size_t, std::size_t>> planes;
};

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
    const Momenta momenta(description());
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
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return rod_kinetic_energy<T>(
        description(), [this](std::size_t i) -> const Real& { return description().masses[i]; }, p);
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return potential_energy<T>(parts(), q);
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
    const std::size_t n = degrees(), axes = description().axes();
    const Momenta momenta(description());
    values[0] = kinetic(t, z.subspan(n)) + potential(t, z.first(n));
    std::size_t at = 1;
    for (const std::size_t x : momenta.axes) {
      T sum(0);
      for (std::size_t k = x; k < n; k += axes) sum = sum + z[n + k];
      values[at++] = sum;
    }
    for (const auto& [x, y] : momenta.planes) {
      T sum(0);
      for (std::size_t k = 0; k < n; k += axes)
        sum = sum + (z[k + x] * z[n + k + y] - z[k + y] * z[n + k + x]);
      values[at++] = sum;
    }
  }

  [[nodiscard]] const BeadRodDescription& description() const { return *parts().description; }

 private:
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
