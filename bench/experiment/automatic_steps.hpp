// steps = "auto": the steps of a case, chosen for each method by trial runs that count evaluations and
// errors.
//
// A run of the duration T takes steps T/N. The whole numbers N that are tried are a ladder of five rungs a
// decade, 10, 16, 25, 40, 64, 100, ..., so that T/N has few digits wherever T has. Nothing is measured with a
// clock: what is chosen follows from the experiment alone, and is the same whenever and wherever it is
// chosen.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <pfaff/bench/experiment/references.hpp>

namespace pfaff {

/// The fewest and the most steps that are chosen for a method.
constexpr std::size_t fewest_automatic = 5, most_automatic = 8;

/// The evaluations that a run at a chosen step may take where the case says nothing.
constexpr double default_evaluations = 1e6;

/// What a trial run has cost, in evaluations of right-hand sides and Jacobians, and its largest error,
/// infinite where it failed.
struct StepTrial {
  double evaluations = 0, error = 0;
};

/// Makes a trial run with steps T/N, N = `count`, of which it takes the first `taken`.
using StepTrials = std::function<StepTrial(std::int64_t count, std::int64_t taken)>;

/// Chooses the numbers N of steps, in rising order, from 5 to 8 of them. The first is where errors over the
/// whole time have come below 0.1 for good, that is on its rung and on the next. The last is where the error
/// has come within a factor of ten of the smallest, which is round-off, or where a run would take more than
/// `evaluations`. Trials at the fine end take a quarter of the time: truncation and round-off both grow with
/// time, and the step at which they meet hardly depends on it. Where no error is below 0.1 the five finest
/// rungs that the evaluations allow are taken, and where the first rung is round-off already five from there.
/// Empty where the evaluations do not suffice for two rungs.
std::vector<std::int64_t> step_counts(const StepTrials& trial, double evaluations);

/// The pairs of a case with automatic steps and a method of it that takes fixed steps, as runs at a step that
/// stands for those to be chosen: the first run of each pair among `runs`.
std::vector<const ExperimentRun*> runs_with_automatic_steps(const std::vector<ExperimentRun>& runs);

/// The numbers of steps for each of these runs. InputError, which names case and method, where the
/// evaluations of the case do not suffice.
std::vector<std::vector<std::int64_t>> automatic_step_counts(const Experiment& experiment,
                                                             const std::vector<const ExperimentRun*>& runs,
                                                             References& references);

/// The step that divides the duration of the run into `count`.
std::string step_of_count(const ExperimentRun& run, std::int64_t count);

}  // namespace pfaff
