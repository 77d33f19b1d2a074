// Interruptions by the user: a run that is asked to stop ends after its step and keeps its samples.
#pragma once

#include <atomic>
#include <csignal>

namespace pfaff {

/// While it lives, the first SIGINT or SIGTERM only sets stop(); a second one ends the process as usual. At
/// most one object at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  /// True once a signal has come.
  [[nodiscard]] static const std::atomic<bool>& stop();

 private:
  struct sigaction interrupt_before_ {
  }, terminate_before_{};
};

}  // namespace pfaff
