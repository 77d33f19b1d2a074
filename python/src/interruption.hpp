// Interruption: work without Python's lock, which Ctrl-C ends between two steps.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <csignal>
#include <optional>
#include <type_traits>

#include <pfaff/core/errors/budget.hpp>
#include <pfaff/python/src/callbacks.hpp>

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
  /// The flag that work looks at; on other threads one that is set when the interpreter ends.
  [[nodiscard]] const std::atomic<bool>& stop() const;
  /// True where Ctrl-C has come; its exception is then taken from Python, so that the caller can raise
  /// Interrupted with what was done by then; another exception of a handler of the user's own is thrown. With
  /// Python's lock held.
  [[nodiscard]] bool taken() const;

 private:
  bool on_main_thread_, installed_ = false;
};

/// Raises what callbacks have raised, if there is anything: Ctrl-C as Interrupted, all else as it is. With
/// Python's lock.
void raise_saved(SavedError& saved);

/// Raises Interrupted, with Python's lock.
[[noreturn]] void raise_interrupted(const char* message);

/// work() without Python's lock. Whatever spends from the budget of its thread ends with BudgetSpent once
/// Ctrl-C has come, which, and what the library makes of it, becomes Interrupted. What a callback has raised
/// is raised in place of whatever the library makes of it; with `threads`, on those that the work starts too.
template <class Work>
auto without_lock(Work&& work, bool threads = false) {
  const Interruption interruption;
  SavedError saved;
  std::optional<SavedError::OfOtherThreads> others;
  if (threads) others.emplace(saved);
  try {
    const auto worked = [&] {
      const SavedError::Scope scope(saved);
      const pybind11::gil_scoped_release released;
      const Budget budget({}, &interruption.stop());
      return work();
    };
    if constexpr (std::is_void_v<decltype(worked())>) {
      worked();
      raise_saved(saved);
    } else {
      auto result = worked();
      raise_saved(saved);
      return result;
    }
  } catch (const pybind11::error_already_set&) {
    throw;
  } catch (const RunError& error) {
    raise_saved(saved);
    if (interruption.taken()) raise_interrupted(error.what());
    throw;
  } catch (...) {
    raise_saved(saved);
    throw;
  }
}

}  // namespace pfaff::python
