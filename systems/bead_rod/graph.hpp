// The rods of a bead-rod system as a graph: which rods share a bead, and so where S = B M^-1 B^T has entries.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <pfaff/core/linear/symmetric_pattern.hpp>
#include <pfaff/systems/bead_rod/description.hpp>

namespace pfaff {

/// Two rods k < l that share a bead. The sign is +1 where the bead is an end of the same kind (first or
/// second) of both, -1 otherwise.
struct RodCoupling {
  std::uint32_t k = 0, l = 0, bead = 0;
  bool same_side = false;
};

/// A path through a graph of rods: points in order, of which only the ends may be anchors.
struct RodPath {
  std::vector<std::size_t> points;
};

class RodGraph {
 public:
  explicit RodGraph(const BeadRodDescription& description);

  [[nodiscard]] const std::shared_ptr<const SymmetricPattern>& pattern() const { return pattern_; }
  /// In the order of the pattern's couplings.
  [[nodiscard]] const std::vector<RodCoupling>& couplings() const { return couplings_; }
  /// The beads joined to `bead` by at most `distance` rods, larger numbers only, ascending. Ways through an
  /// anchor do not count.
  [[nodiscard]] std::vector<std::uint32_t> within(std::uint32_t bead, int distance) const;
  /// The rods as paths and rings, where they are nothing else; empty where rods branch. The first and the
  /// last point of a ring are joined.
  [[nodiscard]] const std::vector<RodPath>& paths() const { return paths_; }
  [[nodiscard]] const std::vector<RodPath>& rings() const { return rings_; }

 private:
  std::size_t beads_;
  std::shared_ptr<const SymmetricPattern> pattern_;
  std::vector<RodCoupling> couplings_;
  std::vector<RodPath> paths_, rings_;
  std::vector<std::uint32_t> start_, neighbour_;  // of bead i: neighbour_[start_[i] .. start_[i + 1])
};

/// Sets of rods whose constraints depend on each other where the beads start (S is singular there), one set
/// for every constraint too many, each in ascending order; empty where there are none.
std::vector<std::vector<std::size_t>> redundant_rods(const BeadRodDescription& description,
                                                     const RodGraph& graph);

}  // namespace pfaff
