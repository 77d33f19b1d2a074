// Exceptions: those of the libraries as exceptions of Python, which stand in pfaff/_errors.py, where they
// have their docstrings and what they carry besides a message, in words of Python. Notices of the libraries
// are warnings.
#include <pfaff/core/errors/budget.hpp>
#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/errors/notices.hpp>
#include <pfaff/python/src/bindings.hpp>
#include <pfaff/python/src/callbacks.hpp>
#include <pfaff/python/src/words.hpp>

namespace py = pybind11;

namespace pfaff::python {

namespace {
// The class of a name in pfaff._errors. The module is imported by the package before anything can be thrown.
py::object error_class(const char* name) { return py::module_::import("pfaff._errors").attr(name); }

void raise(const char* name, const std::exception& error) {
  PyErr_SetString(error_class(name).ptr(), in_words_of_python(error.what()).c_str());
}
}  // namespace

void bind_errors(py::module_& /*module*/) {
  // Where warnings are errors, the error is raised once the work that gave the notice has ended.
  say_notices_by([](const std::string& text) {
    with_lock([&] {
      if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) != 0) throw py::error_already_set();
    });
  });
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      raise("InputError", error);
    } catch (const BudgetSpent& error) {
      raise(error.stopped() ? "Interrupted" : "RunFailed", error);
    } catch (const RunError& error) {
      raise("RunFailed", error);
    }
  });
}

}  // namespace pfaff::python
