// The linear maps between one number for each rod and one vector for each bead, such as B and B^T, and the
// directions of the rods that they are made of.
//
// For a general graph they are loops over rods. In a chain, whose rods follow one another from an anchor or
// from a free bead, they go from bead to bead and keep what two neighbouring rods share in registers.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <pfaff/core/facets/scalars.hpp>
#include <pfaff/systems/bead_rod/description.hpp>

namespace pfaff {

template <class T, int D>
class RodMaps {
 public:
  using Arm = std::array<T, D>;
  /// Points of a rod, beads before anchors.
  struct Ends {
    std::uint32_t first, second;
  };

  explicit RodMaps(const BeadRodDescription& d)
      : beads_(d.beads()),
        inverse_mass_(d.points(), T(0)),
        positions_(d.points() * D, T(0)),
        velocities_(positions_) {
    for (std::size_t i = 0; i < beads_; ++i) inverse_mass_[i] = T(1) / T(d.masses[i]);
    for (std::size_t i = beads_; i < d.points(); ++i)
      for (std::size_t x = 0; x < D; ++x) positions_[i * D + x] = T(d.coordinate(i, x));
    for (const Rod& rod : d.rods)
      ends_.push_back({static_cast<std::uint32_t>(rod.first), static_cast<std::uint32_t>(rod.second)});
    find_chain();
  }

  [[nodiscard]] std::size_t count() const { return ends_.size(); }
  [[nodiscard]] std::size_t degrees() const { return beads_ * D; }
  [[nodiscard]] const Ends& ends(std::size_t k) const { return ends_[k]; }
  /// 1/m of a point; 0 of an anchor.
  [[nodiscard]] const T& inverse_mass(std::size_t point) const { return inverse_mass_[point]; }

  static T dot(const Arm& a, const Arm& b) {
    T sum = a[0] * b[0];
    for (std::size_t x = 1; x < D; ++x) sum = sum + a[x] * b[x];
    return sum;
  }

  /// v = M^-1 p.
  void velocity(In<T> p, Out<T> v) const {
    for (std::size_t i = 0, at = 0; i < beads_; ++i)
      for (std::size_t x = 0; x < D; ++x, ++at) v[at] = inverse_mass_[i] * p[at];
  }
  /// use(k, D_k) with the direction D_k = r_a - r_b of every rod.
  template <class Use>
  void each_direction(In<T> q, const Use& use) {
    if (chain_) {
      each_link(
          anchor_, [&](std::size_t at) { return q[at]; }, use);
      return;
    }
    std::copy(q.begin(), q.end(), positions_.begin());
    for (std::size_t k = 0; k < ends_.size(); ++k) use(k, difference(positions_, k));
  }
  /// use(k, D_k, V_k) with V_k = v_a - v_b too.
  template <class Use>
  void each_turning(In<T> q, In<T> p, const Use& use) {
    velocity(p, Out<T>(velocities_).first(degrees()));
    each_direction(q, [&](std::size_t k, const Arm& e) { use(k, e, difference(velocities_, k)); });
  }
  /// v of each_turning.
  [[nodiscard]] std::span<const T> velocities() const {
    return std::span<const T>(velocities_).first(degrees());
  }
  /// Of rod k, x_a - x_b, with x given for all points.
  [[nodiscard]] Arm difference(const std::vector<T>& of, std::size_t k) const {
    const std::size_t a = ends_[k].first * D, b = ends_[k].second * D;
    Arm r;
    for (std::size_t x = 0; x < D; ++x) r[x] = of[a + x] - of[b + x];
    return r;
  }

  /// r_k = rows_k.(u_a - u_b), with u divided by the masses first where Weighted.
  template <bool Weighted>
  void rows_times(const std::vector<Arm>& rows, In<T> u, Out<T> r) const {
    if (chain_) {
      each_link(
          Arm{}, [&](std::size_t at) { return Weighted ? T(inverse_mass_[at / D] * u[at]) : u[at]; },
          [&](std::size_t k, const Arm& difference) { r[k] = dot(rows[k], difference); });
      return;
    }
    for (std::size_t k = 0; k < ends_.size(); ++k) {
      const auto [a, b] = ends_[k];
      T at_a(0), at_b(0);
      for (std::size_t x = 0; x < D; ++x) at_a = at_a + rows[k][x] * u[a * D + x];
      if (b < beads_)
        for (std::size_t x = 0; x < D; ++x) at_b = at_b + rows[k][x] * u[b * D + x];
      r[k] = Weighted ? inverse_mass_[a] * at_a - inverse_mass_[b] * at_b : at_a - at_b;
    }
  }
  /// f = sum_k rows_k x_k at a_k, and its negative at b_k; divided by the masses where Weighted.
  template <bool Weighted>
  void columns_times(const std::vector<Arm>& rows, In<T> x, Out<T> f) const {
    if (chain_) {
      chain_columns_times<Weighted>(rows, x, f);
      return;
    }
    for (T& y : f) y = T(0);
    for (std::size_t k = 0; k < ends_.size(); ++k) {
      const auto [a, b] = ends_[k];
      for (std::size_t i = 0; i < D; ++i) {
        const T push = rows[k][i] * x[k];
        f[a * D + i] = f[a * D + i] + push;
        if (b < beads_) f[b * D + i] = f[b * D + i] - push;
      }
    }
    if constexpr (Weighted) velocity(f, f);
  }

 private:
  // Rod k of a chain joins bead k + free_ and the one before it, in either direction; without a free bead the
  // first joins bead 0 and an anchor.
  void find_chain() {
    if (ends_.empty() || ends_.size() > beads_ || ends_.size() + 1 < beads_) return;
    free_ = beads_ - ends_.size();
    for (std::size_t k = 0; k < ends_.size(); ++k) {
      const std::size_t later = k + free_;
      later_first_.push_back(ends_[k].first == later ? 1 : 0);
      if (later_first_[k] == 0 && ends_[k].second != later) return;
      const std::size_t earlier = later_first_[k] != 0 ? ends_[k].second : ends_[k].first;
      if (later == 0 ? earlier < beads_ : earlier != later - 1) return;
    }
    chain_ = true;
    if (free_ == 0)
      for (std::size_t x = 0; x < D; ++x) anchor_[x] = positions_[ends_[0].second * D + x];
  }
  // use(k, x_a - x_b) along a chain, with x = of(at) of beads and `anchored` of its anchor.
  template <class Of, class Use>
  void each_link(const Arm& anchored, const Of& of, const Use& use) const {
    Arm before;
    for (std::size_t x = 0; x < D; ++x) before[x] = free_ == 1 ? T(of(x)) : anchored[x];
    for (std::size_t k = 0, at = free_ * D; k < ends_.size(); ++k) {
      Arm link;
      for (std::size_t x = 0; x < D; ++x, ++at) {
        const T here = of(at);
        link[x] = here - before[x];
        before[x] = here;
      }
      if (later_first_[k] == 0)
        for (T& x : link) x = -x;
      use(k, link);
    }
  }
  template <bool Weighted>
  void chain_columns_times(const std::vector<Arm>& rows, In<T> x, Out<T> f) const {
    Arm beyond;  // of the rod after the bead
    for (T& y : beyond) y = T(0);
    for (std::size_t i = beads_; i-- > free_;) {
      const std::size_t k = i - free_;
      const T at_later = later_first_[k] != 0 ? x[k] : T(-x[k]);
      for (std::size_t axis = 0; axis < D; ++axis) {
        const T push = rows[k][axis] * at_later, sum = push - beyond[axis];
        f[i * D + axis] = Weighted ? T(inverse_mass_[i] * sum) : sum;
        beyond[axis] = push;
      }
    }
    if (free_ == 0) return;
    for (std::size_t axis = 0; axis < D; ++axis)
      f[axis] = Weighted ? T(-(inverse_mass_[0] * beyond[axis])) : T(-beyond[axis]);
  }

  std::size_t beads_;
  std::vector<T> inverse_mass_, positions_, velocities_;  // of all points
  std::vector<Ends> ends_;
  bool chain_ = false;
  std::size_t free_ = 0;                   // 1: the chain begins with a free bead
  std::vector<std::uint8_t> later_first_;  // of rods of a chain: the first end is the later bead
  Arm anchor_{};                           // where a chain without a free bead hangs
};

}  // namespace pfaff
