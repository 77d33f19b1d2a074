// Callbacks: functions of Python that C++ calls, and what they raise.
//
// An exception of Python never travels through the library, which may put it into words, keep it or drop it
// without Python's lock. It is saved for the work that is under way on its thread, a PythonError goes through
// the library in its place, and whoever began the work raises the saved one.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <stdexcept>

namespace pfaff::python {

/// What goes through C++ in place of an exception of Python: its words.
class PythonError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The first exception that callbacks of one piece of work have raised.
class SavedError {
 public:
  SavedError() = default;
  SavedError(const SavedError&) = delete;
  SavedError& operator=(const SavedError&) = delete;
  ~SavedError();

  /// While it lives, callbacks on its thread save here.
  class Scope {
   public:
    explicit Scope(SavedError& saved);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    SavedError* before_;
  };

  /// While it lives, callbacks on threads that save nowhere else save here: those that the work starts. Of
  /// several at a time the first one counts.
  class OfOtherThreads {
   public:
    explicit OfOtherThreads(SavedError& saved);
    ~OfOtherThreads();
    OfOtherThreads(const OfOtherThreads&) = delete;
    OfOtherThreads& operator=(const OfOtherThreads&) = delete;

   private:
    bool first_;
  };

  [[nodiscard]] bool holds() const { return holds_.load(); }
  /// The exception, which is then no longer held. With Python's lock.
  [[nodiscard]] pybind11::object taken();
  void save(pybind11::error_already_set& error);

 private:
  std::atomic<bool> holds_{false};
  std::mutex mutex_;
  PyObject* value_ = nullptr;
};

/// Saves an exception for the work on this thread, and throws a PythonError in its place. With Python's lock.
[[noreturn]] void pass_on(pybind11::error_already_set& error);

/// An object of Python that may be held, copied and dropped without Python's lock.
class SharedObject {
 public:
  SharedObject() = default;
  explicit SharedObject(pybind11::object object);
  /// With Python's lock.
  [[nodiscard]] const pybind11::object& get() const { return *object_; }
  [[nodiscard]] explicit operator bool() const { return object_ != nullptr; }

 private:
  std::shared_ptr<const pybind11::object> object_;
};

/// call() with Python's lock; what it raises is saved, and a PythonError is thrown.
template <class Call>
auto with_lock(Call&& call) {
  const pybind11::gil_scoped_acquire lock;
  try {
    return call();
  } catch (pybind11::error_already_set& error) {
    pass_on(error);
  }
}

}  // namespace pfaff::python
