// The constants of recorded numbers that are no small integers: each stands once in memory, with the count of
// the numbers that share it.
#include <atomic>
#include <cmath>
#include <limits>

#include <pfaff/core/tape/recorder.hpp>

namespace pfaff {

struct Recorded::SharedConstant {
  Real value;
  std::atomic<int> uses{1};
};

Recorded::Recorded(const Real& value) {
  constexpr std::int64_t largest = std::numeric_limits<int>::max();
  // A zero with a sign is no integer.
  const bool integer = value.is_fraction() && value.denominator() == 1 && value.numerator() <= largest &&
                       value.numerator() >= -largest &&
                       !(value.numerator() == 0 && std::signbit(value.value()));
  if (integer) {
    number_ = static_cast<int>(value.numerator());
  } else {
    target_ = new SharedConstant{value};
    kind_ = Kind::shared;
  }
}
void Recorded::share() const noexcept {
  static_cast<SharedConstant*>(target_)->uses.fetch_add(1, std::memory_order_relaxed);
}
void Recorded::release() const noexcept {
  auto* shared = static_cast<SharedConstant*>(target_);
  // The analyser does not count atomic numbers.
  if (shared->uses.fetch_sub(1, std::memory_order_acq_rel) == 1)
    delete shared;  // NOLINT(clang-analyzer-cplusplus.NewDelete)
}
const Real& Recorded::shared_constant() const { return static_cast<const SharedConstant*>(target_)->value; }

}  // namespace pfaff
