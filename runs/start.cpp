#include <pfaff/runs/start.hpp>

#include <algorithm>
#include <string>
#include <type_traits>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/runs/asked_for.hpp>

namespace pfaff {

namespace {
template <class T>
void check_state(const Start<T>& start) {
  const Model& model = *start.model;
  const auto dimension = static_cast<std::size_t>(model.dimension());
  if (start.state.size() != dimension)
    throw InputError("initial state of " + model.name() + ": expected " + std::to_string(dimension) +
                     " numbers, got " + std::to_string(start.state.size()));
  for (std::size_t i = 0; i < dimension; ++i)
    if (!isfinite(value_of(start.state[i])))
      throw InputError("initial state of " + model.name() + ": " + model.coordinates()[i].name +
                       " is not finite");
}

template <class T>
void check_tolerances(const Start<T>& start) {
  using V = Value<T>;
  const V tolerance = value_of(start.tolerance);
  if (!(tolerance >= V(0) && tolerance <= V(1)))
    throw InputError("tolerance: expected a number in (0, 1], or 0 for steps of one size");
  if (tolerance > V(0) && !start.method->adaptive())
    throw InputError(start.method->called() + " takes fixed steps only; expected a step without a tolerance" +
                     or_methods_that_choose(*start.model));
  if (start.absolute.empty()) return;
  if (tolerance == V(0)) throw InputError("absolute tolerances: expected a tolerance beside them");
  if (start.absolute.size() != start.state.size())
    throw InputError("absolute tolerances: expected none, or one for each of the " +
                     std::to_string(start.state.size()) + " coordinates of " + start.model->name() +
                     ", got " + std::to_string(start.absolute.size()));
  for (const T& absolute : start.absolute)
    if (!(isfinite(value_of(absolute)) && value_of(absolute) >= V(0)))
      throw InputError("absolute tolerances: expected finite numbers >= 0");
}

template <class T>
void check(const Start<T>& start) {
  using V = Value<T>;
  if (start.model == nullptr || start.method == nullptr)
    throw InputError(std::string("integration: expected a ") + (start.model == nullptr ? "model" : "method"));
  if (const std::string reason = start.method->refuses(*start.model); !reason.empty())
    throw InputError(reason + what_to_do(*start.method, *start.model));
  if (std::is_same_v<V, Quad> && start.method->descriptor().double_coefficients)
    throw InputError(start.method->called() +
                     " has coefficients in double only; expected an integration in double");
  check_state(start);
  check_tolerances(start);
  const bool chooses = value_of(start.tolerance) > V(0);
  if (!isfinite(value_of(start.h)) || (!chooses && value_of(start.h) == V(0)))
    throw InputError("step: expected a finite number other than 0");
  if (!isfinite(value_of(start.t0))) throw InputError("initial time: expected a finite number");
}
}  // namespace

template <class T>
Start<T> checked(Start<T> start) {
  check(start);
  // What a watcher does once for a block is lost beside 256 rows, and a block should stay in the cache.
  if (start.block_rows == 0)
    start.block_rows = std::clamp<std::size_t>(8192 / std::max<std::size_t>(1, start.state.size()), 16, 256);
  return start;
}

template Start<double> checked(Start<double>);
template Start<Quad> checked(Start<Quad>);
template Start<StepDual<double>> checked(Start<StepDual<double>>);
template Start<StepDual<Quad>> checked(Start<StepDual<Quad>>);

}  // namespace pfaff
