// TaylorSteps: steps of the truncated power series of a solution of z' = X(z, t), as long as the series
// allows.
//
// The first guess of a step is a part of the radius of convergence, which the last quarter of the degrees
// shows: for coordinate k of size s_k, the smallest of (s_k / |z_{k,m}|)^{1/m} p/m over these degrees m,
// p the order (jorba-zou2005, 3.2). The factor p/m is what the coefficients of an entire function, 1/m!, ask
// for, so that of such a motion no degree shortens a step but the last; a pole's last degrees decide, too.
//
// A guess it remains: coefficients vanish for reasons of their own (q'' = -q^{n-1} from q = 0 has the degrees
// 1 mod n alone), and a flat force has none of them. What the polynomial P lacks is therefore measured where
// it is to be used, by the defect
//
//   R_k = h |P_k'(h) - X_k(P(h), t + h)|,
//
// which costs one evaluation of the field and is, for a smooth field, the remainder of the step times its
// degree. A step for which R_k is more than the tolerance allows, in units of s_k and beyond what rounding
// makes of the field, is shortened. A solution that is a polynomial has R = 0 and no radius; such a step,
// which the coefficients do not limit, is looked at in three places more.
//
// The size s_k is the largest of the caller's for that coordinate and of the terms |z_{k,l}| h^l of low
// degree, so that it needs no unit. A coordinate without any of these, which begins with a high power of the
// time, is measured against what the first step tried would make of it.
//
// Where the field has a kink (kinks.hpp) a step ends behind it, and the defect is measured before it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include <pfaff/core/numbers/with_rounding.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/core/tape/taylor_expansion.hpp>

namespace pfaff {

/// T is double or Quad.
template <class T>
class TaylorSteps {
 public:
  /// Of degree `order` >= 2, with first guesses of `reach` times the radius of convergence.
  TaylorSteps(const std::shared_ptr<const Tape>& field, int order, double reach)
      : expansion_(field, order),
        field_(field),
        rounded_field_(field),
        low_(expansion_.order() - std::max<std::size_t>(2, expansion_.order() / 4) + 1),
        reach_(reach),
        logarithms_(expansion_.size() * (expansion_.order() + 1 - low_)),
        sizes_(expansion_.size()),
        unsized_(expansion_.size()),
        state_(expansion_.size()),
        slope_(expansion_.size()),
        rate_(expansion_.size()),
        rounding_(expansion_.size()),
        rounded_state_(expansion_.size()),
        rounded_rate_(expansion_.size()) {
    for (std::size_t m = low_; m <= expansion_.order(); ++m)
      of_degrees_.push_back(std::log(static_cast<double>(expansion_.order()) / static_cast<double>(m)));
  }

  /// Expands the solution that is at z at time t. False where a coefficient is not finite.
  [[nodiscard]] bool expand(const T& t, const T* z) {
    time_ = t;
    expansion_.expand(t, z);
    const std::vector<T>& c = expansion_.coefficients();
    return std::all_of(c.begin(), c.end(), [](const T& x) { return isfinite(x); });
  }
  [[nodiscard]] const TaylorExpansion<T>& expansion() const { return expansion_; }

  /// A step in the direction of `limit` and no longer than it, which leaves out at most `tolerance` of the
  /// size of each coordinate. `least` gives the least size of each coordinate, or zeros. Zero where no step
  /// that moves the time is so short.
  [[nodiscard]] T step(const T& limit, const T& tolerance, const std::vector<T>& least) {
    const T whole = abs(limit), direction(limit < T(0) ? -1 : 1);
    const double guess = guessed(whole, least);
    const bool limited = T(guess) < whole;
    T h = limited ? T(guess) : whole;
    const auto kink = expansion_.first_kink(direction * h);
    if (kink) {
      crowded_ = T(abs(kink->behind)) < h / T(1000) ? crowded_ + 1 : 0;
      if (crowded_ > most_crowded) return T(0);
      h = abs(kink->before);
    }
    std::fill(unsized_.begin(), unsized_.end(), T(0));
    ends_at_kink_ = false;
    if (kink && time_ + kink->before == time_) {  // the state is at the kink, within rounding
      ends_at_kink_ = true;
      const T shortest = T(4) * std::numeric_limits<T>::epsilon() * std::max(T(abs(time_)), whole);
      return direction * std::max(T(abs(kink->behind)), shortest);
    }
    for (int reductions = 0; time_ + direction * h != time_; ++reductions) {
      measure_sizes(h, least);
      T excess = this->excess(direction * h, tolerance);
      if (!limited && reductions == 0)
        for (const double part : parts)
          excess = larger(excess, this->excess(direction * h * T(part), tolerance));
      if (excess <= T(1)) {
        ends_at_kink_ = kink && reductions == 0;
        return ends_at_kink_ ? kink->behind : direction * h;
      }
      h = h * T(reduction(excess, reductions));
    }
    return T(0);
  }

  /// True where the last step ends behind a kink of the field.
  [[nodiscard]] bool ends_at_kink() const { return ends_at_kink_; }

  /// The sizes that the last step was measured against, of coordinates; zero where there was none.
  [[nodiscard]] const std::vector<T>& sizes() const { return sizes_; }
  /// Instead of these, of the coordinates without a size: what the first step tried left out of them.
  [[nodiscard]] const std::vector<T>& unsized() const { return unsized_; }
  /// Adds to sizes of coordinates at the point of expansion what makes rounding errors of their rates over
  /// the time h: the size of a sum is that of its terms, of which it may be a small rest.
  void add_terms_of_rates(const T& h, std::vector<T>& sizes) {
    const std::vector<T> terms = sizes;
    // What a rate is made of is itself made of rates: a momentum that is a rest makes one of its position.
    for (int sweep = 0; sweep < 3; ++sweep) {
      round(time_, expansion_.coefficients().data(), sizes);
      for (std::size_t k = 0; k < sizes.size(); ++k)
        if (isfinite(rounding_[k])) sizes[k] = std::max(sizes[k], T(terms[k] + abs(h) * rounding_[k]));
    }
  }

 private:
  // Places within a step, in parts of it, that no period of a field has in common.
  static constexpr std::array parts{0.1459, 0.3820, 0.6180};
  // Steps in a row that a kink makes a thousand times shorter: a motion that stays at a jump, towards which
  // the field points on both sides, would take them for ever.
  static constexpr int most_crowded = 1000;
  // The rounding errors of a defect, in units of those of the field at the end: those of the sum of the
  // polynomial and of its coefficients.
  static constexpr int roundings = 32;

  // In double where it has the number, for a logarithm in quad takes fifty times as long.
  static double logarithm(const T& x) {
    const auto number = static_cast<double>(x);
    if (number >= std::numeric_limits<double>::min() && std::isfinite(number)) return std::log(number);
    return static_cast<double>(log(x));
  }
  // The larger number, or the one that is none.
  static T larger(const T& a, const T& b) { return isnan(b) || b > a ? b : a; }

  // A factor for a step whose remainder is `excess` times what is allowed.
  [[nodiscard]] double reduction(const T& excess, int reductions) const {
    if (!isfinite(excess)) return 0.1;
    const double factor = std::exp(-logarithm(excess) / static_cast<double>(expansion_.order() + 1));
    // Behind a kink of the field the excess falls with the step and no faster, and halving ends sooner.
    return std::clamp(0.9 * factor, 1e-3, reductions < 2 ? 0.9 : 0.5);
  }

  // The largest step that the last degrees allow; infinite where they vanish.
  [[nodiscard]] double guessed(const T& whole, const std::vector<T>& least) {
    const std::vector<T>& c = expansion_.coefficients();
    for (std::size_t i = 0; i < logarithms_.size(); ++i) {
      const T coefficient = abs(c[low_ * sizes_.size() + i]);
      logarithms_[i] = coefficient > T(0) ? logarithm(coefficient) : -std::numeric_limits<double>::infinity();
    }
    // The sizes of coordinates depend on the step. A first estimate of the radius takes the lowest term of
    // each, whose size hardly matters for a root of high degree.
    const double first = radius([&](std::size_t k) { return lowest(k, least[k]); });
    measure_sizes(std::min(whole, T(reach_ * first)), least);
    return reach_ * radius([&](std::size_t k) { return Term{0, sizes_[k]}; });
  }
  struct Term {
    std::size_t degree;
    T size;
  };
  [[nodiscard]] Term lowest(std::size_t k, const T& least) const {
    const std::vector<T>& c = expansion_.coefficients();
    const std::size_t n = sizes_.size();
    const T constant = std::max(least, T(abs(c[k])));
    if (constant > T(0)) return {0, constant};
    for (std::size_t l = 1; l < low_; ++l)
      if (const T size = abs(c[l * n + k]); size > T(0)) return {l, size};
    return {0, T(0)};
  }
  template <class TermOf>
  [[nodiscard]] double radius(TermOf&& term_of) const {
    const std::size_t n = sizes_.size();
    double smallest = std::numeric_limits<double>::infinity();  // a logarithm
    for (std::size_t k = 0; k < n; ++k) {
      const Term term = term_of(k);
      if (!(term.size > T(0))) continue;
      const double size = logarithm(term.size);
      for (std::size_t i = 0; i < of_degrees_.size(); ++i) {
        const double of_coefficient =
            (size - logarithms_[i * n + k]) / static_cast<double>(low_ + i - term.degree);
        smallest = std::min(smallest, of_coefficient + of_degrees_[i]);
      }
    }
    return std::exp(smallest);
  }
  void measure_sizes(const T& h, const std::vector<T>& least) {
    const std::vector<T>& c = expansion_.coefficients();
    const std::size_t n = sizes_.size();
    for (std::size_t k = 0; k < n; ++k) sizes_[k] = std::max(least[k], T(abs(c[k])));
    T power(1);
    for (std::size_t l = 1; l < low_; ++l) {
      power = power * h;
      for (std::size_t k = 0; k < n; ++k) sizes_[k] = std::max(sizes_[k], T(abs(c[l * n + k]) * power));
    }
  }

  // The largest defect at time s after the expansion, in units of what is allowed of it.
  [[nodiscard]] T excess(const T& s, const T& tolerance) {
    const std::vector<T>& c = expansion_.coefficients();
    const std::size_t n = sizes_.size(), p = expansion_.order();
    for (std::size_t k = 0; k < n; ++k) {
      T value = c[p * n + k], slope(0);
      for (std::size_t l = p; l-- > 0;) {
        slope = slope * s + value;
        value = value * s + c[l * n + k];
      }
      state_[k] = value;
      slope_[k] = slope;
    }
    field_(time_ + s, state_.data(), rate_.data());
    T worst(0);
    bool rounded = false;
    for (std::size_t k = 0; k < n; ++k) {
      const T defect = abs(s) * abs(slope_[k] - rate_[k]);
      if (sizes_[k] == T(0) && unsized_[k] == T(0) && isfinite(defect)) unsized_[k] = defect;
      T allowed = tolerance * (sizes_[k] > T(0) ? sizes_[k] : unsized_[k]);
      if (defect <= allowed) {
        if (allowed > T(0)) worst = larger(worst, T(defect / allowed));
        continue;
      }
      if (!rounded) round(time_ + s, state_.data(), sizes_);
      rounded = true;
      if (const T rounding = unit_roundoff<T>() * T(roundings) * abs(s) * rounding_[k]; isfinite(rounding))
        allowed = allowed + rounding;
      worst = larger(worst, T(defect / allowed));
    }
    return worst;
  }
  // The rounding errors of the field at (t, z), of numbers of these sizes, in units of round-off.
  void round(const T& t, const T* z, const std::vector<T>& sizes) {
    for (std::size_t k = 0; k < sizes.size(); ++k)
      rounded_state_[k] = {z[k], std::max(sizes[k], T(abs(z[k])))};
    rounded_field_({t, T(abs(t))}, rounded_state_.data(), rounded_rate_.data());
    for (std::size_t k = 0; k < sizes.size(); ++k) rounding_[k] = rounded_rate_[k].error;
  }

  TaylorExpansion<T> expansion_;
  Replay<T> field_;
  Replay<WithRounding<T>> rounded_field_;
  std::size_t low_;  // the first of the last degrees
  double reach_;
  std::vector<double> of_degrees_, logarithms_;  // of p/m, and of the last coefficients, [degree][coordinate]
  T time_{};
  bool ends_at_kink_ = false;
  int crowded_ = 0;                                 // such steps so far
  std::vector<T> sizes_, unsized_;                  // of coordinates; of those that have none
  std::vector<T> state_, slope_, rate_, rounding_;  // where the defect is measured
  std::vector<WithRounding<T>> rounded_state_, rounded_rate_;
};

}  // namespace pfaff
