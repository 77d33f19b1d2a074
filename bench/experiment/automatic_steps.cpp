#include <pfaff/bench/experiment/automatic_steps.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <pfaff/bench/experiment/error_measure.hpp>
#include <pfaff/bench/runner/csv_cells.hpp>
#include <pfaff/bench/runner/parallel.hpp>
#include <pfaff/bench/runner/steps.hpp>
#include <pfaff/runs/asked_for.hpp>

namespace pfaff {

namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double phase_lost = 0.1;  // an error at which nothing of the motion is left to compare
constexpr double least_gain =
    1.25;  // by which an error falls from rung to rung above round-off, at order 1/2
constexpr double round_off_spread = 10;     // the ratio of errors that are round-off
constexpr std::size_t rungs_in_spread = 5;  // in which an error falls by that ratio at order 1
constexpr std::int64_t part_of_time = 4;    // of the time, of which trials at the fine end take one

std::int64_t rung(std::size_t k) {
  constexpr std::array<std::int64_t, 5> first{10, 16, 25, 40, 64};
  std::int64_t count = first[k % first.size()];
  for (std::size_t decade = k / first.size(); decade > 0; --decade) count *= 10;
  return count;
}

// `size` whole numbers from `low` to `high`, evenly spaced in logarithms.
std::vector<std::int64_t> between(std::int64_t low, std::int64_t high, std::size_t size) {
  std::vector<std::int64_t> counts;
  const double ratio = static_cast<double>(high) / static_cast<double>(low);
  for (std::size_t j = 0; j < size; ++j)
    counts.push_back(std::llround(static_cast<double>(low) *
                                  std::pow(ratio, static_cast<double>(j) / static_cast<double>(size - 1))));
  return counts;
}

// From five to eight numbers of steps from one rung to a later one: rungs, or where there are too few of them
// numbers in between.
std::vector<std::int64_t> spread(std::size_t coarse, std::size_t fine) {
  const std::size_t rungs = fine - coarse + 1;
  if (rungs < fewest_automatic) return between(rung(coarse), rung(fine), fewest_automatic);
  const std::size_t size = std::min(rungs, most_automatic);
  std::vector<std::int64_t> counts;
  for (std::size_t j = 0; j < size; ++j)
    counts.push_back(rung(coarse + (2 * j * (rungs - 1) + size - 1) / (2 * (size - 1))));
  return counts;
}

// Trial runs on the ladder, none of which takes more evaluations than are allowed.
class Ladder {
 public:
  Ladder(const StepTrials& trial, double evaluations) : trial_(trial), evaluations_(evaluations) {}

  // The error on a rung, over the whole time or over the first part of it; nothing where it is not allowed.
  std::optional<double> error(std::size_t k, std::int64_t of_time) {
    const std::int64_t count = rung(k), taken = (count + of_time - 1) / of_time;
    if (!allows(k)) return std::nullopt;
    const StepTrial found = trial_(count, taken);
    // A step takes one evaluation at least, also of a run that ended early.
    per_step_ = std::max(1.0, found.evaluations / static_cast<double>(taken));
    if (!allows(k)) return std::nullopt;
    last_ = k;
    return std::isfinite(found.error) ? found.error : infinity;
  }
  // The finest rung that has been tried and allowed; nothing where there is none.
  [[nodiscard]] std::optional<std::size_t> last() const { return last_; }
  // True where a run on the rung takes no more evaluations than are allowed, to judge by the last trial.
  [[nodiscard]] bool allows(std::size_t k) const {
    return per_step_ * static_cast<double>(rung(k)) <= evaluations_;
  }

 private:
  const StepTrials& trial_;
  double evaluations_, per_step_ = 1;
  std::optional<std::size_t> last_;
};

// The first of two rungs on end whose errors are small; nothing where there are none.
std::optional<std::size_t> coarse_end(Ladder& ladder) {
  bool small = false;
  for (std::size_t k = 0;; ++k) {
    const auto error = ladder.error(k, 1);
    if (!error) return std::nullopt;
    const bool before = small;
    small = *error <= phase_lost;
    if (small && before) return k - 1;
  }
}

// The last rung, from `coarse` on, whose error is smaller than those before it. Where the error has stopped
// to fall, or falls by less than at order 1, the first rung that is near the smallest error: round-off goes
// up and down, and a still smaller error is luck.
std::size_t fine_end(Ladder& ladder, std::size_t coarse) {
  std::vector<double> errors;
  std::size_t fine = coarse;
  double best = infinity;
  bool allowed = true;
  for (std::size_t k = coarse; allowed && k <= fine + 2; ++k) {
    const auto error = ladder.error(k, part_of_time);
    allowed = error.has_value();
    if (!allowed) break;
    errors.push_back(*error);
    if (*error * least_gain >= best) continue;
    best = *error;
    fine = k;
  }
  const auto near =
      std::find_if(errors.begin(), errors.end(), [&](double e) { return e <= round_off_spread * best; });
  const auto first = coarse + static_cast<std::size_t>(near - errors.begin());
  return !allowed && fine - first <= rungs_in_spread ? fine : first;
}
}  // namespace

std::vector<std::int64_t> step_counts(const StepTrials& trial, double evaluations) {
  Ladder ladder(trial, evaluations);
  const auto coarse = coarse_end(ladder);
  const std::size_t fine = coarse ? fine_end(ladder, *coarse) : 0;
  if (coarse && fine > *coarse) return spread(*coarse, fine);
  if (!ladder.last()) return {};
  std::size_t end = coarse.value_or(*ladder.last());
  while (coarse && end + 1 < *coarse + fewest_automatic && ladder.allows(end + 1)) ++end;
  if (end == 0) return {};
  return spread(end + 1 >= fewest_automatic ? end + 1 - fewest_automatic : 0, end);
}

std::vector<const ExperimentRun*> runs_with_automatic_steps(const std::vector<ExperimentRun>& runs) {
  std::vector<const ExperimentRun*> first;
  for (const ExperimentRun& run : runs) {
    const bool seen =
        !first.empty() && first.back()->which == run.which && first.back()->method == run.method;
    if (run.which->automatic && run.tolerance.empty() && !seen) first.push_back(&run);
  }
  return first;
}

std::string step_of_count(const ExperimentRun& run, std::int64_t count) {
  return formatted("%.12g", std::abs(run.resolved.time.value()) / static_cast<double>(count));
}

std::vector<std::vector<std::int64_t>> automatic_step_counts(const Experiment& experiment,
                                                             const std::vector<const ExperimentRun*>& runs,
                                                             References& references) {
  std::vector<std::vector<std::int64_t>> counts(runs.size());
  in_parallel(runs.size(), [&](std::size_t k) {
    const ExperimentRun& like = *runs[k];
    const auto trial = [&](std::int64_t count, std::int64_t taken) {
      ResolvedRun run = like.resolved;
      run.settings.structure_residuals = false;
      run.step = towards(run.time, finite_number(step_of_count(like, count), "--step"));
      run.steps = taken;
      run.every = (taken + 63) / 64;
      const ReferenceSolution* solution = like.which->error.empty() ? references.of(like) : nullptr;
      const RunRecord record = execute(run, solution);
      if (record.interrupted) spend(0, 0);
      return StepTrial{static_cast<double>(record.counters.fields + record.counters.jacobians),
                       record.status == Status::converged ? error_of(*like.which, run, record) : infinity};
    };
    const double evaluations = like.which->evaluations.value_or(default_evaluations);
    counts[k] = step_counts(trial, evaluations);
    if (counts[k].empty())
      throw InputError(experiment.name + ", case " + like.which->name + ", method " + like.method->label +
                       ": key 'evaluations': " + formatted("%.6g", evaluations) +
                       " are too few to choose steps by; expected more");
  });
  return counts;
}

}  // namespace pfaff
