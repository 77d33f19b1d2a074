#include <pfaff/runs/start.hpp>

#include <algorithm>
#include <string>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/runs/asked_for.hpp>

namespace pfaff {

namespace {
template <class T>
void complete_and_check(Start<T>& start) {
  using V = Value<T>;
  if (start.model == nullptr || start.method == nullptr)
    throw InputError(std::string("integration: expected a ") + (start.model == nullptr ? "model" : "method"));
  if (const std::string reason = start.method->refuses(*start.model); !reason.empty())
    throw InputError(reason + what_to_do(*start.method, *start.model));
  check_place(*start.model, start.state, start.h, start.t0, value_of(start.tolerance) > V(0));
  constexpr std::size_t most_rows = 1U << 20U;
  if (start.block_rows > most_rows)
    throw InputError("rows of a block: expected at most " + std::to_string(most_rows) + ", got " +
                     std::to_string(start.block_rows));
  if (start.absolute.size() == 1) start.absolute.assign(start.state.size(), T(start.absolute.front()));
  std::vector<Quad> absolute;
  for (const T& x : start.absolute) absolute.emplace_back(value_of(x));
  if (const V tolerance = value_of(start.tolerance); tolerance != V(0)) {
    check_tolerances(*start.method, *start.model, Quad(tolerance), absolute);
  } else if (!absolute.empty()) {
    throw InputError("absolute tolerances: expected a tolerance beside them");
  }
}
}  // namespace

template <class T>
void check_place(const Model& model, const std::vector<T>& state, const T& h, const T& t0, bool chooses) {
  const auto dimension = static_cast<std::size_t>(model.dimension());
  if (state.size() != dimension)
    throw InputError("initial state of " + model.name() + ": expected " + std::to_string(dimension) +
                     " numbers, got " + std::to_string(state.size()));
  for (std::size_t i = 0; i < dimension; ++i)
    if (!isfinite(value_of(state[i])))
      throw InputError("initial state of " + model.name() + ": " + model.coordinates()[i].name +
                       " is not finite");
  if (!isfinite(value_of(h)) || (!chooses && value_of(h) == Value<T>(0)))
    throw InputError("step: expected a finite number other than 0");
  if (!isfinite(value_of(t0))) throw InputError("initial time: expected a finite number");
}

void check_tolerances(const MethodInstance& method, const Model& model, const Quad& tolerance,
                      const std::vector<Quad>& absolute, const ToleranceNames& names) {
  if (!(tolerance > Quad(0) && tolerance <= Quad(1)))
    throw InputError(names.tolerance + ": expected a number in (0, 1]" + names.got);
  if (!method.adaptive())
    throw InputError(method.called() + " takes fixed steps only; expected " + names.without +
                     or_methods_that_choose(model));
  const auto dimension = static_cast<std::size_t>(model.dimension());
  if (!absolute.empty() && absolute.size() != dimension)
    throw InputError(names.absolute + ": expected one number, or one for each of the " +
                     std::to_string(dimension) + " coordinates of " + model.name() + ", got " +
                     std::to_string(absolute.size()));
  for (const Quad& x : absolute)
    if (!(isfinite(x) && x >= Quad(0)))
      throw InputError(names.absolute + ": expected finite numbers >= 0, got " + to_string(x, 6));
}

template <class T>
Start<T> checked(Start<T> start) {
  complete_and_check(start);
  // What a watcher does once for a block is lost beside 256 rows, and a block should stay in the cache.
  if (start.block_rows == 0)
    start.block_rows = std::clamp<std::size_t>(8192 / std::max<std::size_t>(1, start.state.size()), 16, 256);
  return start;
}

template Start<double> checked(Start<double>);
template void check_place(const Model&, const std::vector<double>&, const double&, const double&, bool);
template Start<Quad> checked(Start<Quad>);
template void check_place(const Model&, const std::vector<Quad>&, const Quad&, const Quad&, bool);
template Start<StepDual<double>> checked(Start<StepDual<double>>);
template void check_place(const Model&, const std::vector<StepDual<double>>&, const StepDual<double>&,
                          const StepDual<double>&, bool);
template Start<StepDual<Quad>> checked(Start<StepDual<Quad>>);
template void check_place(const Model&, const std::vector<StepDual<Quad>>&, const StepDual<Quad>&,
                          const StepDual<Quad>&, bool);

}  // namespace pfaff
