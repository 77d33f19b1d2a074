// What the commands that the library of studies does take from the command line. The program knows all of it,
// with its defaults, without that library.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <pfaff/core/registry/parameter.hpp>
#include <pfaff/integrators/order_conditions/word_conditions.hpp>

namespace pfaff {

/// Options that every command takes.
struct Common {
  bool json = false, quiet = false;
  std::vector<std::string> plugins;
};

/// What is verified.
struct VerificationSettings {
  std::vector<std::string> names{};  // of plug-ins, tables of coefficients or kinds of plug-ins (systems
                                     // ...), or controls; all when empty
  bool full = false;                 // the large orders and more variants too
  bool verbose = false;              // every row of the tables, and no summary
  /// Parameters of the one plug-in that is named, instead of those that it is verified with otherwise.
  Assignments set{};
};

/// How long counterexamples are looked for.
struct FalsificationSettings {
  std::uint64_t seed = 1;
  double budget = 60;  // seconds, for all claims together
  /// The search ends when so many systems have been drawn for each claim, whatever is left of the budget, so
  /// that its results are the same on every machine that is fast enough.
  std::uint64_t systems = std::numeric_limits<std::uint64_t>::max();
};

/// The search of counterexamples, or the judgement of one claim on `system`.
struct FalsificationOptions {
  std::string method, claim, system, step = "1/10", at = "0", out;
  Assignments set;
  std::uint64_t seed = 1, systems = FalsificationSettings().systems;
  std::optional<double> budget;
  int steps = 1;
  bool all = false;
};

/// What is reproduced, of every paper where none is named.
struct ReproductionOptions {
  std::string paper, section;
  bool coverage = false, list = false;
};

/// Which equations are derived. The settings are those of the system and of the method.
struct DerivationSettings {
  std::string system, method, emit = "counts";
  Assignments set;
};

/// Which splitting is made.
struct TuningSettings {
  int order = 4;      // even
  int stages = 6;     // forces a step, of the kernel where there is a processor; drifts come first and last
  int processor = 0;  // the kicks of the processor, which begins with a drift; none where it is 0
  /// Kinetic energies that are quadratic in the momenta need fewer conditions from order 6 on. Processed
  /// methods are made for general parts.
  Parts parts = Parts::general;
  std::uint64_t seed = 1;
  int starts = 60;  // of the search, drawn by `seed`
  /// The sum of the lengths of all flows, taken positive, may be so large at most: long steps back and forth
  /// make terms of higher order large.
  double longest = 5;
};

/// The splitting, the system and step that it is made for, and what is done with it.
struct TuningOptions {
  std::string system, name, out;
  Assignments set;
  std::vector<std::string> beside;
  double step = 0;
  TuningSettings tuning;
};

}  // namespace pfaff
