// Outcome: how a call that takes steps ended.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include <pfaff/core/errors/status.hpp>
#include <pfaff/core/numbers/quad.hpp>

namespace pfaff {

/// How a call of Integration::steps or Integration::to ended.
class [[nodiscard]] Outcome {
 public:
  enum class End {
    reached,  // all that was asked for
    failed,   // a step failed, see status()
    watcher,  // a watcher ended it
    asked     // the flag of stop_when() was set
  };
  /// `chosen`: the method chose its steps.
  Outcome(End end, Status status, std::int64_t steps, std::string where, bool chosen = false)
      : end_(end), status_(status), steps_(steps), where_(std::move(where)), chosen_(chosen) {}
  [[nodiscard]] End end() const { return end_; }
  [[nodiscard]] bool reached() const { return end_ == End::reached; }
  [[nodiscard]] Status status() const { return status_; }
  /// How many steps of one size, or intervals of a method that chooses its steps, lead to the state.
  [[nodiscard]] std::int64_t steps() const { return steps_; }
  /// What ended the call and where, as a sentence without a full stop; empty where all was reached.
  [[nodiscard]] std::string message() const;
  /// Throws RunError with the message where not all was reached.
  void expect_reached() const;

 private:
  End end_;
  Status status_;
  std::int64_t steps_;
  std::string where_;
  bool chosen_;
};

/// "at t = 0.5 (step 5)", for messages.
[[nodiscard]] std::string place_of(const Quad& t, std::int64_t step);

/// What kind of failure a status is, followed by where it happened; empty for Status::converged.
[[nodiscard]] std::string failure(Status status, const std::string& where);

}  // namespace pfaff
