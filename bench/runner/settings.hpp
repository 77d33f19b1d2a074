// Settings of a run: what the user asked for, resolved against the plug-ins and checked before work starts.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pfaff/core/formulation.hpp>
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/system.hpp>

namespace pfaff {

enum class Precision { double_precision, quad };

/// "double" or "quad"; InputError otherwise.
Precision parse_precision(const std::string& text);
std::string_view to_string(Precision precision);

/// A whole number of steps > 0; InputError, naming `where`, otherwise.
std::int64_t parse_every(const std::string& text, const std::string& where);

/// A run as it is asked for: all numbers as text, so that each precision parses them exactly.
struct RunSettings {
  std::string system, integrator;
  std::string formulation;           // empty: dirac where the integrator needs a vector field
  Assignments set;                   // nu=0.3, system.nu=0.3, integrator.order=4, initial=1,0.5
  std::vector<std::string> initial;  // empty: the system's own
  std::string t0 = "0", step, tolerance, time;
  std::int64_t every = 0;  // 0: chosen for about a thousand samples
  Precision precision = Precision::double_precision;
  bool project_initial = false;     // move the initial state onto the constraints
  bool allow_inconsistent = false;  // or take it as it is, off them
};

/// A checked run, ready to start.
struct ResolvedRun {
  RunSettings settings;
  std::shared_ptr<const Model> model;
  std::shared_ptr<const MethodInstance> method;
  std::vector<Real> initial;
  double projected = 0;  // the relative change of the initial state where it was moved onto the constraints
  Real t0, step, tolerance, time;
  std::int64_t steps = 0;  // fixed steps only
  std::int64_t every = 1;
  bool structure_residuals = true;  // measured where the model has a structure
  [[nodiscard]] bool adaptive() const { return !settings.tolerance.empty(); }
};

/// Settings split by whom they belong to. A bare key that two of them know must be given as system.KEY,
/// formulation.KEY or integrator.KEY (InputError); `initial` is taken out. Null: there is none.
struct SplitSettings {
  Assignments system, formulation, integrator;
  std::vector<std::string> initial;
};
SplitSettings split_settings(const SystemPlugin& system, const FormulationPlugin* formulation,
                             const MethodPlugin* method, const Assignments& set);

/// The model that a method runs on: the model itself where the method fits, else its motion in Dirac's
/// formulation where it has constraints.
std::shared_ptr<const Model> motion_for(const MethodInstance& method, std::shared_ptr<const Model> model);

/// Where a system is looked at: its model, a state and a time.
struct ResolvedState {
  std::shared_ptr<const Model> model;
  std::vector<Real> state;
  Real t;
};
/// Checks what belongs to the system and its formulation alone: names, parameters, `initial` and `t0`. A
/// system with constraints is looked at in Dirac's formulation unless another is named.
ResolvedState resolve_state(const RunSettings& settings);
/// One finite number for each coordinate of the model; InputError, naming `what` ("initial"), otherwise.
std::vector<Real> state_numbers(const Model& model, const std::vector<std::string>& texts,
                                const std::string& what);

/// Checks everything about a run: names, parameters, fit of method and system, state, step, horizon.
ResolvedRun resolve(const RunSettings& settings);

/// A run as the text of its config.toml, from which it can be run again.
std::string config_text(const ResolvedRun& run);
/// The settings in a config.toml. InputError for unknown keys and wrong types.
RunSettings read_config(const std::string& path);

}  // namespace pfaff
