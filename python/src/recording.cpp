// Tracing: `_pfaff.Number`, whose operators and methods are those that Python's and NumPy's operations on
// objects call, and `_pfaff.Recording`, which makes a tape of what was done with the numbers it gave.
//
// A Python float is the decimal that it is printed as, 0.1 being 1/10 in every precision; fractions stay
// exact.
#include <pfaff/python/src/recording.hpp>

#include <pybind11/stl.h>

#include <pfaff/python/src/bindings.hpp>
#include <pfaff/python/src/number_functions.hpp>
#include <pfaff/python/src/objects.hpp>

namespace py = pybind11;

namespace pfaff::python {

void refuse_traced(const std::string& message) {
  const py::object error = py::module_::import("pfaff._tracing").attr("trace_error")(message);
  PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(error.ptr())), error.ptr());
  throw py::error_already_set();
}

namespace {
void require_open(const Number& x) {
  if (x.recording != nullptr && !x.recording->open)
    refuse_traced(
        "a number of a formula was used after the formula was recorded; expected that it is not kept "
        "outside of the function that it was given to");
}

// The exact constant that a Python number is; nullopt where it is none.
std::optional<Real> constant_from(py::handle object) {
  if (PyBool_Check(object.ptr()) != 0) return std::nullopt;
  if (PyLong_CheckExact(object.ptr()) != 0) {
    int overflow = 0;
    const long long value = PyLong_AsLongLongAndOverflow(object.ptr(), &overflow);
    if (overflow == 0) return Real::fraction(value, 1);
  }
  const py::object text = py::module_::import("pfaff._numbers").attr("text_of_constant")(object);
  if (text.is_none()) return std::nullopt;
  const auto value = Real::parse(text.cast<std::string>());
  if (!value) refuse_traced("expected finite constants in a formula, got " + text.cast<std::string>());
  return value;
}

Number number(Recorded value, const Number& a) { return {std::move(value), a.recording}; }

// An operation on two numbers; NotImplemented where the other operand is no number, so that Python asks that
// one, which may be an array.
template <class Operation>
auto binary(Operation operation, bool reversed = false) {
  return [operation, reversed](const Number& a, const py::object& other) -> py::object {
    require_open(a);
    const std::optional<Number> b = number_from(other);
    if (!b) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
    auto recording = recording_of(a, *b);
    const Recorded &x = reversed ? b->value : a.value, &y = reversed ? a.value : b->value;
    return py::cast(Number{operation(x, y), std::move(recording)});
  };
}

template <class Function>
auto unary(Function function) {
  return [function](const Number& a) {
    require_open(a);
    return number(function(a.value), a);
  };
}

// Something that has no answer while a formula is recorded.
template <class... Arguments>
auto refused(const char* message) {
  return [message](const Number& /*self*/, const Arguments&... /*others*/) -> py::object {
    refuse_traced(message);
  };
}

// The value of a constant; what is recorded has none, of which `message` tells.
double value_of_constant(const Number& x, const char* message) {
  require_open(x);
  if (!x.value.is_constant()) refuse_traced(message);
  return x.value.constant().value();
}

constexpr const char* no_truth =
    "a formula is recorded once and has no values meanwhile, so that it cannot branch on them (if, and, or, "
    "while, min, max); expected pfaff.where(x, a, b), which is a where x > 0 and b elsewhere";
constexpr const char* no_comparison =
    "a formula is recorded once and has no values meanwhile, so that it cannot compare them; expected "
    "pfaff.where(x - y, a, b), which is a where x > y and b elsewhere, also for numpy.sign(x): "
    "pfaff.where(x, 1, -1)";
constexpr const char* no_float =
    "a formula is recorded once and has no values meanwhile, so that it cannot become a float (math.sin and "
    "others of the module math need one, and arrays of floats); expected numpy's functions, such as "
    "numpy.sin, and arrays made like the arguments, such as numpy.zeros_like(y)";
constexpr const char* no_remainder =
    "remainders, whole parts and roundings of the numbers of a formula cannot be recorded; expected + - * / "
    "**, numpy's functions and pfaff.where";

void bind_operators(py::class_<Number>& c) {
  bind_number_functions<Recorded>(
      c, [](auto function) { return unary(function); },
      [](auto operation, bool reversed) { return binary(operation, reversed); });
  const auto power = [](const Recorded& x, const Recorded& y) { return pow(x, y); };
  c.def("__pow__", binary(power))
      .def("__rpow__", binary(power, true))
      .def("__abs__", unary([](const Recorded& x) { return abs(x); }));
}

// Constants, such as parameters, have values, which can be compared.
template <class Comparison>
auto comparison(Comparison compare) {
  return [compare](const Number& a, const py::object& other) -> py::object {
    const std::optional<Number> b = number_from(other);
    if (!b) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
    (void)value_of_constant(a, no_comparison), (void)value_of_constant(*b, no_comparison);
    return py::bool_(compare(a.value.constant().quad(), b->value.constant().quad()));
  };
}

void bind_values(py::class_<Number>& c) {
  using Q = const Quad&;
  c.def("__eq__", comparison([](Q x, Q y) { return x == y; }))
      .def("__ne__", comparison([](Q x, Q y) { return !(x == y); }))
      .def("__lt__", comparison([](Q x, Q y) { return x < y; }))
      .def("__le__", comparison([](Q x, Q y) { return x <= y; }))
      .def("__gt__", comparison([](Q x, Q y) { return x > y; }))
      .def("__ge__", comparison([](Q x, Q y) { return x >= y; }))
      .def("__bool__", [](const Number& x) { return value_of_constant(x, no_truth) != 0; })
      .def("__float__", [](const Number& x) { return value_of_constant(x, no_float); });
  for (const char* name : {"__int__", "__index__", "__complex__"}) c.def(name, refused<>(no_float));
  for (const char* name : {"__mod__", "__rmod__", "__floordiv__", "__rfloordiv__", "__divmod__"})
    c.def(name, refused<py::object>(no_remainder));
  for (const char* name : {"__floor__", "__ceil__", "__trunc__", "rint", "floor", "ceil", "trunc"})
    c.def(name, refused<>(no_remainder));
  c.def("__round__", refused<py::args>(no_remainder));
  c.attr("__hash__") = py::none();
  c.def_property_readonly("constant", [](const Number& x) -> std::optional<std::string> {
    if (!x.value.is_constant()) return std::nullopt;
    return to_string(x.value.constant());
  });
}

// Numbers for a function of the package, which says what was expected of others.
Number number_expected(py::handle object, const char* what) {
  const auto found = number_from(object);
  if (!found)
    refuse_traced(std::string(what) + ": expected numbers, got " +
                  py::str(py::type::of(object)).cast<std::string>());
  return *found;
}

Number where(py::handle condition, py::handle positive, py::handle otherwise) {
  const Number c = number_expected(condition, "where"), a = number_expected(positive, "where"),
               b = number_expected(otherwise, "where");
  auto recording = recording_of(Number{0, recording_of(c, a)}, b);
  return {select(c.value, a.value, b.value), std::move(recording)};
}

std::vector<Number> solved(const std::vector<py::object>& matrix,
                           const std::vector<py::object>& right_hand_side) {
  std::vector<Recorded> a, b;
  Number all{0};
  const auto append = [&](const py::object& entry, std::vector<Recorded>& to) {
    const Number x = number_expected(entry, "solve");
    all.recording = recording_of(all, x);
    to.push_back(x.value);
  };
  for (const py::object& entry : matrix) append(entry, a);
  for (const py::object& entry : right_hand_side) append(entry, b);
  std::vector<Number> x;
  for (Recorded& value : solve(a, b)) x.push_back(number(std::move(value), all));
  return x;
}

PyTape finished(Recording& recording, const std::vector<py::object>& outputs) {
  std::vector<Recorded> results;
  for (const py::object& output : outputs) {
    const Number x = number_expected(output, "results of a formula");
    if (x.recording != nullptr && x.recording.get() != &recording)
      refuse_traced("a result of a formula belongs to another formula");
    results.push_back(x.value);
  }
  recording.open = false;
  return {std::make_shared<const Tape>(recording.recorder.finish(results))};
}
}  // namespace

std::optional<Number> number_from(py::handle object) {
  if (py::isinstance<Number>(object)) {
    const auto& x = object.cast<const Number&>();
    require_open(x);
    return x;
  }
  if (auto value = constant_from(object)) return Number{Recorded(*value), {}};
  return std::nullopt;
}

std::shared_ptr<Recording> recording_of(const Number& a, const Number& b) {
  if (a.recording == nullptr) return b.recording;
  if (b.recording != nullptr && b.recording != a.recording)
    refuse_traced("two numbers belong to different formulas; expected those that the function was given");
  return a.recording;
}

void bind_recording(py::module_& module) {
  py::class_<Number> number_class(module, "Number", "A number of a formula that is being recorded.");
  bind_operators(number_class);
  bind_values(number_class);
  number_class.def("__repr__", [](const Number& x) {
    return x.value.is_constant() ? to_string(x.value.constant()) : std::string("<a number that is recorded>");
  });
  module.def("where", &where);
  module.def("solve", &solved);
  module.def("constant", [](const std::string& text, const std::string& what) {
    return Number{Recorded(number_of(text, what))};
  });

  py::class_<Recording, std::shared_ptr<Recording>>(module, "Recording", "A formula that is being recorded.")
      .def(py::init<int>())
      .def_property_readonly("time",
                             [](const std::shared_ptr<Recording>& r) {
                               return Number{r->recorder.time(), r};
                             })
      .def_property_readonly("inputs",
                             [](const std::shared_ptr<Recording>& r) {
                               std::vector<Number> numbers;
                               for (Recorded& x : r->recorder.inputs()) numbers.push_back({std::move(x), r});
                               return numbers;
                             })
      .def("close", [](Recording& r) { r.open = false; })
      .def("finish", &finished);
}

}  // namespace pfaff::python
