// What derivations of growing size left: how fast everything grows with K, as files, for the terminal, and as
// findings.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <pfaff/bench/experiment/experiment.hpp>

namespace pfaff {

/// A slope of least squares with its interval of 95 %.
struct FittedSlope {
  std::size_t points = 0;
  double slope = 0, low = 0, high = 0;
  double residual = 0;  // the sum of squares that is left
};

/// The slope of y over x; needs three points or more, at two places or more.
FittedSlope fitted_slope(const std::vector<double>& x, const std::vector<double>& y);

/// A derivation that was made.
struct Derived {
  std::string method, size;
  std::size_t rods = 0, equations = 0, operations = 0, nodes = 0;
  double tree = 0;  // infinite beyond the range of doubles
  double seconds = 0;
};

/// How a quantity of a method (operations, seconds, tree) grows between two numbers of constraints.
struct Fit {
  std::string method, quantity, law;
  double from = 0, to = 0;
  FittedSlope slope;
};

/// The growth of every method, as far as it has enough derivations.
std::vector<Fit> fits_of(const DerivationStudy& study, const std::vector<Derived>& all);

/// Writes results.csv, cost.csv and fits.csv.
void write_derivation_tables(const std::filesystem::path& directory, const std::vector<Derived>& all,
                             const std::vector<Fit>& fits);

/// The table for the terminal: of each method its largest derivation and its growth.
std::string derivation_table(const DerivationStudy& study, const std::vector<Derived>& all,
                             const std::vector<Fit>& fits);

/// Adds the findings that the study asks for.
void judge_derivations(const DerivationStudy& study, const std::vector<Fit>& fits,
                       ExperimentOutcome& outcome);

}  // namespace pfaff
