// When the stages of a collocation step are known to round-off, told from this step alone.
//
// The stages are iterated by S := line + m L, L := rates(S). With the last changes dS of the stages and dL of
// the scaled rates, |dL| / |dS| is the contraction of the iteration and |dL| the size of the next change of
// S, so that |dL|^2 / |dS| is what the next change of L would be. The iteration ends where that is a
// thousandth of a unit of round-off of L: what the error left in L adds up to over a long run is then lost in
// what rounding adds up to. L belongs to the last stages, not to those before. Each component is measured
// against its own rates and, where those vanish, against a small part of what they are added to
// (stage_iteration.hpp).
#pragma once

#include <array>
#include <limits>

#include <pfaff/core/errors/status.hpp>
#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/numbers/pack.hpp>

namespace pfaff {

/// The sum of the absolute values of numbers; of duals, that of their values and that of all their
/// derivatives; of packs, that of all lanes, halves first, so that it does not depend on their width.
template <class T>
struct Sizes {
  static constexpr std::size_t parts = 1;
  T sum{0};
  void add(const T& x) { sum = sum + abs(x); }
  [[nodiscard]] T part(std::size_t /*index*/) const { return sum; }
};
template <int W>
struct Sizes<Pack<W>> {
  Pack<W> sum;
  void add(const Pack<W>& x) { sum = sum + abs(x); }
  [[nodiscard]] double part(std::size_t index) const {
    if constexpr (W == 1)
      return sum[0];
    else
      return Sizes<Pack<W / 2>>{sum.lower() + sum.upper()}.part(index);
  }
};
template <class T, int N>
struct Sizes<Dual<T, N>> {
  static constexpr std::size_t parts = 2;
  T value{0}, derivative{0};
  void add(const Dual<T, N>& x) {
    value = value + abs(x.value);
    for (const T& slope : x.derivative) derivative = derivative + abs(slope);
  }
  [[nodiscard]] T part(std::size_t index) const { return index == 0 ? value : derivative; }
};

/// Watches one iteration.
template <class T>
class StageConvergence {
 public:
  using Number = Value<T>;
  static constexpr std::size_t parts = Sizes<T>::parts;

  /// Where the rates of all components change in turns, as those of positions and momenta do, the contraction
  /// is known from two iterations only.
  explicit StageConvergence(bool in_turns)
      : in_turns_(in_turns), goal_(u * (in_turns ? Number(1e-1) : Number(1e-3))) {}

  void begin_iteration() {
    older_ = previous_;
    previous_ = last_;
    last_ = {};
    ++iterations_;
  }
  /// One component, or several that are judged together: the sizes of the changes of the stages and of the
  /// scaled rates, divided by what they are measured against.
  void add(std::size_t part, const Number& stages, const Number& rates) {
    checked_ = checked_ + (stages + rates);
    Change& last = last_[part];  // without branches, which nothing could predict
    last.stages = stages > last.stages ? stages : last.stages;
    last.rates = rates > last.rates ? rates : last.rates;
  }
  /// Have the rates of some component changed by more than `limit` in this iteration?
  [[nodiscard]] bool changed_by_more_than(const Number& limit) const {
    bool more = false;
    for (const Change& change : last_) more = more || change.rates > limit;
    return more;
  }
  /// True when the iteration should stop; status() then says how. It is not_converged where changes become
  /// larger, or smaller so slowly, that another iteration should take over.
  [[gnu::always_inline]] bool finished() {
    bool converged = !in_turns_ || iterations_ > 1;
    for (std::size_t k = 0; k < parts; ++k) {
      const Change &now = last_[k], &before = previous_[k];
      converged = converged && now.rates * now.rates <= goal_ * now.stages &&
                  (!in_turns_ || now.rates * before.rates <= goal_ * before.stages);
    }
    if (!isfinite(checked_)) return stop(Status::non_finite);
    return converged ? stop(Status::converged) : hopeless();
  }
  [[nodiscard]] Status status() const { return status_; }

 private:
  struct Change {
    Number stages{0}, rates{0};
  };
  static constexpr Number u = unit_roundoff<T>();
  // The most that rounding makes of changes.
  static constexpr Number noise = u * Number(1 << 20);

  // Changes that shrink no more, because they are round-off amplified by the sums it passes through.
  [[gnu::always_inline]] bool at_round_off(const Number& now, const Number& before, const Number& older) {
    if (now <= Number(4) * u && Number(2) * now >= before) return true;
    if (now < before || (in_turns_ && now < older)) return false;  // in turns, every other one may stall
    return now <= noise / Number(64) || (++stalls_ >= 3 && now <= noise);
  }
  // Can this iteration not get nearer?
  [[gnu::always_inline]] bool hopeless() {
    bool still = true, slow = false;
    for (std::size_t k = 0; k < parts; ++k) {
      const Change &now = last_[k], &before = previous_[k];
      still = still && at_round_off(now.rates, before.rates, older_[k].rates);
      const bool diverges = iterations_ >= 4 && now.rates > Number(0.5);
      slow = slow || diverges || (iterations_ >= 10 && now.rates > Number(0.6) * before.rates);
    }
    if (iterations_ > 3 && still) return stop(Status::converged);
    return (iterations_ >= 60 || slow) && stop(Status::not_converged);
  }
  bool stop(Status status) {
    status_ = status;
    return true;
  }
  std::array<Change, parts> last_{}, previous_{}, older_{};
  int iterations_ = 0, stalls_ = 0;
  bool in_turns_;
  Number goal_, checked_{0};
  Status status_ = Status::not_converged;
};

}  // namespace pfaff
