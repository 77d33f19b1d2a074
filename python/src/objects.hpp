// The objects that Python holds of the library. Models and methods are immutable and shared.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/tape.hpp>

namespace pfaff::python {

/// A model: `_pfaff.Model`. (pybind11 2.10 has no holder of what is const.)
struct PySystem {
  std::shared_ptr<const Model> model;
};

/// A method with its parameters: `_pfaff.MethodInstance`.
struct PyMethod {
  std::shared_ptr<const MethodInstance> method;
};

/// A recorded formula: `_pfaff.Tape`.
struct PyTape {
  std::shared_ptr<const Tape> tape;
};

/// The number that a text of Python stands for; InputError, which says `what` it is, where it is none.
Real number_of(const std::string& text, const std::string& what);

}  // namespace pfaff::python
