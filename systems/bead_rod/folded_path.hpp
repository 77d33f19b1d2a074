// Whole right-hand sides for a path of rods, in doubles: nguyen-turski (4.2) and (A.5) without friction.
//
//   Dirac         mu = S^-1 phi~, x = S^-1 (h - A mu), q' = v - M^-1 B^T mu, p' = f - B^T x + T^T mu
//   multipliers   x = S^-1 h, q' = v, p' = f - B^T x
//
// S and A are tridiagonal. The path is folded in the middle: one lane of a pack goes through the left half
// and the other through the mirrored right half, so that both halves share the wait for each division of an
// elimination. A path with an odd number of rods gets one more at the right end, to make the halves equally
// long. It is coupled to nothing: its end is a point of mass 1 beside the last bead, which moves with that
// bead.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <pfaff/systems/bead_rod/description.hpp>
#include <pfaff/systems/bead_rod/folded_rows.hpp>
#include <pfaff/systems/bead_rod/graph.hpp>

namespace pfaff {

template <int D>
class FoldedPath {
 public:
  /// True where the path can be folded. An odd number of rods between two anchors cannot: no end is a bead,
  /// beside which the additional rod would stand.
  static bool fits(const BeadRodDescription& d, const RodPath& path) {
    const bool odd = path.points.size() % 2 == 0;
    return !(odd && path.points.front() >= d.beads() && path.points.back() >= d.beads());
  }

  FoldedPath(const BeadRodDescription& d, RodPath path)
      : rods_(path.points.size() - 1),
        half_((rods_ + 1) / 2),
        odd_(rods_ % 2 == 1),
        inverse_mass_(half_ + 1),
        coupling_mass_(half_ + 1),
        force_(half_ + 1),
        acceleration_(half_ + 1),
        work_(half_) {
    if (odd_ && path.points.back() >= d.beads()) std::reverse(path.points.begin(), path.points.end());
    const auto inverse_mass = [&](std::size_t point) {
      return point < d.beads() ? 1 / d.masses[point].value() : 0.0;
    };
    const auto offset = [&](std::size_t point) {
      return point < d.beads() ? static_cast<std::uint32_t>(point * D) : fixed;
    };
    for (std::size_t j = 0; j <= half_; ++j) {
      const bool beyond = odd_ && j == 0;
      const std::size_t left = path.points[j], right = beyond ? left : path.points[mirrored(j)];
      inverse_mass_[j] = L(inverse_mass(left), beyond ? 1.0 : inverse_mass(right));
      coupling_mass_[j] = L(inverse_mass(left), odd_ && j == 1 ? 0.0 : inverse_mass(right));
      offsets_.push_back({offset(left), beyond ? fixed : offset(right)});
    }
    middle_mass_ = odd_ && half_ == 1 ? 0.0 : inverse_mass(path.points[half_]);
    for (std::size_t x = 0; x < D; ++x) {
      const auto at = [&](std::size_t point) {
        return point < d.beads() ? 0.0 : d.coordinate(point, x).value();
      };
      anchors_[x] = L(at(path.points.front()), odd_ ? 0.0 : at(path.points.back()));
    }
  }

  /// The forces on the beads, to be set before rates are asked for.
  void set_forces(const double* f) {
    for (std::size_t j = 0; j <= half_; ++j) {
      const auto [left, right] = offsets_[j];
      for (std::size_t x = 0; x < D; ++x)
        force_[j][x] = L(left == fixed ? 0.0 : f[left + x], right == fixed ? 0.0 : f[right + x]);
      acceleration_[j] = inverse_mass_[j] * force_[j];
    }
    if (odd_)
      for (std::size_t x = 0; x < D; ++x)
        acceleration_[0][x] = L(acceleration_[0][x][0], acceleration_[1][x][1]);
  }

  /// Dirac's equations. False where S has no factors.
  bool dirac(const double* q, const double* p, double* rate_q, double* rate_p) {
    const L usable = eliminate<true>(q, p);
    Row& last = work_[half_ - 1];
    const Middle middle(middle_mass_, last);
    const double a =
        middle_mass_ * (across(last.turning, last.direction) - across(last.direction, last.turning));
    L mu = middle.solve(last.hidden);
    last.multiplier = mu;
    for (std::size_t j = half_ - 1; j-- > 0;) {
      mu = work_[j].hidden * work_[j].inverse - work_[j + 1].lower * mu;
      work_[j].multiplier = mu;
    }
    L y(0.0), before(0.0);
    for (std::size_t j = 0; j + 1 < half_; ++j) {
      Row& row = work_[j];
      const L turned = work_[j + 1].skew * work_[j + 1].multiplier - row.skew * before;
      before = row.multiplier;
      y = row.rate - turned - row.lower * y;
      row.reduced = y;
    }
    const L beyond(a * last.multiplier[1], -a * last.multiplier[0]);
    y = last.rate - (beyond - last.skew * before) - last.lower * y;
    L x = middle.solve(y);
    Vec pull = last.multiplier * last.direction, push = x * last.direction - last.multiplier * last.turning;
    store_middle(pull, push, p, rate_q, rate_p);
    for (std::size_t j = half_ - 1; j > 0; --j) {
      const Row& row = work_[j - 1];
      x = row.reduced * row.inverse - work_[j].lower * x;
      const Vec next_pull = row.multiplier * row.direction;
      const Vec next_push = x * row.direction - row.multiplier * row.turning;
      store(j, next_pull - pull, next_push - push, p, rate_q, rate_p);
      pull = next_pull;
      push = next_push;
    }
    store_ends(pull, push, p, rate_q, rate_p);
    return middle.usable(usable);
  }

  /// Lagrange's multipliers. False where S has no factors.
  bool multipliers(const double* q, const double* p, double* rate_q, double* rate_p) {
    const L usable = eliminate<false>(q, p);
    const Row& last = work_[half_ - 1];
    middle_ = Middle(middle_mass_, last);
    L x = middle_.solve(last.rate);
    const Vec none{};
    Vec push = x * last.direction;
    store_middle(none, push, p, rate_q, rate_p);
    for (std::size_t j = half_ - 1; j > 0; --j) {
      const Row& row = work_[j - 1];
      x = row.rate * row.inverse - work_[j].lower * x;
      const Vec next_push = x * row.direction;
      store(j, none, next_push - push, p, rate_q, rate_p);
      push = next_push;
    }
    store_ends(none, push, p, rate_q, rate_p);
    return middle_.usable(usable);
  }

  /// rest = f - B^T S^-1 B M^-1 f of forces f on the beads, with the factors that multipliers() has left.
  void respond(const double* f, double* rest) {
    const Vec none{};
    Vec a = inverse_mass_[0] * load_ends(f, none);
    if (odd_)  // the additional point goes with the bead beside it
      for (std::size_t k = 0; k < D; ++k) a[k] = L(a[k][0], inverse_mass_[1][1] * f[offsets_[1].right + k]);
    L y(0.0);
    for (std::size_t j = 0; j < half_; ++j) {
      Row& row = work_[j];
      const Vec next_a = inverse_mass_[j + 1] * load(offsets_[j + 1], f);
      y = dot(row.direction, next_a - a) - row.lower * y;
      row.reduced = y;
      a = next_a;
    }
    const Row& last = work_[half_ - 1];
    L x = middle_.solve(last.reduced);
    Vec push = x * last.direction;
    for (std::size_t k = 0; k < D; ++k) {
      const std::size_t at = offsets_[half_].left + k;
      rest[at] = f[at] - push[k].sum();
    }
    for (std::size_t j = half_ - 1; j > 0; --j) {
      const Row& row = work_[j - 1];
      x = row.reduced * row.inverse - work_[j].lower * x;
      const Vec next_push = x * row.direction;
      const auto [left, right] = offsets_[j];
      for (std::size_t k = 0; k < D; ++k) {
        const L kept = L(f[left + k], f[right + k]) - (next_push[k] - push[k]);
        rest[left + k] = kept[0];
        rest[right + k] = kept[1];
      }
      push = next_push;
    }
    const auto [left, right] = offsets_[0];
    for (std::size_t k = 0; k < D; ++k) {
      if (left != fixed) rest[left + k] = f[left + k] + push[k][0];
      if (right != fixed) rest[right + k] = f[right + k] + push[k][1];
    }
  }

 protected:
  using L = FoldedLanes;
  using Vec = FoldedVector<D>;
  using Row = FoldedRow<D>;
  using Middle = FoldedMiddle<D>;
  static constexpr std::uint32_t fixed = ~0U;  // instead of an offset: an anchor, or the additional point

  struct Offsets {
    std::uint32_t left, right;
  };

  [[nodiscard]] std::size_t mirrored(std::size_t j) const { return rods_ + (odd_ ? 1 : 0) - j; }
  [[nodiscard]] static Vec load(const Offsets& at, const double* x) {
    Vec r;
    for (std::size_t k = 0; k < D; ++k) r[k] = L(x[at.left + k], x[at.right + k]);
    return r;
  }
  // Positions (`fixed_values` where there is no bead) or velocities of points 0.
  [[nodiscard]] Vec load_ends(const double* x, const Vec& fixed_values) const {
    const auto [left, right] = offsets_[0];
    Vec r = fixed_values;
    for (std::size_t k = 0; k < D; ++k)
      r[k] = L(left == fixed ? r[k][0] : x[left + k], right == fixed ? r[k][1] : x[right + k]);
    return r;
  }

  // Geometry, and the elimination of S with phi~ (Dirac) or h at its right-hand side. Returns the sum of zero
  // times the reciprocal of each pivot, for Middle::usable().
  template <bool Dirac>
  L eliminate(const double* q, const double* p) {
    Vec beside = anchors_, still{};
    if (odd_) {
      const std::uint32_t end = offsets_[1].right;
      for (std::size_t k = 0; k < D; ++k) {
        beside[k] = L(anchors_[k][0], q[end + k] + (k == 0 ? 1.0 : 0.0));
        still[k] = L(0.0, inverse_mass_[1][1] * p[end + k]);
      }
    }
    Vec r = load_ends(q, beside);
    Vec v = load_ends(p, still);
    L w = inverse_mass_[0];
    v = w * v;
    L usable(0.0), inverse(0.0), y(0.0);
    Vec direction{}, turning{};
    for (std::size_t j = 0; j < half_; ++j) {
      Row& row = work_[j];
      const Offsets at = offsets_[j + 1];
      const L next_w = inverse_mass_[j + 1];
      const Vec next_r = load(at, q), next_v = next_w * load(at, p);
      const Vec e = next_r - r, u = next_v - v;
      const L mass = coupling_mass_[j];
      const L b = mass * dot(direction, e);  // minus the coupling of S
      const L lower = -(b * inverse);
      const L d = (w + next_w) * dot(e, e) + b * lower;
      const L rate = dot(u, u) + dot(e, acceleration_[j + 1] - acceleration_[j]);
      inverse = L(1.0) / d;
      usable = usable + L(0.0) * inverse;
      if constexpr (Dirac) {
        row.skew = mass * (dot(direction, u) - dot(turning, e));
        y = dot(e, u) - lower * y;
        row.hidden = y;
        row.turning = u;
        row.rate = rate;
      } else {
        y = rate - lower * y;
        row.rate = y;
      }
      row.lower = lower;
      row.inverse = inverse;
      row.direction = e;
      r = next_r;
      v = next_v;
      w = next_w;
      direction = e;
      turning = u;
    }
    return usable;
  }

  // pull is B^T mu and push B^T x - T^T mu, at point j of each lane.
  void store(std::size_t j, const Vec& pull, const Vec& push, const double* p, double* rate_q,
             double* rate_p) const {
    const Offsets at = offsets_[j];
    const Vec momentum = load(at, p);
    for (std::size_t k = 0; k < D; ++k) {
      const L fast = inverse_mass_[j] * (momentum[k] - pull[k]);
      const L slow = force_[j][k] - push[k];
      rate_q[at.left + k] = fast[0];
      rate_q[at.right + k] = fast[1];
      rate_p[at.left + k] = slow[0];
      rate_p[at.right + k] = slow[1];
    }
  }
  void store_one(std::size_t j, std::size_t lane, double pull, double push, std::size_t k, const double* p,
                 double* rate_q, double* rate_p) const {
    const std::size_t at = (lane == 0 ? offsets_[j].left : offsets_[j].right) + k;
    rate_q[at] = inverse_mass_[j][lane] * (p[at] - pull);
    rate_p[at] = force_[j][k][lane] - push;
  }
  void store_middle(const Vec& pull, const Vec& push, const double* p, double* rate_q, double* rate_p) const {
    for (std::size_t k = 0; k < D; ++k)
      store_one(half_, 0, pull[k].sum(), push[k].sum(), k, p, rate_q, rate_p);
  }
  void store_ends(const Vec& pull, const Vec& push, const double* p, double* rate_q, double* rate_p) const {
    for (std::size_t k = 0; k < D; ++k) {
      if (offsets_[0].left != fixed) store_one(0, 0, -pull[k][0], -push[k][0], k, p, rate_q, rate_p);
      if (offsets_[0].right != fixed) store_one(0, 1, -pull[k][1], -push[k][1], k, p, rate_q, rate_p);
    }
  }

  std::size_t rods_, half_;
  bool odd_;
  double middle_mass_ = 0;  // 1/m of the bead in the middle, as far as rods couple there
  std::vector<L> inverse_mass_, coupling_mass_;
  std::vector<Offsets> offsets_;
  std::vector<Vec> force_, acceleration_;
  std::vector<Row> work_;
  Middle middle_;  // of the last multipliers()
  Vec anchors_;
};

}  // namespace pfaff
