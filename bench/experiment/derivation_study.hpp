// Experiments of the kind `derivation`: how large the equations of a system become and how long it takes to
// derive them, method by method, against the number K of its constraints.
//
//   operations ~ K^a, seconds ~ K^b;   written out without sharing, tree operations ~ e^(c K) or K^c
//
// a, b and c are slopes of least squares over logarithms, each with its interval of 95 % by Student's
// distribution, from K = `fit_from` on. Of trees the law is taken that leaves the smaller residual. The times
// are processor time, and the least of a few repetitions.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <pfaff/core/registry/parameter.hpp>

namespace pfaff {

class Keys;
struct Experiment;
struct ExperimentOptions;
struct ExperimentOutcome;

/// One method, with the values of the system's parameter at which it derives equations, in rising order.
struct DerivationSweep {
  std::string method;
  std::vector<std::string> sizes;
  double exponent_below = 0;  // a finding: the exponent of the operations stays below this; 0 for none
};

/// A published time for one pair of equations, factor e^(rate K) seconds.
struct PublishedTime {
  std::string label;
  double factor = 0, rate = 0;
};

struct DerivationStudy {
  std::string system, parameter;  // the parameter that makes it larger
  Assignments set;
  double seconds = 60;  // a method goes no further after a derivation that takes longer
  double fit_from = 8;
  std::vector<DerivationSweep> sweeps;
  std::vector<PublishedTime> published;

  /// The number of derivations.
  [[nodiscard]] std::size_t size() const;
};

/// Reads what such an experiment has beside title and references. InputError as read_experiment.
DerivationStudy read_derivation_study(Keys& keys, const std::string& where, bool quick);

/// Derives what `directory` does not hold yet, one after the other, then writes results.csv, cost.csv,
/// fits.csv, and where they are asked for figures and report.html, as run_experiment does.
ExperimentOutcome run_derivation_study(
    const Experiment& experiment, const std::filesystem::path& directory,
    const std::function<void(const std::string& what, std::size_t done, std::size_t all)>& progress,
    const ExperimentOptions& options);

/// A slope of least squares with its interval of 95 %.
struct FittedSlope {
  std::size_t points = 0;
  double slope = 0, low = 0, high = 0;
  double residual = 0;  // the sum of squares that is left
};

/// The slope of y over x; needs three points or more, at two places or more.
FittedSlope fitted_slope(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace pfaff
