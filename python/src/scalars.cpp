#include <pfaff/python/src/scalars.hpp>

#include <cstdlib>
#include <optional>
#include <string>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/numbers/formula_scalar.hpp>
#include <pfaff/python/src/bindings.hpp>
#include <pfaff/python/src/number_functions.hpp>
#include <pfaff/python/src/recording.hpp>

namespace py = pybind11;

namespace pfaff::python {

namespace {
// The constant that a number of Python is, exact to quad; nullopt for what is none.
std::optional<Real> real_from(py::handle object) {
  const py::object text = py::module_::import("pfaff._numbers").attr("text_of_constant")(object);
  if (text.is_none()) return std::nullopt;
  if (auto value = Real::parse(text.cast<std::string>())) return value;
  if (PyFloat_Check(object.ptr()) != 0) return Real(Quad(PyFloat_AS_DOUBLE(object.ptr())));  // inf and nan
  return std::nullopt;
}
// What is said where a step makes a float of a number of more than 53 bits or with derivatives. A float would
// have none of them, and nobody would see it.
constexpr const char* no_float_of_step =
    "a number of the step has derivatives here, or the digits of quad, and cannot become a float (math.sin "
    "and others of the "
    "module math need one, and arrays of floats); expected numpy's functions, such as numpy.sin, and arrays "
    "like the state, "
    "such as numpy.zeros_like(z)";
// What messages show of an object.
std::string shown(py::handle object) {
  return py::module_::import("pfaff._arguments").attr("shown")(object).cast<std::string>();
}
template <class T>
std::optional<T> known_scalar(py::handle object) {
  if (py::isinstance<T>(object)) return object.cast<const T&>();
  if (const auto value = real_from(object)) return T(*value);
  return std::nullopt;
}

// An operation on two numbers; NotImplemented where the other one is no number.
template <class T, class Operation>
auto binary(Operation operation, bool reversed = false) {
  return [operation, reversed](const T& a, const py::object& other) -> py::object {
    const std::optional<T> b = known_scalar<T>(other);
    if (!b) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
    return py::cast(reversed ? operation(*b, a) : operation(a, *b));
  };
}

template <class T>
T power(const T& x, const T& y) {
  return exp(y * log(x));
}

// Whole and other constant powers, which negative numbers have too.
template <class T>
py::object power_of(const T& x, const py::object& exponent) {
  if (py::isinstance<T>(exponent)) return py::cast(power(x, exponent.cast<const T&>()));
  const auto value = real_from(exponent);
  if (!value) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
  const auto whole = value->is_fraction() && value->denominator() == 1 ? value->numerator() : 0;
  if (whole == 0 || std::abs(whole) > 32) return py::cast(pow(x, *value));
  T product = x;
  for (std::int64_t k = 1; k < std::abs(whole); ++k) product = product * x;
  return py::cast(whole < 0 ? T(1) / product : product);
}

template <class T>
void bind_scalar(py::module_& module, const char* name, const char* meaning) {
  py::class_<T> c(module, name, meaning);
  bind_number_functions<T>(
      c, [](auto function) { return function; },
      [](auto operation, bool reversed) { return binary<T>(operation, reversed); });
  const auto size = [](const T& x) { return value_of(x) < Value<T>(0) ? T(-x) : x; };
  c.def("__lt__", binary<T>([](const T& x, const T& y) { return value_of(x) < value_of(y); }))
      .def("__le__", binary<T>([](const T& x, const T& y) { return value_of(x) <= value_of(y); }))
      .def("__gt__", binary<T>([](const T& x, const T& y) { return value_of(x) > value_of(y); }))
      .def("__ge__", binary<T>([](const T& x, const T& y) { return value_of(x) >= value_of(y); }))
      .def("__eq__", binary<T>([](const T& x, const T& y) { return value_of(x) == value_of(y); }))
      .def("__rpow__", binary<T>([](const T& x, const T& y) { return power(x, y); }, true))
      .def("__pow__", &power_of<T>)
      .def("__abs__", size)
      .def("fabs", size)
      .def("__float__", [](const T&) -> double { refuse_traced(no_float_of_step); })
      .def("__repr__", [](const T& x) { return to_string(Quad(value_of(x)), 36); });
  c.attr("__hash__") = py::none();
}
}  // namespace

template <class T>
T scalar_from(py::handle object, const char* what) {
  if constexpr (std::is_same_v<T, double>) {
    // A complex number of NumPy becomes a float too, by losing its imaginary part.
    if (PyComplex_Check(object.ptr()) == 0) {
      const double value = PyFloat_AsDouble(object.ptr());
      if (PyErr_Occurred() == nullptr) return value;
      PyErr_Clear();
    }
  } else {
    if (auto value = known_scalar<T>(object)) return *value;
  }
  throw InputError(std::string(what) + ": expected a number, got " + shown(object));
}

template <class T>
void write_numbers(const py::object& numbers, std::span<T> to, const char* what) {
  if (!py::isinstance<py::sequence>(numbers) && !py::isinstance<py::array>(numbers))
    throw InputError(std::string(what) + ": expected a list or an array of " + std::to_string(to.size()) +
                     " numbers, got " + shown(numbers));
  const std::size_t size = py::len(numbers);
  if (size != to.size())
    throw InputError(std::string(what) + ": expected " + std::to_string(to.size()) + " numbers, got " +
                     std::to_string(size));
  for (std::size_t k = 0; k < size; ++k) {
    const py::object one = numbers[py::int_(k)];
    to[k] = scalar_from<T>(one, what);
  }
}

template double scalar_from(py::handle, const char*);
template Quad scalar_from(py::handle, const char*);
template StepDual<double> scalar_from(py::handle, const char*);
template StepDual<Quad> scalar_from(py::handle, const char*);
template void write_numbers(const py::object&, std::span<double>, const char*);
template void write_numbers(const py::object&, std::span<Quad>, const char*);
template void write_numbers(const py::object&, std::span<StepDual<double>>, const char*);
template void write_numbers(const py::object&, std::span<StepDual<Quad>>, const char*);

void bind_scalars(py::module_& module) {
  bind_scalar<Quad>(module, "Quad", "A number of quad precision.");
  bind_scalar<StepDual<double>>(module, "Dual", "A number with its derivatives in four directions.");
  bind_scalar<StepDual<Quad>>(module, "QuadDual", "A number of quad precision with its derivatives.");
}

}  // namespace pfaff::python
