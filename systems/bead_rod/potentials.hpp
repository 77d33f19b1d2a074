// The energies of beads apart from the rods', and their forces, for one scalar.
//
//   gravity          -m_i g.r_i
//   Lennard-Jones    4 epsilon ((sigma/r)^12 - (sigma/r)^6)    (nguyen-turski section 4, absorbing the 4)
//   Coulomb          k q_i q_j / r
//   spring           k (r - l)^2 / 2
//   harmonic angle   k (theta - theta_0)^2 / 2
//   uniform field    -q_i E.r_i
//   trap             k |r_i - c|^2 / 2
//
// Pairs with a cut-off are found by cells, O(N); without one all pairs are visited, O(N^2). Formulas that are
// being recorded have no numbers to sort: they visit all pairs and leave out by select().
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include <pfaff/core/errors/status.hpp>
#include <pfaff/core/numbers/elliptic.hpp>
#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/systems/bead_rod/cell_list.hpp>
#include <pfaff/systems/bead_rod/description.hpp>
#include <pfaff/systems/bead_rod/graph.hpp>

namespace pfaff {

/// The pairs (i, j), i < j, that a pair potential leaves out: of bead i, excluded_[start_[i] .. start_[i +
/// 1]).
class Exclusions {
 public:
  Exclusions(const BeadRodDescription& description, const RodGraph& graph, int distance)
      : start_(description.beads() + 1) {
    for (std::uint32_t i = 0; i < description.beads(); ++i) {
      if (distance > 0)
        for (const std::uint32_t j : graph.within(i, distance)) excluded_.push_back(j);
      start_[i + 1] = static_cast<std::uint32_t>(excluded_.size());
    }
  }
  [[nodiscard]] bool leaves_out(std::size_t i, std::size_t j) const {
    for (std::uint32_t k = start_[i]; k < start_[i + 1]; ++k)
      if (excluded_[k] == j) return true;
    return false;
  }

 private:
  std::vector<std::uint32_t> start_, excluded_;
};

template <class T, int D>
class Potentials {
 public:
  Potentials(std::shared_ptr<const BeadRodDescription> description, const RodGraph& graph)
      : description_(std::move(description)) {
    const BeadRodDescription& d = *description_;
    if (!d.gravity.empty())
      for (std::size_t i = 0; i < d.beads(); ++i)
        for (std::size_t k = 0; k < D; ++k) weight_.push_back(T(d.masses[i]) * d.gravity[k]);
    for (const Real& q : d.charges) charge_.push_back(T(q));
    for (const PairPotential& p : d.pairs) {
      Pairs pairs{p.kind == PairPotential::Kind::lennard_jones,
                  p.cutoff.has_value(),
                  T(4) * T(p.epsilon),
                  T(p.sigma) * T(p.sigma),
                  T(p.strength),
                  T(0),
                  T(0),
                  p.cutoff ? p.cutoff->value() : 0.0,
                  Exclusions(d, graph, p.exclude)};
      if (p.cutoff) {
        pairs.cutoff_square = T(*p.cutoff) * T(*p.cutoff);
        pairs.shift = pairs.energy(pairs.cutoff_square);
      }
      pairs_.push_back(std::move(pairs));
    }
    const bool short_ranged = std::any_of(pairs_.begin(), pairs_.end(), [](const Pairs& p) { return p.cut; });
    if (sortable && short_ranged) cells_ = std::make_unique<CellList<D>>(d.beads());
  }

  /// True where there is no energy but gravity's, so that forces are constant.
  [[nodiscard]] bool constant() const {
    const BeadRodDescription& d = *description_;
    return pairs_.empty() && d.springs.empty() && d.angles.empty() && d.traps.empty();
  }

  /// f = -dV/dq. `non_finite` where a pair is at distance zero or a position is not finite.
  Status forces(In<T> q, Out<T> f) {
    start_forces(f);
    bool regular = true;
    for (const Pairs& p : pairs_)
      regular &=
          visit(p, q, [&](std::size_t i, std::size_t j, const Arm& arm, const T& square, const T& share) {
            T slope = share * p.slope(square);
            if (!p.neutral) slope = slope * (charge_[i] * charge_[j]);
            push(f, i, j, slope, arm);
          });
    regular &= spring_forces(q, f);
    regular &= angle_forces(q, f);
    return regular ? Status::converged : Status::non_finite;
  }

  /// V(q); not finite where a pair is at distance zero.
  T energy(In<T> q) {
    const BeadRodDescription& d = *description_;
    T sum(0);
    for (std::size_t i = 0; i < weight_.size(); ++i) sum = sum - weight_[i] * q[i];
    for (const Pairs& p : pairs_) {
      T part(0);
      visit(p, q, [&](std::size_t i, std::size_t j, const Arm& /*arm*/, const T& square, const T& share) {
        const T e = share * (p.energy(square) - p.shift);
        part = part + (p.neutral ? e : e * (charge_[i] * charge_[j]));
      });
      sum = sum + part;
    }
    for (const SpringPotential& s : d.springs)
      for (const auto& [i, j] : s.beads) {
        const T stretch = sqrt(square_of(arm_between(q, i, j))) - T(s.length);
        sum = sum + s.stiffness * (stretch * stretch) / 2;
      }
    for (const AnglePotential& a : d.angles)
      for (const auto& [i, j, k] : a.beads) {
        const T bend = corner(arm_between(q, i, j), arm_between(q, k, j)).angle - T(a.angle);
        sum = sum + a.stiffness * (bend * bend) / 2;
      }
    for (const FieldPotential& e : d.fields)
      for (std::size_t i = 0; i < charge_.size(); ++i)
        for (std::size_t k = 0; k < D; ++k) sum = sum - charge_[i] * (e.strength[k] * q[i * D + k]);
    for (const TrapPotential& s : d.traps)
      for (std::size_t i = 0; i < d.beads(); ++i)
        for (std::size_t k = 0; k < D; ++k) {
          const T away = q[i * D + k] - T(s.center[k]);
          sum = sum + s.stiffness * (away * away) / 2;
        }
    return sum;
  }

 private:
  using Arm = std::array<T, D>;
  // Formulas that are being recorded have no numbers to sort by.
  static constexpr bool sortable = std::numeric_limits<Value<T>>::is_specialized;

  struct Pairs {
    bool neutral, cut;
    T four_epsilon, sigma_square, strength, cutoff_square, shift;
    double width;
    Exclusions exclusions;

    /// The energy at distance sqrt(square), of charges 1.
    [[nodiscard]] T energy(const T& square) const {
      if (!neutral) return strength / sqrt(square);
      const T ratio = sigma_square / square, third = ratio * ratio * ratio;
      return four_epsilon * (third * (third - T(1)));
    }
    /// -2 dE/d(square).
    [[nodiscard]] T slope(const T& square) const {
      if (!neutral) return strength / (square * sqrt(square));
      const T ratio = sigma_square / square, third = ratio * ratio * ratio;
      return four_epsilon * (T(6) * third * (T(2) * third - T(1))) / square;
    }
  };

  static Arm arm_between(In<T> q, std::size_t i, std::size_t j) {
    Arm arm;
    for (std::size_t k = 0; k < D; ++k) arm[k] = q[i * D + k] - q[j * D + k];
    return arm;
  }
  static T dot(const Arm& a, const Arm& b) {
    T sum = a[0] * b[0];
    for (std::size_t k = 1; k < D; ++k) sum = sum + a[k] * b[k];
    return sum;
  }
  static T square_of(const Arm& a) { return dot(a, a); }
  static void push(Out<T> f, std::size_t i, std::size_t j, const T& strength, const Arm& arm) {
    for (std::size_t k = 0; k < D; ++k) {
      f[i * D + k] = f[i * D + k] + strength * arm[k];
      f[j * D + k] = f[j * D + k] - strength * arm[k];
    }
  }
  static bool is_zero(const T& square) {
    if constexpr (sortable) return !(value_of(square) > Value<T>(0));
    return false;
  }

  // Calls use(i, j, r_i - r_j, |r_i - r_j|^2, share) for the pairs of p. The share is 1, but a formula that
  // is being recorded cannot skip the pairs beyond the cut-off and gets them with a share of 0. False where a
  // pair is at distance zero or not a number.
  template <class Use>
  bool visit(const Pairs& p, In<T> q, const Use& use) {
    bool regular = true;
    const std::size_t beads = description_->beads();
    const auto meet = [&](std::size_t i, std::size_t j) {
      const Arm arm = arm_between(q, i, j);
      const T square = square_of(arm);
      if constexpr (sortable) {
        if (p.cut && value_of(square) > value_of(p.cutoff_square)) return;
        if (p.exclusions.leaves_out(i, j)) return;
        regular &= !is_zero(square);
        use(i, j, arm, square, T(1));
      } else if (!p.exclusions.leaves_out(i, j)) {
        use(i, j, arm, square, p.cut ? select(p.cutoff_square - square, T(1), T(0)) : T(1));
      }
    };
    if constexpr (sortable) {
      if (p.cut) {
        const auto position = [&](std::size_t i, std::size_t axis) {
          return static_cast<double>(value_of(q[i * D + axis]));
        };
        // The cells are a little wider than the cut-off: quad positions round when they are sorted.
        if (!cells_->fill(p.width * (1 + 1e-9), position)) return false;
        cells_->each_pair(meet);
        return regular;
      }
    }
    for (std::size_t i = 0; i < beads; ++i)
      for (std::size_t j = i + 1; j < beads; ++j) meet(i, j);
    return regular;
  }

  void start_forces(Out<T> f) const {
    const BeadRodDescription& d = *description_;
    for (std::size_t i = 0; i < d.beads() * D; ++i) f[i] = weight_.empty() ? T(0) : weight_[i];
    for (const FieldPotential& e : d.fields)
      for (std::size_t i = 0; i < charge_.size(); ++i)
        for (std::size_t k = 0; k < D; ++k) f[i * D + k] = f[i * D + k] + charge_[i] * e.strength[k];
  }

  bool spring_forces(In<T> q, Out<T> f) const {
    bool regular = true;
    for (const SpringPotential& s : description_->springs)
      for (const auto& [i, j] : s.beads) {
        const Arm arm = arm_between(q, i, j);
        const T square = square_of(arm), distance = sqrt(square);
        regular &= !is_zero(square);
        push(f, i, j, s.stiffness * ((T(s.length) - distance) / distance), arm);
      }
    for (const TrapPotential& s : description_->traps)
      for (std::size_t i = 0; i < description_->beads(); ++i)
        for (std::size_t k = 0; k < D; ++k)
          f[i * D + k] = f[i * D + k] - s.stiffness * (q[i * D + k] - T(s.center[k]));
    return regular;
  }

  // The angle theta between two arms, 0 .. pi, and sin theta; where that is 0, `safe_sine` is 1.
  struct Corner {
    T angle, cosine, safe_sine, length_a, length_b;
  };
  static Corner corner(const Arm& a, const Arm& b) {
    T cross(0);  // |a x b|^2: its own sum of squares, as 1 - cos^2 would cancel
    for (std::size_t k = 0; k < D; ++k)
      for (std::size_t l = k + 1; l < D; ++l) {
        const T area = a[k] * b[l] - a[l] * b[k];
        cross = cross + area * area;
      }
    Corner c;
    c.length_a = sqrt(square_of(a));
    c.length_b = sqrt(square_of(b));
    const T product = c.length_a * c.length_b;
    const T sine = sqrt(select(cross, cross, T(1))) / product;
    c.cosine = dot(a, b) / product;
    c.safe_sine = select(cross, sine, T(1));
    c.angle = angle_of(c.cosine, select(cross, sine, T(0)));
    return c;
  }
  // d theta/da = -(b/|b| - cos theta a/|a|) / (|a| sin theta): where the arms are in line its numerator is 0,
  // and so is the force.
  bool angle_forces(In<T> q, Out<T> f) const {
    bool regular = true;
    for (const AnglePotential& p : description_->angles)
      for (const auto& [i, j, k] : p.beads) {
        const Arm a = arm_between(q, i, j), b = arm_between(q, k, j);
        regular &= !is_zero(square_of(a)) && !is_zero(square_of(b));
        const Corner c = corner(a, b);
        const T moment = p.stiffness * ((c.angle - T(p.angle)) / c.safe_sine);
        for (std::size_t x = 0; x < D; ++x) {
          const T along_a = a[x] / c.length_a, along_b = b[x] / c.length_b;
          const T on_i = moment * ((along_b - c.cosine * along_a) / c.length_a);
          const T on_k = moment * ((along_a - c.cosine * along_b) / c.length_b);
          f[i * D + x] = f[i * D + x] + on_i;
          f[k * D + x] = f[k * D + x] + on_k;
          f[j * D + x] = f[j * D + x] - (on_i + on_k);
        }
      }
    return regular;
  }

  std::shared_ptr<const BeadRodDescription> description_;
  std::vector<T> weight_, charge_;
  std::vector<Pairs> pairs_;
  std::unique_ptr<CellList<D>> cells_;
};

}  // namespace pfaff
