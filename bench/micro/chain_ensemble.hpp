// Dirac's equations (nguyen-turski (4.2)) of several hanging chains of rods at once, one chain in each lane
// of a pack; each is eliminated from its anchor.
#pragma once

#include <cstddef>
#include <vector>

#include <pfaff/core/numbers/pack.hpp>

#include "direction.hpp"
#include "rods.hpp"

namespace pfaff::micro {

/// Chains that move side by side, one in each lane of a pack. Divisions and other operations with a long
/// latency are made for all chains at once, so that no chain waits for them alone.
template <int D, int Lanes>
class Ensemble {
 public:
  using L = Pack<Lanes>;
  using Vec = Direction<L, D>;

  /// Copies of one chain.
  explicit Ensemble(const Rig<D>& rig)
      : size_(rig.size),
        gravity_(rig.gravity),
        inverse_mass_(size_),
        weight_(size_),
        rods_(size_),
        q_(size_),
        p_(size_),
        rate_q_(size_),
        rate_p_(size_) {
    for (std::size_t k = 0; k < size_; ++k) {
      inverse_mass_[k] = L(rig.inverse_masses[k]);
      weight_[k] = L(-gravity_ / rig.inverse_masses[k]);
      for (std::size_t d = 0; d < D; ++d) {
        q_[k][d] = L(rig.q[k * D + d]);
        p_[k][d] = L(rig.p[k * D + d]);
      }
    }
  }
  [[nodiscard]] Vec* state() { return q_.data(); }
  [[nodiscard]] double rate(std::size_t bead, std::size_t axis, bool of_momentum, std::size_t lane) const {
    return (of_momentum ? rate_p_ : rate_q_)[bead][axis][lane];
  }

  /// Evaluates the right-hand side of Dirac's equations (B2) for all chains.
  void dirac() {
    Vec r{}, v{}, direction{}, turning{};
    L w(0.0), inverse(0.0), y(0.0);
    for (std::size_t k = 0; k < size_; ++k) {
      Rod& rod = rods_[k];
      const L next_w = inverse_mass_[k];
      const Vec next_v = next_w * p_[k], e = q_[k] - r, u = next_v - v;
      const L b = w * dot(direction, e), lower = -(b * inverse), d = (w + next_w) * dot(e, e) + b * lower;
      rod.skew = w * (dot(direction, u) - dot(turning, e));
      rod.rate = k == 0 ? dot(u, u) - L(gravity_) * e[D - 1] : dot(u, u);
      y = dot(e, u) - lower * y;
      inverse = L(1.0) / d;
      rod.hidden = y;
      rod.lower = lower;
      rod.inverse = inverse;
      rod.direction = direction = e;
      rod.turning = turning = u;
      r = q_[k];
      v = next_v;
      w = next_w;
    }
    L mu = rods_.back().hidden * rods_.back().inverse;
    rods_.back().multiplier = mu;
    for (std::size_t k = size_ - 1; k-- > 0;) {
      mu = rods_[k].hidden * rods_[k].inverse - rods_[k + 1].lower * mu;
      rods_[k].multiplier = mu;
    }
    L before(0.0);
    y = L(0.0);
    for (std::size_t k = 0; k < size_; ++k) {
      Rod& rod = rods_[k];
      const L turned = k + 1 < size_ ? rods_[k + 1].skew * rods_[k + 1].multiplier - rod.skew * before
                                     : -(rod.skew * before);
      before = rod.multiplier;
      y = rod.rate - turned - rod.lower * y;
      rod.hidden = y;
    }
    L x(0.0);
    Vec pull{}, push{};
    for (std::size_t k = size_; k-- > 0;) {
      const Rod& rod = rods_[k];
      x = k + 1 < size_ ? rod.hidden * rod.inverse - rods_[k + 1].lower * x : rod.hidden * rod.inverse;
      const Vec next_pull = rod.multiplier * rod.direction;
      const Vec next_push = x * rod.direction - rod.multiplier * rod.turning;
      rate_q_[k] = inverse_mass_[k] * (p_[k] - (next_pull - pull));
      rate_p_[k] = push - next_push;
      rate_p_[k][D - 1] = rate_p_[k][D - 1] + weight_[k];
      pull = next_pull;
      push = next_push;
    }
  }

 private:
  struct Rod {
    Vec direction, turning;
    L lower, inverse, skew, hidden, rate, multiplier;
  };
  std::size_t size_;
  double gravity_;
  std::vector<L> inverse_mass_, weight_;
  std::vector<Rod> rods_;
  std::vector<Vec> q_, p_, rate_q_, rate_p_;
};

}  // namespace pfaff::micro
