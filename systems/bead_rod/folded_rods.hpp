// Whole right-hand sides for rods that form paths and rings, in doubles: those of every path and ring
// (folded_path.hpp, folded_ring.hpp), and those of the beads that no rod holds.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include <pfaff/core/facets/holonomic.hpp>
#include <pfaff/systems/bead_rod/folded_path.hpp>
#include <pfaff/systems/bead_rod/folded_ring.hpp>

namespace pfaff {

template <int D>
class FoldedRods {
 public:
  /// Holds no rods.
  FoldedRods() = default;
  FoldedRods(const BeadRodDescription& d, const RodGraph& graph) {
    const auto fits = [&](const RodPath& path) { return FoldedPath<D>::fits(d, path); };
    if (!std::ranges::all_of(graph.paths(), fits)) return;
    std::vector<bool> joined(d.beads(), false);
    for (const RodPath& path : graph.paths()) {
      paths_.emplace_back(d, path);
      for (const std::size_t point : path.points)
        if (point < d.beads()) joined[point] = true;
    }
    for (const RodPath& ring : graph.rings()) {
      rings_.emplace_back(d, ring);
      for (const std::size_t point : ring.points) joined[point] = true;
    }
    for (std::size_t i = 0; i < d.beads(); ++i)
      if (!joined[i]) lone_.push_back({i * D, 1 / d.masses[i].value()});
  }

  /// True where all rods are parts of paths and rings that can be folded. The rest is for such rods alone.
  [[nodiscard]] bool holds_all() const { return !paths_.empty() || !rings_.empty(); }
  /// True where respond() works: rings do not tell how they respond.
  [[nodiscard]] bool responds() const { return rings_.empty(); }

  /// The forces on the beads, to be set before rates are asked for.
  void set_forces(In<double> f) {
    for (auto& path : paths_) path.set_forces(f.data());
    for (auto& ring : rings_) ring.set_forces(f.data());
    for (LoneBead& bead : lone_) std::copy_n(f.begin() + bead.offset, D, bead.force.begin());
  }
  /// Dirac's equations, nguyen-turski (4.2). False where S has no factors.
  bool dirac(In<double> q, In<double> p, Out<double> q_rate, Out<double> p_rate) {
    return rates(p, q_rate, p_rate,
                 [&](auto& rods) { return rods.dirac(q.data(), p.data(), q_rate.data(), p_rate.data()); });
  }
  /// Lagrange's, (A.5). False where S has no factors.
  bool multipliers(In<double> q, In<double> p, Out<double> q_rate, Out<double> p_rate) {
    return rates(p, q_rate, p_rate, [&](auto& rods) {
      return rods.multipliers(q.data(), p.data(), q_rate.data(), p_rate.data());
    });
  }
  /// rest = f - B^T S^-1 B M^-1 f of forces f on the beads, with the factors that multipliers() has left.
  void respond(In<double> f, Out<double> rest) {
    for (auto& path : paths_) path.respond(f.data(), rest.data());
    for (const LoneBead& bead : lone_) std::copy_n(f.begin() + bead.offset, D, rest.begin() + bead.offset);
  }

 private:
  struct LoneBead {
    std::size_t offset;
    double inverse_mass;
    std::array<double, D> force{};
  };

  template <class Use>
  bool rates(In<double> p, Out<double> q_rate, Out<double> p_rate, const Use& use) {
    bool regular = true;
    for (auto& path : paths_) regular &= use(path);
    for (auto& ring : rings_) regular &= use(ring);
    for (const LoneBead& bead : lone_)
      for (std::size_t k = 0; k < D; ++k) {
        q_rate[bead.offset + k] = bead.inverse_mass * p[bead.offset + k];
        p_rate[bead.offset + k] = bead.force[k];
      }
    return regular;
  }

  std::vector<FoldedPath<D>> paths_;
  std::vector<FoldedRing<D>> rings_;
  std::vector<LoneBead> lone_;
};

}  // namespace pfaff
