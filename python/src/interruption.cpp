#include <pfaff/python/src/interruption.hpp>

#include <chrono>
#include <thread>

#include <pfaff/python/src/bindings.hpp>

namespace py = pybind11;

namespace pfaff::python {

namespace {
std::atomic<bool> asked_to_stop{false};
std::atomic<bool> interpreter_ends{false};
std::atomic<int> under_way{0};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may set it");

bool handles = false;  // of the main thread alone
struct sigaction handler_of_python {};

void note_and_pass_on(int number) {
  asked_to_stop.store(true);
  handler_of_python.sa_handler(number);
}

// Looked up once, since it takes as long as a short call.
bool is_main_thread() {
  static const auto main =
      py::module_::import("threading").attr("main_thread")().attr("ident").cast<unsigned long>();
  return main == PyThread_get_thread_ident();
}
}  // namespace

Interruption::Interruption() : on_main_thread_(is_main_thread()) {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  ++under_way;
  if (!on_main_thread_ || handles) return;
  asked_to_stop.store(false);
  struct sigaction action {};
  sigaction(SIGINT, nullptr, &handler_of_python);
  const auto handler = handler_of_python.sa_handler;
  if (handler == SIG_IGN || handler == SIG_DFL || (handler_of_python.sa_flags & SA_SIGINFO) != 0) return;
  action = handler_of_python;
  action.sa_handler = &note_and_pass_on;
  sigaction(SIGINT, &action, nullptr);
  handles = installed_ = true;
}

Interruption::~Interruption() {
  --under_way;
  if (!installed_) return;
  sigaction(SIGINT, &handler_of_python, nullptr);
  handles = false;
}

const std::atomic<bool>& Interruption::stop() const {
  return on_main_thread_ ? asked_to_stop : interpreter_ends;
}

bool Interruption::taken() const {
  if (!stop().load()) return false;
  // Where a handler of the user's own raises nothing, the work has ended all the same; what else it raises
  // passes.
  if (PyErr_CheckSignals() != 0) {
    if (PyErr_ExceptionMatches(PyExc_KeyboardInterrupt) == 0) throw py::error_already_set();
    PyErr_Clear();
  }
  return true;
}

namespace {
// A thread that comes back from its work when the interpreter has ended would be ended in the middle of C++.
void end_all_work() {
  interpreter_ends.store(true);
  const py::gil_scoped_release released;
  using namespace std::chrono_literals;
  for (int k = 0; k < 5000 && under_way.load() > 0; ++k) std::this_thread::sleep_for(1ms);
}
}  // namespace

void bind_interruption(py::module_& /*module*/) {
  py::module_::import("atexit").attr("register")(py::cpp_function(&end_all_work));
}

void raise_saved(SavedError& saved) {
  if (!saved.holds()) return;
  const py::object error = saved.taken();
  if (PyErr_GivenExceptionMatches(error.ptr(), PyExc_KeyboardInterrupt) != 0) {
    const py::object interrupted = py::module_::import("pfaff._errors").attr("Interrupted");
    PyErr_SetObject(interrupted.ptr(), interrupted().ptr());
  } else {
    PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(error.ptr())), error.ptr());
  }
  throw py::error_already_set();
}

void raise_interrupted(const char* message) {
  PyErr_SetString(py::module_::import("pfaff._errors").attr("Interrupted").ptr(), message);
  throw py::error_already_set();
}

}  // namespace pfaff::python
