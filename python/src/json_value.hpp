// JSON as objects of Python.
#pragma once

#include <pybind11/pybind11.h>

#include <pfaff/bench/runner/json.hpp>

namespace pfaff::python {

/// Dictionaries, lists, texts, numbers, True, False and None, as json.loads makes them of the text. With
/// Python's lock held.
pybind11::object python_value(const nlohmann::json& json);

}  // namespace pfaff::python
