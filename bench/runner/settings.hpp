// Settings of a run: what the user asked for, resolved against the plug-ins and checked before work starts.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pfaff/bench/runner/origins.hpp>
#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/runs/integration.hpp>
#include <pfaff/runs/support/setback.hpp>

namespace pfaff {

enum class Precision { double_precision, quad };

/// "double" or "quad"; InputError otherwise.
Precision parse_precision(const std::string& text);
std::string_view to_string(Precision precision);

/// The number of steps between samples, a whole number > 0; otherwise InputError, which names `where`.
std::int64_t parse_every(const std::string& text, const std::string& where);

/// What the errors of a run are measured against.
enum class ErrorsAgainst {
  none,     // errors are not measured
  exact,    // the exact solution, where the system has one
  solution  // the exact solution or else Taylor series in quad
};
std::string_view to_string(ErrorsAgainst against);

/// A reference as it is asked for. Errors are measured at most_error_rows rows of the series, or at every
/// row.
struct AskedReference {
  ErrorsAgainst against = ErrorsAgainst::exact;
  bool every_row = false;
};
/// One of the names of `known` and "every", or both with a comma between them: "every" alone takes the first
/// name. InputError, which begins with `where`, otherwise.
AskedReference parse_reference(const std::string& text, const std::string& where,
                               const std::vector<ErrorsAgainst>& known);
std::string to_string(const AskedReference& asked);
/// The names that a run knows; the first is meant where nothing is said.
inline const std::vector<ErrorsAgainst> references_of_runs{ErrorsAgainst::exact, ErrorsAgainst::solution,
                                                           ErrorsAgainst::none};

/// The most rows of a series behind the first at which errors are measured where not every row is asked for:
/// a closed form in quad takes some ten times as long as a step.
inline constexpr std::int64_t most_error_rows = 200;

/// The number of steps that a run may take where nothing else is said.
constexpr std::int64_t default_step_budget = 1000000000000;

/// A run as it is asked for. All numbers are text, so that each precision parses every digit.
struct RunSettings {
  std::string system, integrator;
  // In the place of what is registered as `system` and as `integrator`, with their parameters. A run with one
  // of them cannot be made again from its files.
  std::shared_ptr<const Model> model{};
  std::shared_ptr<const MethodInstance> method{};
  std::string formulation;  // empty: that of formulation_for() where the integrator needs a vector field
  Assignments set;          // nu=0.3, system.nu=0.3, integrator.order=4, initial=1,0.5
  std::vector<std::string> initial, initial_velocities;  // where `set` says nothing of the state
  // A duration that is negative goes back in time. The step is a size, or has the sign of the duration.
  std::string t0 = "0", step, tolerance, time;
  std::vector<std::string> absolute;  // beside the tolerance: none, one for all coordinates, or one for each
  std::int64_t every = 0;             // 0: chosen for about a thousand samples, 200 of processed methods
  Precision precision = Precision::double_precision;
  bool compile = false;  // compile the formulas that are not (core/native/compiled_model.hpp), in double
  bool project_initial = false;     // move the initial state onto the constraints
  bool allow_inconsistent = false;  // or take it as it is though it is off them
  ErrorsAgainst reference = ErrorsAgainst::exact;
  bool errors_at_every_row = false;                // otherwise at most_error_rows rows at most
  bool structure_residuals = true;                 // measured where the model has a structure
  std::int64_t step_budget = default_step_budget;  // more steps are refused, or end the run
  std::string of_case, of_method;                  // what an experiment calls the run; otherwise empty
};

/// The parts of a list "a,b,c" of numbers.
std::vector<std::string> split_commas(const std::string& text);

/// A plug-in with its parameters, as texts for the reader call it: "gauss stages=2".
std::string called(std::string name, const Assignments& parameters);

/// A checked run, ready to start.
struct ResolvedRun {
  RunSettings settings;
  std::shared_ptr<const Model> model;
  std::shared_ptr<const MethodInstance> method;
  std::vector<Real> initial;
  std::vector<Real> given_initial;  // `initial` before it was moved onto the constraints
  double projected = 0;  // the relative change of the initial state where it was moved onto the constraints
  Real t0, step, tolerance, time;  // step and time are negative where the run goes back
  std::vector<Real> absolute;      // absolute tolerances: none, or one for each coordinate
  std::int64_t steps = 0;          // fixed steps only
  std::int64_t every = 1;
  Origins origins;            // the files and builds that it was made from
  std::string not_conserved;  // of what is said to be (stated_identities.hpp)
  [[nodiscard]] bool adaptive() const { return !settings.tolerance.empty(); }
  /// Of the series of a run with fixed steps, behind the first.
  [[nodiscard]] std::int64_t rows() const { return (steps + every - 1) / every; }
  [[nodiscard]] bool backwards() const { return time < Real(0); }
  /// What is expected of an invariant in the direction of the run.
  [[nodiscard]] Behaviour expected(const Invariant& invariant) const {
    return backwards() ? seen_backwards(invariant.behaviour) : invariant.behaviour;
  }
};

/// The absolute tolerances of a run in its scalar, for a Tolerance of it.
template <class T>
std::vector<T> absolute_tolerances(const ResolvedRun& run) {
  std::vector<T> numbers;
  for (const Real& x : run.absolute) numbers.push_back(T(x));
  return numbers;
}

/// What an Integration of a run is made of, in the scalar T. A method that chooses its steps has no interval.
template <class T>
Start<T> start_of(const ResolvedRun& run) {
  Start<T> start{run.model, run.method, {}, T(0), T(run.t0)};
  for (const Real& x : run.initial) start.state.push_back(T(x));
  if (run.adaptive()) {
    start.tolerance = T(run.tolerance);
    start.absolute = absolute_tolerances<T>(run);
  } else {
    start.h = T(run.step);
  }
  return start;
}

/// Settings sorted by the plug-in they belong to. A bare key that two of the plug-ins know must be given as
/// system.KEY, formulation.KEY or integrator.KEY (InputError otherwise). The state, `initial` and
/// `initial_velocities`, belongs to none of them and is taken out. `formulation` and `method` may be null
/// where the run has none.
struct SplitSettings {
  Assignments system, formulation, integrator;
  std::vector<std::string> initial, initial_velocities;
};
SplitSettings split_settings(const SystemPlugin& system, const FormulationPlugin* formulation,
                             const MethodPlugin* method, const Assignments& set);

/// A system at one state and time.
struct ResolvedState {
  std::shared_ptr<const Model> model;
  std::vector<Real> state;
  Real t;
};
/// Resolves and checks what belongs to the system and its formulation alone: names, parameters, the state and
/// `t0`. A system with constraints is taken in the formulation that formulation_for() gives.
ResolvedState resolve_state(const RunSettings& settings);

/// Checks everything about a run: names, parameters, fit of method and system, state, step, horizon. Paths of
/// files among the parameters become absolute.
ResolvedRun resolve(const RunSettings& settings);

}  // namespace pfaff
