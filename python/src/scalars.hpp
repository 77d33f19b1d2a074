// The scalars of steps as Python sees them: floats, and objects for quads and for numbers with derivatives.
#pragma once

#include <pybind11/numpy.h>

#include <span>
#include <type_traits>
#include <vector>

#include <pfaff/core/facets/scalars.hpp>
#include <pfaff/core/numbers/quad.hpp>

namespace pfaff::python {

/// An array of doubles, or of objects for other scalars.
template <class T>
pybind11::array array_of(std::span<const T> numbers) {
  const auto size = static_cast<pybind11::ssize_t>(numbers.size());
  if constexpr (std::is_same_v<T, double>) {
    return pybind11::array_t<double>(size, numbers.data());
  } else {
    pybind11::list list;
    for (const T& x : numbers) list.append(pybind11::cast(x));
    pybind11::array array(pybind11::dtype("O"), std::vector<pybind11::ssize_t>{size});
    for (pybind11::ssize_t k = 0; k < size; ++k) array[pybind11::int_(k)] = list[static_cast<std::size_t>(k)];
    return array;
  }
}

/// The scalar that a number of Python is: one of its own kind, or any real number; InputError, which begins
/// with `what`, for anything else.
template <class T>
T scalar_from(pybind11::handle object, const char* what);

/// Writes the numbers of a list or an array; InputError, which begins with `what`, where they are not as
/// many, or no numbers.
template <class T>
void write_numbers(const pybind11::object& numbers, std::span<T> to, const char* what);

extern template double scalar_from(pybind11::handle, const char*);
extern template Quad scalar_from(pybind11::handle, const char*);
extern template StepDual<double> scalar_from(pybind11::handle, const char*);
extern template StepDual<Quad> scalar_from(pybind11::handle, const char*);
extern template void write_numbers(const pybind11::object&, std::span<double>, const char*);
extern template void write_numbers(const pybind11::object&, std::span<Quad>, const char*);
extern template void write_numbers(const pybind11::object&, std::span<StepDual<double>>, const char*);
extern template void write_numbers(const pybind11::object&, std::span<StepDual<Quad>>, const char*);

}  // namespace pfaff::python
