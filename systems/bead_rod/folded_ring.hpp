// The right-hand sides of a ring of rods, as folded_path.hpp makes those of a path: the ring is cut at one
// rod, whose row and column border the tridiagonal matrix of the others,
//
//   S = [[S_path, c], [c^T, s]],   g = S_path^-1 c,   x_b = (r_b - g.r)/(s - g.c),   x = S_path^-1 r - g x_b.
//
// c has entries only at the two rods that the closing rod touches.
#pragma once

#include <pfaff/systems/bead_rod/folded_path.hpp>

namespace pfaff {

template <int D>
class FoldedRing : private FoldedPath<D> {
  using Path = FoldedPath<D>;
  using typename Path::L;
  using typename Path::Middle;
  using typename Path::Row;
  using typename Path::Vec;

 public:
  /// All points of the ring, in order.
  FoldedRing(const BeadRodDescription& d, const RodPath& ring)
      : Path(d, ring),
        first_(ring.points.front() * D),
        last_(ring.points.back() * D),
        first_mass_(1 / d.masses[ring.points.front()].value()),
        last_mass_(1 / d.masses[ring.points.back()].value()) {}
  using Path::set_forces;

  /// Dirac's equations. False where S has no factors.
  bool dirac(const double* q, const double* p, double* rate_q, double* rate_p) {
    const L usable = this->template eliminate<true>(q, p);
    close(q, p);
    const std::size_t half = this->half_;
    Row& last = this->work_[half - 1];
    const Middle middle(this->middle_mass_, last);
    const double a =
        this->middle_mass_ * (across(last.turning, last.direction) - across(last.direction, last.turning));
    last.multiplier = middle.solve(last.hidden);
    last.border = middle.solve(last.border);
    for (std::size_t j = half - 1; j-- > 0;) {
      Row& row = this->work_[j];
      const Row& next = this->work_[j + 1];
      row.multiplier = row.hidden * row.inverse - next.lower * next.multiplier;
      row.border = row.border * row.inverse - next.lower * next.border;
    }
    const double scale = 1 / (diagonal_ - at_border(couplings_, &Row::border));
    const double mu_b = (hidden_ - at_border(couplings_, &Row::multiplier)) * scale;
    const L mu_lanes(mu_b);
    L y(0.0), before(0.0), along(0.0), mu = this->work_[0].multiplier - this->work_[0].border * mu_lanes;
    for (std::size_t j = 0; j + 1 < half; ++j) {
      Row& row = this->work_[j];
      const Row& next = this->work_[j + 1];
      const L next_mu = next.multiplier - next.border * mu_lanes;
      const L z = row.rate - (next.skew * next_mu - row.skew * before) + border_skew(j) * mu_lanes;
      along = along + z * row.border;
      y = z - row.lower * y;
      row.reduced = y;
      row.multiplier = mu;
      before = mu;
      mu = next_mu;
    }
    last.multiplier = mu;
    const L beyond(a * mu[1], -a * mu[0]);
    const L z = last.rate - (beyond - last.skew * before) + border_skew(half - 1) * mu_lanes;
    along = along + z * last.border;
    y = z - last.lower * y;
    const double x_b = (rate_ - at_border(skews_, &Row::multiplier) - along.sum()) * scale;
    L x = middle.solve(y);  // of the path alone; L(x_b) times g is taken off where it is used
    const Vec border_pull = lanes(mu_b, 0), border_push = lanes(x_b, -mu_b);
    const L x_lanes(x_b);
    L whole = x - last.border * x_lanes;
    Vec pull = mu * last.direction, push = whole * last.direction - mu * last.turning;
    this->store_middle(pull, push, p, rate_q, rate_p);
    for (std::size_t j = half - 1; j > 0; --j) {
      const Row& row = this->work_[j - 1];
      x = row.reduced * row.inverse - this->work_[j].lower * x;
      whole = x - row.border * x_lanes;
      const Vec next_pull = row.multiplier * row.direction;
      const Vec next_push = whole * row.direction - row.multiplier * row.turning;
      store_inner(j, next_pull - pull, next_push - push, border_pull, border_push, p, rate_q, rate_p);
      pull = next_pull;
      push = next_push;
    }
    this->store_ends(pull - border_pull, push - border_push, p, rate_q, rate_p);
    return middle.usable(usable) && scale * 0 == 0;
  }

  /// Lagrange's multipliers. False where S has no factors.
  bool multipliers(const double* q, const double* p, double* rate_q, double* rate_p) {
    const L usable = this->template eliminate<false>(q, p);
    close(q, p);
    const std::size_t half = this->half_;
    Row& last = this->work_[half - 1];
    const Middle middle(this->middle_mass_, last);
    last.multiplier = middle.solve(last.rate);
    last.border = middle.solve(last.border);
    for (std::size_t j = half - 1; j-- > 0;) {
      Row& row = this->work_[j];
      const Row& next = this->work_[j + 1];
      row.multiplier = row.rate * row.inverse - next.lower * next.multiplier;
      row.border = row.border * row.inverse - next.lower * next.border;
    }
    const double scale = 1 / (diagonal_ - at_border(couplings_, &Row::border));
    const double x_b = (rate_ - at_border(couplings_, &Row::multiplier)) * scale;
    const L x_lanes(x_b);
    const Vec none{}, border_push = lanes(x_b, 0);
    Vec push = (last.multiplier - last.border * x_lanes) * last.direction;
    this->store_middle(none, push, p, rate_q, rate_p);
    for (std::size_t j = half - 1; j > 0; --j) {
      const Row& row = this->work_[j - 1];
      const Vec next_push = (row.multiplier - row.border * x_lanes) * row.direction;
      store_inner(j, none, next_push - push, none, border_push, p, rate_q, rate_p);
      push = next_push;
    }
    this->store_ends(none, push - border_push, p, rate_q, rate_p);
    return middle.usable(usable) && scale * 0 == 0;
  }

 private:
  // The row where the right lane's end touches the closing rod. Where a rod was added to make the halves
  // equally long, it is row 0 there, and no part of the ring.
  [[nodiscard]] std::size_t right_end() const { return this->odd_ ? 1 : 0; }
  // The closing rod's direction and turning, with these factors: plus at its end in the left lane, minus at
  // its end in the right lane.
  [[nodiscard]] Vec lanes(double of_direction, double of_turning) const {
    Vec r;
    for (std::size_t k = 0; k < D; ++k) {
      const double x = of_direction * direction_[k] + of_turning * turning_[k];
      r[k] = L(x, -x);
    }
    return r;
  }
  /// The sum over the two rods at the closing one.
  [[nodiscard]] double at_border(const L& entries, L Row::*of) const {
    return entries[0] * (this->work_[0].*of)[0] + entries[1] * (this->work_[right_end()].*of)[1];
  }
  [[nodiscard]] L border_skew(std::size_t j) const {
    return {j == 0 ? skews_[0] : 0.0, j == right_end() ? skews_[1] : 0.0};
  }
  // The closing rod, its couplings, and the elimination of c. Inlined, it takes registers from the loops of
  // multipliers(), which are then a seventh slower.
  [[gnu::noinline]] void close(const double* q, const double* p) {
    const std::size_t r = right_end();
    double square = 0, hidden = 0, rate = 0;
    double left = 0, right = 0, left_skew = 0, right_skew = 0;
    const Row &at_left = this->work_[0], &at_right = this->work_[r];
    for (std::size_t k = 0; k < D; ++k) {
      const double e = q[first_ + k] - q[last_ + k];
      const double u = first_mass_ * p[first_ + k] - last_mass_ * p[last_ + k];
      direction_[k] = e;
      turning_[k] = u;
      square += e * e;
      hidden += e * u;
      rate += u * u + e * (this->acceleration_[0][k][0] - this->acceleration_[r][k][1]);
      left += e * at_left.direction[k][0];
      right += e * at_right.direction[k][1];
      left_skew += e * at_left.turning[k][0] - u * at_left.direction[k][0];
      right_skew += e * at_right.turning[k][1] - u * at_right.direction[k][1];
    }
    diagonal_ = square * (first_mass_ + last_mass_);
    hidden_ = hidden;
    rate_ = rate;
    couplings_ = L(-first_mass_ * left, last_mass_ * right);
    skews_ = L(first_mass_ * left_skew, -last_mass_ * right_skew);
    L c(0.0);
    for (std::size_t j = 0; j < this->half_; ++j) {
      const L entry(j == 0 ? couplings_[0] : 0.0, j == r ? couplings_[1] : 0.0);
      c = entry - this->work_[j].lower * c;
      this->work_[j].border = c;
    }
  }
  void store_inner(std::size_t j, Vec pull, Vec push, const Vec& border_pull, const Vec& border_push,
                   const double* p, double* rate_q, double* rate_p) const {
    if (j == 1 && this->odd_)
      for (std::size_t k = 0; k < D; ++k) {
        pull[k] = pull[k] + L(0.0, border_pull[k][1]);
        push[k] = push[k] + L(0.0, border_push[k][1]);
      }
    this->store(j, pull, push, p, rate_q, rate_p);
  }

  std::size_t first_, last_;  // offsets of the ends of the closing rod
  double first_mass_, last_mass_;
  std::array<double, D> direction_{}, turning_{};
  double diagonal_ = 0, hidden_ = 0, rate_ = 0;
  L couplings_, skews_;
};

}  // namespace pfaff
