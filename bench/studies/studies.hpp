// The library of studies, libpfaff_studies: verification, falsification, reproduction, derivation and tuning,
// and the commands that are about them.
//
// Runs and experiments need none of it, with one exception, experiments of the kind `derivation`. So it is a
// library of its own, built after this one or not at all, and loaded when it is first asked for. It stands
// beside this library, and what it does is registered while it is loaded, as plug-ins are. A program that is
// linked to it has it from the start.
//
// Types and tables are shared with it, so that it fits one build alone. Which one is read from its file
// before it is loaded: linking leaves the build IDs of libpfaff and libpfaff_bench in it, in an ELF note.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

#include <pfaff/bench/studies/options.hpp>

namespace pfaff {

struct Experiment;
struct ExperimentOptions;
struct ExperimentOutcome;

/// What the library does. Commands print their results and return the exit status.
struct StudyFunctions {
  int (*verify)(const VerificationSettings&, const Common&);
  int (*falsify)(const FalsificationOptions&, const Common&);
  int (*reproduce)(const ReproductionOptions&, const Common&);
  int (*derive)(const DerivationSettings&, const Common&);
  int (*tune)(const TuningOptions&, const Common&);
  /// What run_experiment does with an experiment of the kind `derivation`.
  ExperimentOutcome (*derivation_growth)(
      const Experiment& experiment, const std::filesystem::path& directory,
      const std::function<void(const std::string& what, std::size_t done, std::size_t all)>& progress,
      const ExperimentOptions& options);
};

/// The functions of the library, which is loaded where it is not yet. InputError, which names the line that
/// mends it, where it is missing, damaged or of another build.
const StudyFunctions& studies();

/// Hands the functions over: a static object of the library.
struct StudiesRegistration {
  explicit StudiesRegistration(const StudyFunctions& functions);
};

}  // namespace pfaff
