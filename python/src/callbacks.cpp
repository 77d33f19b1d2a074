#include <pfaff/python/src/callbacks.hpp>

#include <string>

namespace py = pybind11;

namespace pfaff::python {

namespace {
thread_local SavedError* saved_here = nullptr;
std::atomic<SavedError*> saved_elsewhere{nullptr};
}  // namespace

SavedError::~SavedError() {
  if (value_ == nullptr) return;
  const py::gil_scoped_acquire lock;
  Py_DECREF(value_);
}

SavedError::Scope::Scope(SavedError& saved) : before_(saved_here) { saved_here = &saved; }
SavedError::Scope::~Scope() { saved_here = before_; }

SavedError::OfOtherThreads::OfOtherThreads(SavedError& saved) {
  SavedError* none = nullptr;
  first_ = saved_elsewhere.compare_exchange_strong(none, &saved);
}
SavedError::OfOtherThreads::~OfOtherThreads() {
  if (first_) saved_elsewhere = nullptr;
}

py::object SavedError::taken() {
  const std::lock_guard lock(mutex_);
  holds_ = false;
  return py::reinterpret_steal<py::object>(std::exchange(value_, nullptr));
}

void SavedError::save(py::error_already_set& error) {
  const std::lock_guard lock(mutex_);
  if (value_ != nullptr) return;
  error.restore();
  PyObject *type = nullptr, *value = nullptr, *trace = nullptr;
  PyErr_Fetch(&type, &value, &trace);
  PyErr_NormalizeException(&type, &value, &trace);
  if (trace != nullptr) PyException_SetTraceback(value, trace);
  value_ = value;
  Py_XDECREF(type);
  Py_XDECREF(trace);
  holds_ = true;
}

void pass_on(py::error_already_set& error) {
  const std::string words = error.what();
  if (SavedError* const saved = saved_here != nullptr ? saved_here : saved_elsewhere.load())
    saved->save(error);
  throw PythonError(words.substr(0, words.find('\n')));
}

SharedObject::SharedObject(py::object object)
    : object_(new py::object(std::move(object)), [](const py::object* held) {
        if (Py_IsInitialized() == 0) return;  // what is left at the end of the interpreter stays
        const py::gil_scoped_acquire lock;
        delete held;
      }) {}

}  // namespace pfaff::python
