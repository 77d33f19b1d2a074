// What Python asks an integration for, in its texts and as the library takes it.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

#include <pfaff/python/src/objects.hpp>
#include <pfaff/runs/start.hpp>

namespace pfaff::python {

/// What an integration begins with.
struct AskedStepping {
  std::shared_ptr<const Model> model;
  std::shared_ptr<const MethodInstance> method;
  std::vector<Real> state;
  Real h, t0, tolerance;
  std::vector<Real> absolute{};
  bool tolerance_forgets = false, quad = false;
};

/// The numbers of texts; InputError, which says `what` they are, where one is none.
std::vector<Real> numbers_of(const std::vector<std::string>& texts, const std::string& what);

/// What a dictionary of Python asks for: the texts "step", "t0" and "tolerance", which is empty where there
/// is none, lists of them "initial" and "absolute", "scales", "quad" and "formulation". InputError for a
/// method that does not fit and for tolerances out of range. It may have to make the motion of the system,
/// which Ctrl-C ends.
AskedStepping asked_stepping(const PySystem& system, const PyMethod& method, const pybind11::dict& asked);

/// The same in a scalar.
template <class T>
Start<T> start_in(const AskedStepping& asked);
extern template Start<double> start_in(const AskedStepping&);
extern template Start<Quad> start_in(const AskedStepping&);

}  // namespace pfaff::python
