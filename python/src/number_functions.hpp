// What Python does with the numbers of formulas and with those of steps: operators, and the functions that
// NumPy asks the objects of an array for by these names.
#pragma once

#include <pybind11/pybind11.h>

#include <pfaff/core/numbers/special.hpp>

namespace pfaff::python {

/// Defines them for the class of a number. `unary` and `binary` make of a function of scalars T one of
/// numbers of the class, or of one and an object; binary(function, true) has its operands in the other order.
template <class T, class Number, class Unary, class Binary>
void bind_number_functions(pybind11::class_<Number>& c, const Unary& unary, const Binary& binary) {
  using X = const T&;
  c.def("__add__", binary([](X x, X y) { return T(x + y); }, false))
      .def("__radd__", binary([](X x, X y) { return T(x + y); }, true))
      .def("__sub__", binary([](X x, X y) { return T(x - y); }, false))
      .def("__rsub__", binary([](X x, X y) { return T(x - y); }, true))
      .def("__mul__", binary([](X x, X y) { return T(x * y); }, false))
      .def("__rmul__", binary([](X x, X y) { return T(x * y); }, true))
      .def("__truediv__", binary([](X x, X y) { return T(x / y); }, false))
      .def("__rtruediv__", binary([](X x, X y) { return T(x / y); }, true))
      .def("__neg__", unary([](X x) { return T(-x); }))
      .def("__pos__", unary([](X x) { return x; }))
      .def("sqrt", unary([](X x) { return T(sqrt(x)); }))
      .def("exp", unary([](X x) { return T(exp(x)); }))
      .def("log", unary([](X x) { return T(log(x)); }))
      .def("sin", unary([](X x) { return T(sin(x)); }))
      .def("cos", unary([](X x) { return T(cos(x)); }))
      .def("tan", unary([](X x) { return T(sin(x) / cos(x)); }))
      .def("arcsin", unary([](X x) { return T(asin(x)); }))
      .def("arccos", unary([](X x) { return T(acos(x)); }))
      .def("arctan", unary([](X x) { return T(atan(x)); }))
      .def("sinh", unary([](X x) { return T(sinh(x)); }))
      .def("cosh", unary([](X x) { return T(cosh(x)); }))
      .def("tanh", unary([](X x) { return T(tanh(x)); }))
      .def("erf", unary([](X x) { return T(erf(x)); }))
      .def("conjugate", unary([](X x) { return x; }))
      .def("arctan2", binary([](X y, X x) { return T(atan2(y, x)); }, false))
      .def("hypot", binary([](X x, X y) { return T(sqrt(x * x + y * y)); }, false));
}

}  // namespace pfaff::python
