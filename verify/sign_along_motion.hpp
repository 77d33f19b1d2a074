// The sign of a rate along a motion. A rate that has the right sign at random states may have the wrong one
// in a thin layer of states, which a motion crosses.
#pragma once

#include <memory>
#include <optional>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/tape/tape.hpp>
#include <pfaff/runs/support/reference.hpp>
#include <pfaff/verify/residuals.hpp>

namespace pfaff {

/// The motion from the first centre of its region, over as long as region_of follows it. Its solution is
/// found once for all that is looked at along it, when the first of these asks for it. The motion has to be
/// is_short.
class FollowedMotion {
 public:
  FollowedMotion(std::shared_ptr<const Model> model, Region region);

  [[nodiscard]] const std::shared_ptr<const Model>& model() const { return model_; }
  [[nodiscard]] const Region& region() const { return region_; }
  /// The time after a part of its duration, for which the solution has to be there.
  [[nodiscard]] Quad time(const Quad& part) const { return begin_ + duration_ * part; }
  /// BudgetSpent where the thread was asked to stop; then it is found anew when it is asked for again.
  [[nodiscard]] const ReferenceSolution& solution();

 private:
  std::shared_ptr<const Model> model_;
  Region region_;
  Quad begin_, duration_{0};
  std::optional<ReferenceSolution> solution_;
};

/// The largest value that the one output of a tape takes along a motion, relative to the rounding of its
/// terms, and zero where it is never positive. It is looked at at some hundred times, and its highest maxima
/// between these are searched for. States at which an output of `domain` has no value do not count.
double largest_along(FollowedMotion& motion, const std::shared_ptr<const Tape>& rate,
                     const std::shared_ptr<const Tape>& domain);

}  // namespace pfaff
