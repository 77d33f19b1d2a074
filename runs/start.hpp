// Start: what an integration begins with, and its checks.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/core/facets/method_instance.hpp>

namespace pfaff {

/// What an Integration is made of.
template <class T>
struct Start {
  std::shared_ptr<const Model> model;
  std::shared_ptr<const MethodInstance> method;
  std::vector<T> state;  // a number for each coordinate of the model
  T h{0};                // the step, of either sign; with a tolerance the time between the states looked at
  T t0{0};
  T tolerance{0};                  // > 0: the method chooses its steps, see Tolerance
  std::vector<T> absolute{};       // absolute tolerances beside it: none, one, or one for each coordinate
  bool tolerance_forgets = false;  // see Tolerance
  std::size_t block_rows = 0;      // the most states that watchers see at once; 0: chosen by their size
};

/// The start of an integration by a method that outlives it.
template <class T>
[[nodiscard]] Start<T> start_with(const MethodInstance& method, std::shared_ptr<const Model> model,
                                  std::vector<T> state, const T& h, const T& t0) {
  return {std::move(model), {std::shared_ptr<const void>(), &method}, std::move(state), h, t0};
}

/// Refuses (InputError) a state of another size or with a number that is not finite, a step of zero where the
/// method does not choose its own, and a step or a time that is not finite.
template <class T>
void check_place(const Model& model, const std::vector<T>& state, const T& h, const T& t0, bool chooses);

/// What messages call the tolerances of a method that chooses its steps.
struct ToleranceNames {
  std::string tolerance = "tolerance", absolute = "absolute tolerances";
  std::string got{};                                   // what was given, after the range of the tolerance
  std::string without = "a step without a tolerance";  // what is expected of methods with fixed steps
};
/// Refuses (InputError) a method that takes fixed steps, and tolerances out of range. There are no absolute
/// ones, or one for each coordinate.
void check_tolerances(const MethodInstance& method, const Model& model, const Quad& tolerance,
                      const std::vector<Quad>& absolute, const ToleranceNames& names = {});

/// The same with its defaults filled in. InputError for what Integration's constructor refuses.
template <class T>
[[nodiscard]] Start<T> checked(Start<T> start);

}  // namespace pfaff
