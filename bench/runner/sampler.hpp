// The samples of a run: the rows of its series, with errors against a solution and residuals of its
// structure.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/bench/runner/record.hpp>
#include <pfaff/core/errors/budget.hpp>
#include <pfaff/runs/measure.hpp>
#include <pfaff/runs/watched/solution_errors.hpp>

namespace pfaff {

/// Makes the samples of a run computed in the scalar T and passes them on, each as soon as all of it is
/// known. What is measured of them goes into `record`.
template <class T>
class Sampler {
 public:
  Sampler(const ResolvedRun& run, const ReferenceSolution* reference, SampleTaker* taker, RunRecord& record)
      : run_(run), taker_(taker), record_(record) {
    if (reference != nullptr) {
      errors_.emplace(run.model, *reference);
      record.reference = reference->kind();
      record.reference_ended = reference->ended();
    }
    if (run.settings.structure_residuals && !run.adaptive()) watch_structure();
  }

  [[nodiscard]] bool measures_errors() const { return errors_.has_value(); }

  /// Makes a sample of the state at time t, with the residual of a step from there where `structure` asks for
  /// it. Says what is not finite, as a phrase, or nothing; the sample is kept then, without its error.
  /// `exact` is the time without rounding, at which errors are measured.
  [[nodiscard]] std::string sample(const T& t, const Quad& exact, const std::vector<T>& z,
                                   const std::vector<T>& invariants, const std::vector<T>& residuals,
                                   bool structure) {
    if (record_.sample_count == 0) record_.first_invariants.assign(invariants.begin(), invariants.end());
    Sample<T>& sample = last_ == &one_ ? other_ : one_;
    sample.t = t;
    sample.state = z, sample.invariants = invariants, sample.constraints = residuals;
    sample.structure.reset(), sample.error.reset();
    sample.invariant_errors.clear();
    std::string not_finite = compare_some(sample, exact);
    if (structure && structure_) measure_structure(t, z, sample);
    pass_on();
    last_ = &sample;
    waits_ = true;
    record_.last_sample = Quad(t);
    ++record_.sample_count;
    // With a solution the second sample says whether there are errors, and one that is not compared is if it
    // turns out to be the last to which the solution reaches.
    if (!errors_ || (begun_ && !not_compared_)) pass_on();
    return not_finite;
  }

  /// Whether samples without residuals of the structure may be passed on as rows, since nothing else is
  /// measured of them.
  [[nodiscard]] bool takes_rows() const { return begun_ && !errors_; }
  [[nodiscard]] bool measures_structure() const { return structure_ != nullptr; }
  /// Makes samples of rows.
  void sample(const SampleRows<T>& samples) {
    if (taker_ != nullptr) taker_->take(samples);
    record_.last_sample = Quad(samples.block.time(samples.rows.last()));
    record_.sample_count += static_cast<std::int64_t>(samples.rows.count);
  }

  /// Passes on what waits, and puts into the record what follows from all samples.
  void finish() {
    compare_last();
    record_.error_rows = std::max<std::int64_t>(0, compared_ - 1);
    record_.reached_rows = std::max<std::int64_t>(0, reached_ - 1);
    // Of a solution that reaches no sample but the first, the error there says nothing of the method.
    if (compared_ == 1 && record_.sample_count > 1) record_.error_max = record_.error_final = std::nullopt;
    finished_ = true;
    pass_on();
    if (!begun_) begin(false);
  }

 private:
  // A run that is told to end meanwhile ends before its first step.
  void watch_structure() try {
    const auto measure = measure_asked_for("structure");
    if (!measure->refuses(*run_.model, *run_.method).empty()) return;
    start_.emplace(start_of<T>(run_));
    solution_ = solution_of(run_);
    structure_ = measure->on({*start_, run_.steps, *solution_, *start_});
    if (structure_->looks().empty()) structure_.reset();
  } catch (const BudgetSpent&) {
  } catch (const RunError&) {  // of a method whose steps have no digits beyond those of a double
    structure_.reset();
    ++record_.structure_failures;
  }
  // A run that is told to end meanwhile keeps the sample without its residual, and ends at its next step.
  void measure_structure(const T& t, const std::vector<T>& z, Sample<T>& sample) try {
    Row row(1);
    if (!structure_->look({record_.completed, t, z}, row)) return;
    const T r = std::get<T>(row[0]);
    if (std::isfinite(static_cast<double>(r))) {
      sample.structure = r;
      worst(record_.structure_residual, static_cast<double>(r));
    } else {
      ++record_.structure_failures;
    }
  } catch (const BudgetSpent&) {
  } catch (const RunError&) {  // of a method whose steps have no derivatives
    ++record_.structure_failures;
  }

  // Passes on the last sample, if it waits for that.
  void pass_on() {
    if (!std::exchange(waits_, false)) return;
    if (!begun_) begin(compared_ > 1 || not_compared_ || (compared_ == 1 && finished_));
    if (taker_ != nullptr) taker_->take(*last_);
  }
  void begin(bool error) {
    begun_ = true;
    if (!error && last_ != nullptr) last_->error.reset(), last_->invariant_errors.clear();
    if (taker_ != nullptr)
      taker_->begin({error, error && !errors_->changing().empty(), structure_ != nullptr});
  }
  // Whether the error is measured at a row: at the last of each of so many equal parts of the rows behind the
  // first, the last row of a whole run among them.
  [[nodiscard]] bool compares(std::int64_t row) const {
    const std::int64_t rows = run_.rows();
    if (row == 0 || run_.adaptive() || rows <= most_error_rows || run_.settings.errors_at_every_row)
      return true;
    return row * most_error_rows / rows > (row - 1) * most_error_rows / rows;
  }
  // Compares the next sample with the solution, where that reaches to it and the row is one of those chosen.
  std::string compare_some(Sample<T>& sample, const Quad& exact_time) {
    if (!errors_) return {};
    if (!errors_->solution().covers(exact_time)) {
      compare_last();
      return {};
    }
    ++reached_;
    if (compares(record_.sample_count)) return compare(sample, exact_time);
    not_compared_ = exact_time;
    return {};
  }
  // The last row to which the solution reaches is among those that are compared.
  void compare_last() {
    if (not_compared_) (void)compare(*last_, *not_compared_);
  }
  std::string compare(Sample<T>& sample, const Quad& exact_time) {
    not_compared_.reset();
    const Quad error = (*errors_)(exact_time, sample.state);
    sample.invariant_errors = errors_->of_invariants(sample.invariants);
    if (!std::isfinite(static_cast<double>(error)))
      return "the error against the " + errors_->solution().kind() +
             " solution (--reference none leaves it out) is not finite";
    ++compared_;
    sample.error = error;
    worst(record_.error_max, static_cast<double>(error));
    record_.error_final = static_cast<double>(error);
    return {};
  }
  static void worst(std::optional<double>& slot, double value) {
    if (!slot || value > *slot) slot = value;
  }

  const ResolvedRun& run_;
  SampleTaker* taker_;
  RunRecord& record_;
  std::optional<SolutionErrors<T>> errors_;
  std::int64_t compared_ = 0;            // samples, with the solution,
  std::int64_t reached_ = 0;             // of so many to which it reaches
  std::optional<Quad> not_compared_;     // the time of the last sample, where it is one of the others
  std::optional<Integration<T>> start_;  // of the run, for the measure of its structure
  std::unique_ptr<SharedSolution> solution_;
  std::unique_ptr<Measuring<T>> structure_;
  Sample<T> one_, other_;      // the last sample and the one before, by turns
  Sample<T>* last_ = nullptr;  // one of them,
  bool waits_ = false;         // which is not passed on yet
  bool begun_ = false, finished_ = false;
};

}  // namespace pfaff
