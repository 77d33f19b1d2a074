// A bead-rod system as it is described: point masses in 2 or 3 dimensions, some of them joined by rigid rods
// to each other or to fixed anchors, under gravity and potentials, with friction.
//
// Points are the beads, 0 .. N - 1, followed by the anchors, N .. N + A - 1. Numbers are exact (Real): the
// same description serves every precision. SI units, unless the user's own are consistent.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <pfaff/core/numbers/real.hpp>

namespace pfaff {

/// A fixed point.
struct Anchor {
  std::string name;
  std::vector<Real> position;
};

/// A rod between two points, the first of them a bead.
struct Rod {
  std::size_t first = 0, second = 0;
  Real length;
};

/// An energy of every pair of beads but those joined by `exclude` rods or fewer. With a cut-off, pairs
/// beyond it have none and the others are shifted by a constant, so that the energy is continuous there; the
/// force is not shifted.
struct PairPotential {
  enum class Kind {
    lennard_jones,  // 4 epsilon ((sigma/r)^12 - (sigma/r)^6)
    coulomb         // strength q_i q_j / r
  };
  Kind kind = Kind::lennard_jones;
  Real epsilon, sigma;  // J, m
  Real strength;        // of Coulomb's, J m per square of the unit of charge
  std::optional<Real> cutoff;
  int exclude = 0;
};

/// stiffness (r_ij - length)^2 / 2 for pairs (i, j) of beads.
struct SpringPotential {
  Real stiffness, length;  // N/m, m
  std::vector<std::array<std::size_t, 2>> beads;
};

/// stiffness (theta - angle)^2 / 2 for triples (i, j, k) with the angle theta at j.
struct AnglePotential {
  Real stiffness, angle;  // J, rad
  std::vector<std::array<std::size_t, 3>> beads;
};

/// A uniform field on charges, -q_i E.r_i.
struct FieldPotential {
  std::vector<Real> strength;  // E
};

/// stiffness |r_i - center|^2 / 2 for every bead.
struct TrapPotential {
  Real stiffness;  // N/m
  std::vector<Real> center;
};

struct BeadRodDescription {
  std::string origin;  // what messages name: a file or a system
  int dimension = 2;
  std::vector<Real> masses;             // kg
  std::vector<Real> friction, charges;  // kg/s; one per bead, or empty where all are zero
  std::vector<Real> gravity;            // acceleration, m/s^2, or empty
  std::vector<Anchor> anchors;
  std::vector<Rod> rods;
  std::vector<Real> positions, momenta;  // bead by bead, m and kg m/s
  std::vector<PairPotential> pairs;
  std::vector<SpringPotential> springs;
  std::vector<AnglePotential> angles;
  std::vector<FieldPotential> fields;
  std::vector<TrapPotential> traps;

  [[nodiscard]] std::size_t beads() const { return masses.size(); }
  [[nodiscard]] std::size_t points() const { return masses.size() + anchors.size(); }
  [[nodiscard]] std::size_t axes() const { return static_cast<std::size_t>(dimension); }
  /// Coordinate `axis` of a bead where it starts, or of an anchor.
  [[nodiscard]] const Real& coordinate(std::size_t point, std::size_t axis) const {
    return point < beads() ? positions[point * axes() + axis] : anchors[point - beads()].position[axis];
  }
  /// The distance of two points at the start.
  [[nodiscard]] Real distance(std::size_t a, std::size_t b) const;
  /// "bead 3" or "anchor 'origin'".
  [[nodiscard]] std::string name_of(std::size_t point) const;
  /// Refuses a description that makes no sense, part by part: InputError "ORIGIN: rods[2]: ...".
  void check() const;
};

/// What the constraints of a bead-rod model are beside constraints: they tell the description that the model
/// was made of.
class DescribedByRods {
 public:
  DescribedByRods() = default;
  DescribedByRods(const DescribedByRods&) = delete;
  DescribedByRods& operator=(const DescribedByRods&) = delete;
  virtual ~DescribedByRods() = default;
  [[nodiscard]] virtual const BeadRodDescription& description() const = 0;
};

}  // namespace pfaff
