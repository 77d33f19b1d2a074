// The scalars: those in which a registered method steps, and those for which formulas are compiled. These two
// lists are the only ones.
//
// A scalar is added by a name in StepScalars. It owes what StepScalar asks (core/numbers/formula_scalar.hpp),
// and everything here that is made for each scalar in turn, factories and explicit instantiations, follows.
#pragma once

#include <type_traits>
#include <utility>

#include <pfaff/core/numbers/dual.hpp>

namespace pfaff {

class Recorded;

/// The number of directions in which one pass of a step is differentiated.
inline constexpr int step_directions = 4;

/// A number with its derivatives in these directions, by which the Jacobian of a step is found.
template <class T>
using StepDual = Dual<T, step_directions>;

/// A list of scalars.
template <class... T>
struct Scalars {};

/// Those in which methods step.
using StepScalars = Scalars<double, Quad, StepDual<double>, StepDual<Quad>>;

template <class List, class T>
struct WithScalar;
template <class... T, class U>
struct WithScalar<Scalars<T...>, U> {
  using type = Scalars<T..., U>;
};
/// Those for which the formulas of systems with any number of bodies are compiled: the same and the recording
/// scalar, with which such formulas are put on a tape.
using FormulaScalars = WithScalar<StepScalars, Recorded>::type;

/// The interface of an object that makes a Made<T> for every T of a list: one virtual function each,
/// make_for(std::type_identity<T>(), args...).
template <template <class> class Made, class List, class... Args>
class Maker;
template <template <class> class Made, class... Args>
class Maker<Made, Scalars<>, Args...> {
 public:
  Maker() = default;
  Maker(const Maker&) = delete;
  Maker& operator=(const Maker&) = delete;
  virtual ~Maker() = default;
  void make_for() const = delete;  // a name for the first `using` below
};
template <template <class> class Made, class T, class... Rest, class... Args>
class Maker<Made, Scalars<T, Rest...>, Args...> : public Maker<Made, Scalars<Rest...>, Args...> {
 public:
  using Makes = Maker;
  using Maker<Made, Scalars<Rest...>, Args...>::make_for;
  [[nodiscard]] virtual Made<T> make_for(std::type_identity<T> scalar, Args... args) const = 0;
};

}  // namespace pfaff
