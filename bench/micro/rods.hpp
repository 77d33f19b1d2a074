// A hanging chain of rods for the benchmarks, and its loops by hand.
#pragma once

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <pfaff/core/numbers/pack.hpp>

namespace pfaff::micro {

inline constexpr std::array<int, 4> chain_sizes{16, 64, 256, 1024};

/// Masses, rods of length 1 and a consistent state of a chain that hangs from the origin in D dimensions:
/// bent at every bead, every rod turning.
template <int D>
struct Rig {
  explicit Rig(int count)
      : size(static_cast<std::size_t>(count)), inverse_masses(size), q(D * size), p(D * size) {
    std::array<double, D> place{}, velocity{};
    for (std::size_t k = 0; k < size; ++k) {
      const auto x = static_cast<double>(k);
      const double mass = 1 + 0.5 * std::sin(x), angle = 0.4 * std::sin(1.7 * x),
                   turn = 0.5 * std::cos(0.9 * x);
      const double tilt = D == 3 ? 0.3 * std::cos(1.1 * x) : 0,
                   turn_of_tilt = D == 3 ? 0.2 * std::sin(2.3 * x) : 0;
      inverse_masses[k] = 1 / mass;
      const std::array<double, 3> rod{std::cos(angle) * std::cos(tilt), std::sin(angle) * std::cos(tilt),
                                      std::sin(tilt)};
      const std::array<double, 3> rate{
          -turn * std::sin(angle) * std::cos(tilt) - turn_of_tilt * std::cos(angle) * std::sin(tilt),
          turn * std::cos(angle) * std::cos(tilt) - turn_of_tilt * std::sin(angle) * std::sin(tilt),
          turn_of_tilt * std::cos(tilt)};
      for (std::size_t d = 0; d < D; ++d) {
        place[d] += rod[d];
        velocity[d] += rate[d];
        q[k * D + d] = place[d];
        p[k * D + d] = mass * velocity[d];
      }
    }
  }
  std::size_t size;
  std::vector<double> inverse_masses, q, p;
  double gravity = 9.81;  // against the last axis
};

/// D numbers of one lane type.
template <class L, int D>
struct Direction {
  std::array<L, D> x{};
  L& operator[](std::size_t d) { return x[d]; }
  const L& operator[](std::size_t d) const { return x[d]; }
  friend Direction operator-(const Direction& a, const Direction& b) {
    Direction r;
    for (std::size_t d = 0; d < D; ++d) r[d] = a[d] - b[d];
    return r;
  }
  friend Direction operator+(const Direction& a, const Direction& b) {
    Direction r;
    for (std::size_t d = 0; d < D; ++d) r[d] = a[d] + b[d];
    return r;
  }
  friend Direction operator*(const L& s, const Direction& a) {
    Direction r;
    for (std::size_t d = 0; d < D; ++d) r[d] = s * a[d];
    return r;
  }
  friend L dot(const Direction& a, const Direction& b) {
    L sum = a[0] * b[0];
    for (std::size_t d = 1; d < D; ++d) sum = sum + a[d] * b[d];
    return sum;
  }
};

/// The chain folded in the middle: lane 0 counts points from the anchor, lane 1 from the free end. A chain
/// with an odd number of rods gets one more at the free end, coupled to nothing.
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

  /// B2: mu = S^-1 phi~, x = S^-1 (h - A mu), q' = v - M^-1 B^T mu, p' = f - B^T x + T^T mu.
  void dirac(const double* q, const double* p, double* rate_q, double* rate_p) {
    place(q, p);
    // Meeting in the middle: both last rods point at the same bead.
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

  /// A5: x = S^-1 h, q' = v, p' = f - B^T x.
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

/// Chains that move side by side, one in each lane of a pack: what one waits for, none has to.
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

  /// B2 for all chains.
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

/// Buffers of one benchmark.
template <int D>
struct RodState {
  explicit RodState(const Rig<D>& rig) : q(rig.q), p(rig.p), rate_q(q.size()), rate_p(p.size()) {}
  std::vector<double> q, p, rate_q, rate_p;
};

/// Adds the benchmark of run(), one evaluation for so many rods.
template <class Run>
void add_rods(const std::string& shape, const std::string& what, const std::string& path, double count,
              Run run) {
  const std::string name = shape + "/" + what + "/" + path;
  [[maybe_unused]] const auto measured = [=](benchmark::State& state) mutable {
    for (auto _ : state) run();
    state.counters["ns_per_rod"] =
        benchmark::Counter(1e-9 * count * static_cast<double>(state.iterations()),
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  };
#ifndef __clang_analyzer__  // which sees a leak inside Google Benchmark
  benchmark::RegisterBenchmark(name.c_str(), measured);
#endif
}

}  // namespace pfaff::micro
