// The tables that measures leave of watched quantities, a row for each, and what such measures look at.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/runs/measure.hpp>
#include <pfaff/runs/support/watched_quantity.hpp>

namespace pfaff {

/// The columns of a table of conserved quantities, or of residuals of constraints: the name of the quantity,
/// its unit, and its fields.
std::vector<Column> watched_columns(bool residuals, const std::string& time_unit);
/// A row of it. The fields stay empty where the quantity has no drift.
Row watched_row(const WatchedQuantity& quantity, const std::string& name, const std::string& unit,
                bool drifts);

/// At so many states at most it is found what roundings do to quantities.
inline constexpr std::int64_t most_samples = 1000;

/// The states of the blocks of a run, one by one, and which of them are samples.
template <class T>
class WatchedStates {
 public:
  explicit WatchedStates(const Measured<T>& run)
      : every_(std::max<std::int64_t>(1, (run.steps + most_samples - 1) / most_samples)),
        steps_(run.steps),
        state_(run.start.state().size()),
        in_double_(state_.size()) {}

  [[nodiscard]] bool samples(std::int64_t step) const { return step % every_ == 0 || step == steps_; }
  /// Makes state() that at a row of a block.
  void look(const Block<T>& block, std::size_t row) {
    block.states.get(row, state_);
    for (std::size_t k = 0; k < state_.size(); ++k) in_double_[k] = static_cast<double>(state_[k]);
    t_ = block.time(row), step_ = block.step(row);
  }
  [[nodiscard]] const std::vector<T>& state() const { return state_; }
  [[nodiscard]] const std::vector<double>& in_double() const { return in_double_; }
  /// Ends a table with a phrase that is not empty, what is not finite at the state.
  void require(const std::string& not_finite) const {
    if (!not_finite.empty()) throw RunError(not_finite + " " + place_of(Quad(t_), step_));
  }

 private:
  std::int64_t every_, steps_, step_ = 0;
  T t_{0};
  std::vector<T> state_;
  std::vector<double> in_double_;
};

}  // namespace pfaff
