// Start: what an integration begins with, and its checks.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <pfaff/core/integrator.hpp>

namespace pfaff {

/// What an Integration is made of.
template <class T>
struct Start {
  std::shared_ptr<const Model> model;
  std::shared_ptr<const MethodInstance> method;
  std::vector<T> state;  // a number for each coordinate of the model
  T h{0};                // the step, of either sign; with a tolerance the time between the states looked at
  T t0{0};
  T tolerance{0};              // > 0: the method chooses its steps, see Tolerance
  std::vector<T> absolute{};   // absolute tolerances beside it: none, or one for each coordinate
  std::size_t block_rows = 0;  // the most states that watchers see at once; 0: chosen by their size
};

/// The same with its defaults filled in. InputError for what Integration's constructor refuses.
template <class T>
[[nodiscard]] Start<T> checked(Start<T> start);

}  // namespace pfaff
