// Experiments of the kind `derivation`: how large the equations of a system become and how long it takes to
// derive them, method by method, against the number K of its constraints.
//
//   operations ~ K^a, seconds ~ K^b;   written out without sharing, tree operations ~ e^(c K) or K^c
//
// a, b and c are slopes of least squares over logarithms, each with its interval of 95 % by Student's
// distribution, from K = `fit_from` on. Of trees the law is taken that leaves the smaller residual. The times
// are processor time, and the least of a few repetitions.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

#include <pfaff/bench/experiment/experiment.hpp>

namespace pfaff {

/// Derives what `directory` does not hold yet, one after the other, then writes results.csv, cost.csv,
/// fits.csv, and where they are asked for figures and report.html, as run_experiment does.
ExperimentOutcome derivation_growth(
    const Experiment& experiment, const std::filesystem::path& directory,
    const std::function<void(const std::string& what, std::size_t done, std::size_t all)>& progress,
    const ExperimentOptions& options);

}  // namespace pfaff
