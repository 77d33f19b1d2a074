// Interruptions by the user: a run that is asked to stop ends after its step and keeps its samples, and other
// work ends between two steps and says what was done by then.
#pragma once

#include <array>
#include <atomic>
#include <csignal>
#include <string>

#include <pfaff/core/errors/budget.hpp>

namespace pfaff {

/// While it lives, the first SIGINT, SIGTERM or SIGHUP only sets stop(), which ends the budget that is in
/// force on this thread as long; a second one ends the process as usual. At most one object at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  /// True once a signal has come.
  [[nodiscard]] static const std::atomic<bool>& stop();

 private:
  static constexpr std::array<int, 3> signals{SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, signals.size()> before_{};
  Budget budget_;
};

/// To be called where BudgetSpent was caught: passes it on, and where somebody asked for the end throws a
/// RunError instead that says what was done by then.
[[noreturn]] void end_interrupted(const BudgetSpent& spent, const std::string& done);

}  // namespace pfaff
