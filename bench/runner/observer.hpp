// What is measured of a run while it goes: invariants and their drift, residuals, errors.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/bench/runner/early_extents.hpp>
#include <pfaff/bench/runner/record.hpp>
#include <pfaff/bench/runner/steps.hpp>
#include <pfaff/bench/runner/watched_error.hpp>
#include <pfaff/core/errors/budget.hpp>
#include <pfaff/runs/block_values.hpp>
#include <pfaff/runs/measure.hpp>
#include <pfaff/runs/support/constraints.hpp>
#include <pfaff/runs/support/growth.hpp>
#include <pfaff/runs/support/own_range.hpp>
#include <pfaff/runs/support/rank_watch.hpp>
#include <pfaff/runs/support/setback.hpp>

namespace pfaff {

/// Measures a run computed in the scalar T as it goes, into `record`.
template <class T>
class Observer {
 public:
  Observer(const ResolvedRun& run, const ReferenceSolution* reference, SampleTaker* samples,
           RunRecord& record)
      : run_(run),
        reference_(reference),
        samples_(samples),
        record_(record),
        problem_(run.model),
        constraints_(*run.model),
        rank_(run.model, [this](const T& t, const T& span, std::vector<T>& z) { return move(t, span, z); }),
        values_(run.model->invariants().size()),
        in_double_(static_cast<std::size_t>(run.model->dimension())),
        state_(in_double_.size()),
        extents_(static_cast<std::size_t>(run.adaptive() ? most_intervals : run.rows()) + 1) {
    if (reference != nullptr) {
      record.reference = reference->kind();
      record.reference_ended = reference->ended();
    }
    if (run.settings.structure_residuals && !run.adaptive()) watch_structure();
    if (!values_.empty()) roundings_.emplace(run.model->tape(Formula::invariants));
    if (run.model->restricted()) constraint_roundings_.emplace(run.model->tape(Formula::constraints));
    if (reference != nullptr && changes(run)) exact_.emplace(run.model);
    drift_.resize(values_.size());
    constraint_drift_.resize(constraint_residual_names(*run.model).size());
    growth_.resize(constraint_drift_.size());
    for (const Invariant& invariant : run.model->invariants())
      setbacks_.emplace_back(run.expected(invariant));
  }

  /// Takes the state at time t. Every call counts for drift, setbacks and constraint residuals; `keep` also
  /// adds a row to the series, and `structure` a structure residual to that row. Says what is not finite or
  /// was singular on the way here, or nothing. A row is kept where state and invariants are finite, without
  /// the error where that is not. `exact` is the time without rounding, at which the error is measured
  /// where a row is kept: n steps lead to t0 + n h, and the solution moves on in half a unit in the last
  /// place of t.
  [[nodiscard]] std::string observe(const T& t, const Quad& exact, const std::vector<T>& z, bool keep,
                                    bool structure) {
    if (const std::string singular = rank_.observe(t, z); !singular.empty()) {
      singular_ = true;
      return singular + "; this was seen";
    }
    const auto& invariants = run_.model->invariants();
    if (!values_.empty()) problem_.invariants(t, z, values_);
    for (std::size_t i = 0; i < values_.size(); ++i)
      if (!isfinite(values_[i])) return "the invariant " + invariants[i].name + " is not finite";
    if (initial_.empty()) initial_ = values_;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const bool finite =
          drift_[i].add(static_cast<double>(t), static_cast<double>(values_[i] - initial_[i]));
      setbacks_[i].add(values_[i]);
      if (invariants[i].behaviour == Behaviour::conserved && !finite)
        return "the drift of " + invariants[i].name + " is not finite";
      if (!std::isfinite(setbacks_[i].largest()))
        return "the setback of " + invariants[i].name + " is not finite";
    }
    constraints_(t, z, residuals_);
    for (std::size_t i = 0; i < residuals_.size(); ++i)
      if (!constraint_drift_[i].add(static_cast<double>(t), static_cast<double>(residuals_[i])))
        return "the residual " + constraint_residual_names(*run_.model)[i] + " is not finite";
    return keep ? observe_sample(t, exact, z, structure) : std::string();
  }

  [[nodiscard]] bool measures_errors() const { return reference_ != nullptr; }

  /// Evaluates the invariants at all states of a block, for take() and sample(), which look at them as
  /// observe() does. False where one is not finite, or where states have to be observed one by one.
  [[nodiscard]] bool evaluate(const Block<T>& block) {
    if (run_.model->restricted() || rank_.watches()) return false;
    if (values_.empty()) return true;
    if (block_values_ == nullptr)
      block_values_ =
          std::make_unique<BlockValues<T>>(run_.model, Formula::invariants, values_.size(), block.capacity);
    in_block_ = &(*block_values_)(block);
    errors_.resize(values_.size() * block.rows);
    bool fit = true;
    for (std::size_t i = 0; i < values_.size(); ++i)
      for (std::size_t row = 0; row < block.rows; ++row) {
        const double error = static_cast<double>(in_block_->at(row, i) - initial_[i]);
        errors_[i * block.rows + row] = error;
        fit = fit && std::abs(error) <= 1e150;
      }
    return fit;
  }
  /// Takes the first rows of an evaluated block for drift and setbacks.
  void take(const Block<T>& block, std::size_t rows) {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      drift_[i].add(static_cast<double>(block.t0), static_cast<double>(block.h), block.first, block.stride,
                    {errors_.data() + i * block.rows, rows});
      if (setback_words(run_.model->invariants()[i].behaviour))
        for (std::size_t row = 0; row < rows; ++row) setbacks_[i].add(in_block_->at(row, i));
    }
  }
  /// Keeps a row of an evaluated block.
  [[nodiscard]] std::string sample(const Block<T>& block, std::size_t row, const Quad& exact,
                                   bool structure) {
    for (std::size_t i = 0; i < values_.size(); ++i) values_[i] = in_block_->at(row, i);
    block.states.get(row, state_);
    return observe_sample(block.time(row), exact, state_, structure);
  }

  /// Puts into the record what follows from all that was observed.
  void finish() {
    if (singular_) record_.status = Status::singular;
    compare_last();
    record_.error_rows = std::max<std::int64_t>(0, compared_ - 1);
    record_.reached_rows = std::max<std::int64_t>(0, reached_ - 1);
    // Of a solution that reaches no sample but the first, the error there says nothing of the method.
    if (compared_ == 1 && record_.sample_count > 1) record_.error_max = record_.error_final = std::nullopt;
    finished_ = true;
    pass_on();
    if (!begun_) begin(false);
    const double unit = std::is_same_v<T, Quad> ? 0x1p-113 : 0x1p-53;
    const std::vector<double> ranges = ranges_of_invariants();
    for (std::size_t i = 0; i < drift_.size(); ++i) {
      RoundOff round_off = roundings_->largest(unit, record_.completed, i, drift_.size());
      if (i < ranges.size()) round_off.range = ranges[i];
      record_.drift.push_back(drift_[i].result(round_off));
      record_.round_off.push_back(round_off);
    }
    for (const Setback<T>& s : setbacks_) record_.setback.push_back(s.largest());
    // Constraints and hidden ones stand by turns.
    for (std::size_t i = 0; i < constraint_drift_.size(); ++i)
      record_.constraints.push_back(constraint_drift_[i].result(
          constraint_roundings_->largest(unit, record_.completed, i, constraint_drift_.size())));
    for (const GrowthFit& fit : growth_) record_.growth.push_back(fit.growth());
  }

 private:
  // Moves z from t over a span that is at most a few steps long, without the history of the run.
  Status move(const T& t, const T& span, std::vector<T>& z) {
    if (!apart_) apart_ = run_.method->stepper(run_.model, T());
    apart_->forget();
    if (run_.adaptive()) {
      T from = t;
      return apart_->advance_to(from, t + span, T(run_.tolerance), z);
    }
    const double steps = std::ceil(std::abs(static_cast<double>(span / T(run_.step))) - 1e-9);
    const std::int64_t count = std::max<std::int64_t>(1, static_cast<std::int64_t>(steps));
    std::int64_t completed = 0;
    return apart_->advance(t, 0, span / T(static_cast<double>(count)), count, z, completed);
  }
  static bool changes(const ResolvedRun& run) {
    const auto& invariants = run.model->invariants();
    return std::any_of(invariants.begin(), invariants.end(),
                       [](const Invariant& i) { return i.behaviour != Behaviour::conserved; });
  }
  // A run that is told to end meanwhile ends before its first step.
  void watch_structure() try {
    const auto measure = measure_asked_for("structure");
    if (!measure->refuses(*run_.model, *run_.method).empty()) return;
    start_.emplace(start_of<T>(run_));
    solution_ = solution_of(run_);
    structure_ = measure->on({*start_, run_.steps, *solution_});
    if (structure_->looks().empty()) structure_.reset();
  } catch (const BudgetSpent&) {
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
  }

  std::string observe_sample(const T& t, const Quad& exact_time, const std::vector<T>& z, bool structure) {
    for (std::size_t k = 0; k < z.size(); ++k) in_double_[k] = static_cast<double>(z[k]);
    for (auto* roundings : {&roundings_, &constraint_roundings_})
      if (*roundings) (*roundings)->add(static_cast<double>(t), in_double_);
    extents_.add(in_double_);
    if (record_.sample_count == 0) {
      first_state_ = in_double_;
      if (roundings_) first_terms_ = roundings_->terms();
      record_.first_invariants.assign(values_.begin(), values_.end());
    }
    for (std::size_t i = 0; i < growth_.size(); ++i)
      growth_[i].add(std::abs(static_cast<double>(Quad(t) - run_.t0.quad())),
                     static_cast<double>(residuals_[i]));
    Sample<T>& sample = last_ == &one_ ? other_ : one_;
    sample.t = t;
    sample.state = z, sample.invariants = values_, sample.constraints = residuals_;
    sample.structure.reset(), sample.error.reset();
    sample.invariant_errors.clear();
    std::string not_finite = compare_some(sample, exact_time);
    if (structure && structure_) measure_structure(t, z, sample);
    pass_on();
    last_ = &sample;
    waits_ = true;
    record_.last_sample = Quad(t);
    ++record_.sample_count;
    // With a reference solution the second sample says whether there are errors, and one that is not compared
    // is if it turns out to be the last to which the solution reaches.
    if (reference_ == nullptr || (begun_ && !not_compared_)) pass_on();
    return not_finite;
  }
  // Passes on the last sample, if it waits for that.
  void pass_on() {
    if (!std::exchange(waits_, false)) return;
    if (!begun_) begin(compared_ > 1 || not_compared_ || (compared_ == 1 && finished_));
    if (samples_ != nullptr) samples_->take(*last_);
  }
  void begin(bool error) {
    begun_ = true;
    if (!error && last_ != nullptr) last_->error.reset(), last_->invariant_errors.clear();
    if (samples_ != nullptr) samples_->begin({error, error && exact_, structure_ != nullptr});
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
    if (reference_ == nullptr) return {};
    if (!reference_->covers(exact_time)) {
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
    const std::vector<Quad> exact = reference_->at(exact_time);
    if (exact_) sample.invariant_errors = errors_of_invariants(sample, exact_time, exact);
    const Quad error = relative_error(sample, exact);
    if (!std::isfinite(static_cast<double>(error)))
      return "the error against the " + std::string(reference_->kind()) +
             " solution (--reference none leaves it out) is not finite";
    ++compared_;
    sample.error = error;
    worst(record_.error_max, static_cast<double>(error));
    record_.error_final = static_cast<double>(error);
    return {};
  }
  // What there is of each invariant to lose; the extents are those of the first tenth of the motion, since
  // what is lost or blows up changes them.
  [[nodiscard]] std::vector<double> ranges_of_invariants() const {
    if (record_.sample_count == 0 || !roundings_) return {};
    StartOfMotion start{
        static_cast<double>(T(run_.t0)), first_state_, extents_.first_tenth(), {}, first_terms_};
    for (const Quad& value : record_.first_invariants) start.values.push_back(static_cast<double>(value));
    return own_ranges(*run_.model, start);
  }
  static void worst(std::optional<double>& slot, double value) {
    if (!slot || value > *slot) slot = value;
  }
  [[nodiscard]] std::vector<Quad> errors_of_invariants(const Sample<T>& sample, const Quad& exact_time,
                                                       const std::vector<Quad>& exact) {
    std::vector<Quad> off, values(sample.invariants.size());
    exact_->invariants(exact_time, exact, values);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (run_.model->invariants()[i].behaviour != Behaviour::conserved)
        off.push_back(Quad(sample.invariants[i]) - values[i]);
    return off;
  }
  [[nodiscard]] static Quad relative_error(const Sample<T>& sample, const std::vector<Quad>& exact) {
    Quad distance(0), norm(0);
    for (std::size_t k = 0; k < exact.size(); ++k) {
      const Quad d = Quad(sample.state[k]) - exact[k];
      distance += d * d;
      norm += exact[k] * exact[k];
    }
    return distance == Quad(0) ? Quad(0) : sqrt(distance / norm);
  }

  const ResolvedRun& run_;
  const ReferenceSolution* reference_;
  SampleTaker* samples_;
  RunRecord& record_;
  Problem<T> problem_;
  std::int64_t compared_ = 0;            // samples, with the reference solution,
  std::int64_t reached_ = 0;             // of so many to which it reaches
  std::optional<Quad> not_compared_;     // the time of the last sample, where it is one of the others
  std::optional<Problem<Quad>> exact_;   // of invariants that change, where there is a reference solution
  std::optional<Integration<T>> start_;  // of the run, for the measure of its structure
  std::unique_ptr<SharedSolution> solution_;
  std::unique_ptr<Measuring<T>> structure_;
  ConstraintResiduals<T> constraints_;
  RankWatch<T> rank_;
  StepperPointer<T> apart_;  // for steps that are not the run's own
  bool singular_ = false;
  std::optional<RoundingSizes> roundings_, constraint_roundings_;  // of invariants, and of constraints
  std::unique_ptr<BlockValues<T>> block_values_;                   // made with the first block
  const Tiles<T>* in_block_ = nullptr;                             // the invariants at the rows of a block,
  std::vector<double> errors_;                                     // and each less its first value
  std::vector<T> values_, initial_, residuals_;
  std::vector<double> in_double_, first_state_;  // the state
  std::vector<T> state_;                         // at a row of a block
  std::vector<double> first_terms_;              // of the invariants: the magnitudes of their terms at first
  std::vector<Setback<T>> setbacks_;
  std::vector<WatchedError> drift_, constraint_drift_;
  std::vector<GrowthFit> growth_;  // of the residuals of constraints
  EarlyExtents extents_;
  Sample<T> one_, other_;      // the last sample and the one before, by turns
  Sample<T>* last_ = nullptr;  // one of them,
  bool waits_ = false;         // which is not passed on yet
  bool begun_ = false, finished_ = false;
};

}  // namespace pfaff
