// Interruption: work without Python's lock, which Ctrl-C ends between two steps.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <csignal>

#include <pfaff/core/errors/budget.hpp>

namespace pfaff::python {

/// While it lives, on Python's main thread, a SIGINT also sets stop(). The handler of Python is called as
/// before, so that the exception of Ctrl-C is there once Python runs again. To be made with Python's lock
/// held; what another one around it does not do already is done by the outermost. On other threads, which
/// Ctrl-C does not concern, and where SIGINT is ignored, it does nothing. A Ctrl-C that came before it was
/// made is raised.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  /// The flag that work looks at; on other threads one that nobody sets.
  [[nodiscard]] const std::atomic<bool>& stop() const;
  /// True where Ctrl-C has come; its exception is then taken from Python, so that the caller can raise
  /// Interrupted with what was done by then. With Python's lock held.
  [[nodiscard]] bool taken() const;

 private:
  bool on_main_thread_, installed_ = false;
};

/// work() without Python's lock. Whatever spends from the budget of its thread ends with BudgetSpent once
/// Ctrl-C has come, which becomes Interrupted.
template <class Work>
auto without_lock(Work&& work) {
  const Interruption interruption;
  try {
    const pybind11::gil_scoped_release released;
    const Budget budget({}, &interruption.stop());
    return work();
  } catch (const BudgetSpent& spent) {
    if (spent.stopped()) (void)interruption.taken();
    throw;
  }
}

}  // namespace pfaff::python
