// The right-hand sides of a hanging chain of rods as someone would write them for this system alone: Dirac's
// equations (nguyen-turski (4.2)) and Lagrange's multipliers (nguyen-turski (A.5)). S is tridiagonal. Its
// elimination runs from both ends at once, with the left half of the chain in one lane of a pack and the
// right half, mirrored, in the other, so that each division serves both halves.
#pragma once

#include <cstddef>
#include <vector>

#include <pfaff/core/numbers/pack.hpp>

#include "direction.hpp"
#include "rods.hpp"

namespace pfaff::micro {

/// The chain folded in the middle: lane 0 counts points from the anchor, lane 1 from the free end. A chain
/// with an odd number of rods gets an additional rod at the free end that is coupled to nothing, so that both
/// halves are equally long.
template <int D>
class HalvedChain {
 public:
  using L = Pack<2>;
  using Vec = Direction<L, D>;

  explicit HalvedChain(const Rig<D>& rig)
      : size_(rig.size),
        half_((rig.size + 1) / 2),
        odd_(rig.size % 2 == 1),
        gravity_(rig.gravity),
        inverse_mass_(half_ + 1),
        coupling_mass_(half_ + 1),
        weight_(half_ + 1),
        rods_(half_) {
    for (std::size_t j = 0; j <= half_; ++j) {
      L w(0.0);
      if (j > 0) w.set(0, rig.inverse_masses[j - 1]);
      if (j > 0 || !odd_) w.set(1, rig.inverse_masses[right(j) - 1]);
      inverse_mass_[j] = coupling_mass_[j] = w;
    }
    for (std::size_t j = 0; j <= half_; ++j) weight_[j] = L(-gravity_) / inverse_mass_[j];
    if (odd_) {  // the additional rod has an end of mass 1 and no neighbour
      inverse_mass_[0].set(1, 1);
      coupling_mass_[1].set(1, 0);
    }
  }

  /// Dirac's equations (B2): mu = S^-1 phi~, x = S^-1 (h - A mu), q' = v - M^-1 B^T mu, p' = f - B^T x + T^T
  /// mu.
  void dirac(const double* q, const double* p, double* rate_q, double* rate_p) {
    place(q, p);
    // The halves meet in the middle, where the last rods of both point at the same bead.
    Rod& last = rods_[half_ - 1];
    const double w = inverse_mass_[half_][0];
    const double b = w * across(last.direction, last.direction);
    const double a = w * (across(last.turning, last.direction) - across(last.direction, last.turning));
    const double determinant = 1 / (1 / (last.inverse[0] * last.inverse[1]) - b * b);
    const auto meet = [&](const L& y) {
      return L((y[0] / last.inverse[1] - b * y[1]) * determinant,
               (y[1] / last.inverse[0] - b * y[0]) * determinant);
    };
    L mu = meet(last.hidden);
    last.multiplier = mu;
    for (std::size_t j = half_ - 1; j-- > 0;) {
      mu = rods_[j].hidden * rods_[j].inverse - rods_[j + 1].lower * mu;
      rods_[j].multiplier = mu;
    }
    L y(0.0), before(0.0);
    for (std::size_t j = 0; j + 1 < half_; ++j) {
      Rod& rod = rods_[j];
      const L turned = rods_[j + 1].skew * rods_[j + 1].multiplier - rod.skew * before;
      before = rod.multiplier;
      y = rod.rate - turned - rod.lower * y;
      rod.reduced = y;
    }
    {
      L swapped;
      swapped.set(0, a * last.multiplier[1]);
      swapped.set(1, -a * last.multiplier[0]);
      y = last.rate - (swapped - last.skew * before) - last.lower * y;
    }
    L x = meet(y);
    Vec pull = last.multiplier * last.direction, push = x * last.direction - last.multiplier * last.turning;
    store_middle(pull, push, q, p, rate_q, rate_p);
    for (std::size_t j = half_ - 1; j > 0; --j) {
      const Rod& rod = rods_[j - 1];
      x = rod.reduced * rod.inverse - rods_[j].lower * x;
      const Vec pull_before = rod.multiplier * rod.direction;
      const Vec push_before = x * rod.direction - rod.multiplier * rod.turning;
      store(j, pull_before - pull, push_before - push, p, rate_q, rate_p);
      pull = pull_before;
      push = push_before;
    }
    store_end(pull, push, p, rate_q, rate_p);
  }

  /// Lagrange's multipliers (A5): x = S^-1 h, q' = v, p' = f - B^T x.
  void multipliers(const double* q, const double* p, double* rate_q, double* rate_p) {
    place_for_multipliers(q, p);
    Rod& last = rods_[half_ - 1];
    const double b = inverse_mass_[half_][0] * across(last.direction, last.direction);
    const double determinant = 1 / (1 / (last.inverse[0] * last.inverse[1]) - b * b);
    L x;
    x.set(0, (last.rate[0] / last.inverse[1] - b * last.rate[1]) * determinant);
    x.set(1, (last.rate[1] / last.inverse[0] - b * last.rate[0]) * determinant);
    const Vec none{};
    Vec push = x * last.direction;
    store_middle(none, push, q, p, rate_q, rate_p);
    for (std::size_t j = half_ - 1; j > 0; --j) {
      const Rod& rod = rods_[j - 1];
      x = rod.rate * rod.inverse - rods_[j].lower * x;
      const Vec push_before = x * rod.direction;
      store(j, none, push_before - push, p, rate_q, rate_p);
      push = push_before;
    }
    store_end(none, push, p, rate_q, rate_p);
  }

 private:
  struct Rod {
    Vec direction, turning;
    L lower, inverse, skew, hidden, rate, multiplier, reduced;
  };
  // Point j of the right lane in the order from the anchor, which is point 0.
  [[nodiscard]] std::size_t right(std::size_t j) const { return size_ + (odd_ ? 1 : 0) - j; }
  static double across(const Vec& a, const Vec& b) {
    double sum = 0;
    for (std::size_t d = 0; d < D; ++d) sum += a[d][0] * b[d][1];
    return sum;
  }
  [[nodiscard]] Vec load(std::size_t j, const double* x) const {
    Vec r;
    for (std::size_t d = 0; d < D; ++d) r[d] = L(x[(j - 1) * D + d], x[(right(j) - 1) * D + d]);
    return r;
  }
  [[nodiscard]] Vec load_end(const double* x, double beyond) const {
    Vec r;
    for (std::size_t d = 0; d < D; ++d) r[d].set(1, x[(size_ - 1) * D + d] + (odd_ && d == 0 ? beyond : 0.0));
    return r;
  }
  void place(const double* q, const double* p) { eliminate<true>(q, p); }
  void place_for_multipliers(const double* q, const double* p) { eliminate<false>(q, p); }

  template <bool Dirac>
  void eliminate(const double* q, const double* p) {
    Vec r = load_end(q, 1), v = load_end(p, 0);
    L w = inverse_mass_[0];
    v = (odd_ ? inverse_mass_[1] : w) * v;
    Vec direction{}, turning{};
    L inverse(0.0), y(0.0), z(0.0);
    for (std::size_t j = 0; j < half_; ++j) {
      Rod& rod = rods_[j];
      const L next_w = inverse_mass_[j + 1];
      const Vec next_r = load(j + 1, q), next_v = next_w * load(j + 1, p);
      const Vec e = next_r - r, u = next_v - v;
      const L b = -coupling_mass_[j] * dot(direction, e);
      const L lower = b * inverse;
      const L d = (w + next_w) * dot(e, e) - b * lower;
      L rate = dot(u, u);
      if (j == 0) rate = rate - L(gravity_, 0) * e[D - 1];
      inverse = L(1.0) / d;
      if constexpr (Dirac) {
        rod.skew = -coupling_mass_[j] * (dot(turning, e) - dot(direction, u));
        y = dot(e, u) - lower * y;
        rod.hidden = y;
        rod.turning = u;
        rod.rate = rate;
      } else {
        z = rate - lower * z;
        rod.rate = z;
      }
      rod.lower = lower;
      rod.inverse = inverse;
      rod.direction = e;
      r = next_r;
      v = next_v;
      w = next_w;
      direction = e;
      turning = u;
    }
  }
  void store_one(std::size_t j, std::size_t point, std::size_t lane, const Vec& pull, const Vec& push,
                 const double* p, double* rate_q, double* rate_p) const {
    const std::size_t at = (point - 1) * D;
    const double w = inverse_mass_[j][lane];
    for (std::size_t d = 0; d < D; ++d) {
      rate_q[at + d] = w * (p[at + d] - pull[d][lane]);
      rate_p[at + d] = (d == D - 1 ? weight_[j][lane] : 0.0) - push[d][lane];
    }
  }
  void store(std::size_t j, const Vec& pull, const Vec& push, const double* p, double* rate_q,
             double* rate_p) const {
    const L w = inverse_mass_[j];
    const std::size_t left = (j - 1) * D, far = (right(j) - 1) * D;
    const Vec momentum = load(j, p);
    for (std::size_t d = 0; d < D; ++d) {
      const L fast = w * (momentum[d] - pull[d]);
      const L slow = d == D - 1 ? weight_[j] - push[d] : -push[d];
      rate_q[left + d] = fast[0];
      rate_q[far + d] = fast[1];
      rate_p[left + d] = slow[0];
      rate_p[far + d] = slow[1];
    }
  }
  void store_middle(const Vec& pull, const Vec& push, const double* /*q*/, const double* p, double* rate_q,
                    double* rate_p) const {
    Vec both_pull = pull, both_push = push;
    for (std::size_t d = 0; d < D; ++d) {
      both_pull[d].set(0, pull[d][0] + pull[d][1]);
      both_push[d].set(0, push[d][0] + push[d][1]);
    }
    store_one(half_, half_, 0, both_pull, both_push, p, rate_q, rate_p);
  }
  void store_end(const Vec& pull, const Vec& push, const double* p, double* rate_q, double* rate_p) const {
    if (odd_) return;
    const Vec none{};
    store_one(0, size_, 1, none - pull, none - push, p, rate_q, rate_p);
  }

  std::size_t size_, half_;
  bool odd_;
  double gravity_;
  std::vector<L> inverse_mass_, coupling_mass_, weight_;
  std::vector<Rod> rods_;
};

}  // namespace pfaff::micro
