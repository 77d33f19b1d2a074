// An integration as Python has it: one interface for both precisions, samples as arrays, and watchers that
// are functions of Python.
#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/python/src/arrays.hpp>
#include <pfaff/python/src/asked_stepping.hpp>
#include <pfaff/python/src/callbacks.hpp>
#include <pfaff/runs/integration.hpp>

namespace pfaff::python {

/// How a call that takes steps ended, and the states that were asked for: rows (t, z) one behind the other.
struct StepsTaken {
  bool reached = false;
  std::string status = "converged", message;
  std::int64_t steps = 0;
  Numbers t, y;
};

class Stepping {
 public:
  virtual ~Stepping() = default;
  Stepping() = default;
  Stepping(const Stepping&) = delete;
  Stepping& operator=(const Stepping&) = delete;

  // These take steps without Python's lock. What was reached and kept before something was raised stays, see
  // taken(). `every` is 0 where no states are kept.
  virtual void steps(std::int64_t count, std::int64_t every) = 0;
  virtual void to(const Real& t, std::int64_t every) = 0;
  /// From now on so many steps may be taken, tries of a method that chooses them among them; BudgetSpent
  /// where they have run out.
  virtual void allow(std::int64_t steps) = 0;
  /// How many of them are left.
  [[nodiscard]] virtual std::int64_t allowed() const = 0;
  /// The call that took steps last; its samples are moved out.
  [[nodiscard]] virtual StepsTaken taken() = 0;

  [[nodiscard]] virtual double time() const = 0;
  [[nodiscard]] virtual std::vector<double> state() const = 0;
  /// All digits.
  [[nodiscard]] virtual std::vector<std::string> state_as_texts() const = 0;
  [[nodiscard]] virtual double step() const = 0;
  [[nodiscard]] virtual std::int64_t steps_taken() const = 0;
  [[nodiscard]] virtual Counters counters() const = 0;
  [[nodiscard]] virtual std::shared_ptr<const Model> model() const = 0;
  [[nodiscard]] virtual std::unique_ptr<Stepping> beside(const std::vector<Real>& state) const = 0;
  [[nodiscard]] virtual std::unique_ptr<Stepping> reversed() const = 0;
  virtual void turn() = 0;
  virtual void forget() = 0;
  /// At the time that was reached and with the same step, in all digits, where others are not given.
  virtual void go_on_from(const std::vector<Real>& state, const std::optional<Real>& t0,
                          const std::optional<Real>& h) = 0;
  /// `callback`(t, z) is called after each `every` steps; the integration ends there where it gives True.
  /// Gives a number by which it is known.
  virtual std::int64_t watch(SharedObject callback, std::int64_t every) = 0;
  /// The callback of that number is not called any more. Other than the rest, it may be called while another
  /// call takes steps, as a callback does.
  virtual void unwatch(std::int64_t number) = 0;
  /// The state after so many steps from here, and its derivatives with respect to the state here, row-major.
  /// The integration stays where it is.
  [[nodiscard]] virtual std::pair<std::vector<double>, std::vector<double>> jacobian(
      std::int64_t count) const = 0;
};

/// InputError where what is asked for does not fit together, and where the state is not one to begin at.
std::unique_ptr<Stepping> make_stepping(const AskedStepping& asked);

/// The model that a method steps on, by a formulation that is named or, for an empty name, the usual one.
std::shared_ptr<const Model> model_for(const MethodInstance& method,
                                       const std::shared_ptr<const Model>& model,
                                       const std::string& formulation);

}  // namespace pfaff::python
