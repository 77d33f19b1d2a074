// The watcher of a run: it shows its states to all that is watched, and ends it where something is not
// finite.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <pfaff/bench/runner/sampler.hpp>
#include <pfaff/bench/runner/steps.hpp>
#include <pfaff/core/errors/budget.hpp>
#include <pfaff/runs/integration.hpp>
#include <pfaff/runs/support/rank_watch.hpp>
#include <pfaff/runs/watched/constraints.hpp>
#include <pfaff/runs/watched/invariants.hpp>

namespace pfaff {

/// Watches a run in the scalar T, for its record.
template <class T>
class Observing final : public Watcher<T> {
 public:
  Observing(const ResolvedRun& run, const ReferenceSolution* reference, SampleTaker* taker,
            const Progress& progress, RunRecord& record)
      : run_(run),
        record_(record),
        progress_(progress),
        structure_rows_(std::max<std::int64_t>(1, (run.steps / run.every + 1) / 50)),
        invariants_(run.model, run.backwards(),
                    static_cast<std::size_t>(run.adaptive() ? most_intervals : run.rows()) + 1),
        constraints_(*run.model),
        rank_(run.model, [this](const T& t, const T& span, std::vector<T>& z) { return move(t, span, z); }),
        sampler_(run, reference, taker, record),
        z_(run.initial.size()),
        in_double_(z_.size()) {}

  void start(const Integration<T>& run) override {
    stand_at(run);
    (void)ended_by(observe(run.time(), exact(run, 0), true, true), run.time(), 0);
  }
  // Nobody else watches, so that what is seen here may be kept.
  std::size_t end(const Integration<T>& run, const Block<T>& block) override {
    return seen_together(block) ? together(run, block) : one_by_one(run, block);
  }
  void look(const Integration<T>& /*run*/, const Block<T>& /*block*/) override {}
  /// The state that is reached, where it is none of those that are shown.
  void last(const Integration<T>& run) {
    stand_at(run);
    (void)one(run, run.steps_taken(), run.time());
  }
  /// The state that a method that chooses its steps has come to, where a sample is due; true where that ends
  /// the run.
  [[nodiscard]] bool chosen(const Integration<T>& run) {
    stand_at(run);
    return ended_by(observe(run.time(), Quad(run.time()), true, false), run.time(), run.counters().steps);
  }
  [[nodiscard]] bool ended() const { return ended_; }

  /// Puts into the record what follows from all that was seen.
  void finish() {
    if (singular_) record_.status = Status::singular;
    sampler_.finish();
    const auto later = [steps = record_.completed](auto& watched) {
      return
          [steps, kept = std::make_shared<std::remove_reference_t<decltype(watched)>>(std::move(watched))] {
            return kept->left(steps);
          };
    };
    record_.invariants = Later<InvariantsLeft>(later(invariants_));
    record_.constraints = Later<ConstraintsLeft>(later(constraints_));
  }

 private:
  // Makes z_ the state that the run has come to.
  void stand_at(const Integration<T>& run) { z_.assign(run.state().begin(), run.state().end()); }
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

  [[nodiscard]] bool keeps(std::int64_t step) const { return step % run_.every == 0 || step == run_.steps; }
  // The time without rounding, which costs as much as a short step and which errors alone are measured at.
  [[nodiscard]] Quad exact(const Integration<T>& run, std::int64_t step) const {
    if (!sampler_.measures_errors()) return Quad(0);
    return Quad(value_of(run.time_of(0))) + Quad(static_cast<double>(step)) * Quad(value_of(run.step()));
  }
  // Whether the residual of the structure is due at the next sample, after `step` steps.
  [[nodiscard]] bool structure_next(std::int64_t step) const {
    return (row_ + 1) % structure_rows_ == 0 || step == run_.steps;
  }
  // The same, and counts the sample.
  [[nodiscard]] bool structure_at(std::int64_t step) {
    const bool due = structure_next(step);
    ++row_;
    return due;
  }
  void passed(std::int64_t step) const {
    if (progress_ && keeps(step)) progress_(static_cast<double>(step) / static_cast<double>(run_.steps));
  }
  // Ends a run at which something measured is not finite; true where there is such a thing.
  bool ended_by(const std::string& not_finite, const T& t, std::int64_t step) {
    if (not_finite.empty()) return false;
    record_.status = Status::non_finite;
    record_.message = not_finite + " " + place_of(Quad(t), step);
    return ended_ = true;
  }

  // Takes z_. Every state counts for drift, setbacks and residuals of constraints; `keep` also makes a
  // sample. Says what is not finite or was singular on the way here, as a phrase, or nothing.
  [[nodiscard]] std::string observe(const T& t, const Quad& exact, bool keep, bool structure) {
    if (const std::string singular = rank_.observe(t, z_); !singular.empty()) {
      singular_ = true;
      return singular + "; this was seen";
    }
    if (std::string phrase = invariants_.take(t, z_); !phrase.empty()) return phrase;
    if (std::string phrase = constraints_.take(t, z_); !phrase.empty()) return phrase;
    return keep ? sample(t, exact, structure) : std::string();
  }
  // Makes a sample of z_, which was taken.
  [[nodiscard]] std::string sample(const T& t, const Quad& exact, bool structure) {
    for (std::size_t k = 0; k < z_.size(); ++k) in_double_[k] = static_cast<double>(z_[k]);
    invariants_.sample(static_cast<double>(t), in_double_);
    constraints_.sample(static_cast<double>(t), std::abs(static_cast<double>(Quad(t) - run_.t0.quad())),
                        in_double_);
    return sampler_.sample(t, exact, z_, invariants_.values(), constraints_.residuals(), structure);
  }

  // What a formula throws at several states is thrown anew at one of them.
  [[nodiscard]] bool seen_together(const Block<T>& block) {
    if (run_.model->restricted() || rank_.watches()) return false;
    try {
      return invariants_.evaluate(block);
    } catch (const BudgetSpent&) {
      throw;
    } catch (...) {
      return false;
    }
  }
  [[nodiscard]] std::size_t together(const Integration<T>& run, const Block<T>& block) {
    for (std::size_t row = 0; row < block.rows; ++row) {
      const std::int64_t step = block.step(row);
      if (!keeps(step)) {
        row += rows_to_next(block, step) - 1;
        continue;
      }
      if (const ChosenRows rows = plain_rows(block, row); rows.count > 0) {
        record_.completed = step;
        invariants_.sample(block, rows);
        sampler_.sample({block, invariants_.rows(), rows});
        row_ += static_cast<std::int64_t>(rows.count);
        row = rows.last();
        passed(block.step(row));
        continue;
      }
      record_.completed = step;  // also where what follows throws
      block.states.get(row, z_);
      invariants_.at_row(row);
      const T t = block.time(row);
      if (ended_by(sample(t, exact(run, step), structure_at(step)), t, step)) {
        invariants_.take(block, row + 1);
        record_.completed = step - block.stride;  // the steps behind which all was finite
        return row;
      }
      passed(step);
    }
    invariants_.take(block, block.rows);
    record_.completed = block.step(block.rows - 1);
    return block.rows;
  }
  // How many rows lie between a step of which no sample is kept and the next one of which there is one.
  [[nodiscard]] std::size_t rows_to_next(const Block<T>& block, std::int64_t step) const {
    const std::int64_t next = std::min(step - step % run_.every + run_.every, run_.steps);
    return static_cast<std::size_t>((next - step + block.stride - 1) / block.stride);
  }
  // The samples, from a row on at which there is one, that are passed on together: those of which nothing is
  // looked at but the invariants, which were evaluated. The last one of a run may be nearer than the others
  // are to each other.
  [[nodiscard]] ChosenRows plain_rows(const Block<T>& block, std::size_t row) const {
    if (!sampler_.takes_rows() || block.step(row) % run_.every != 0) return {};
    ChosenRows rows{row, 1, static_cast<std::size_t>(run_.every / block.stride)};
    rows.count += (block.rows - 1 - row) / rows.apart;
    if (!sampler_.measures_structure()) return rows;
    if (block.step(rows.last()) == run_.steps) --rows.count;  // with a residual of the structure
    rows.count = std::min(rows.count, static_cast<std::size_t>(structure_rows_ - 1 - row_ % structure_rows_));
    return rows;
  }
  [[nodiscard]] std::size_t one_by_one(const Integration<T>& run, const Block<T>& block) {
    for (std::size_t row = 0; row < block.rows; ++row) {
      block.states.get(row, z_);
      if (one(run, block.step(row), block.time(row))) return row;
    }
    return block.rows;
  }
  // Takes z_; true where that ends the run.
  bool one(const Integration<T>& run, std::int64_t step, const T& t) {
    const bool keep = keeps(step), structure = keep && structure_at(step);
    const std::int64_t before = std::exchange(record_.completed, step);
    if (ended_by(observe(t, keep ? exact(run, step) : Quad(0), keep, structure), t, step))
      record_.completed = before;  // the steps behind which all was finite
    passed(step);
    return ended_;
  }

  const ResolvedRun& run_;
  RunRecord& record_;
  const Progress& progress_;
  std::int64_t structure_rows_, row_ = 0;
  WatchedInvariants<T> invariants_;
  WatchedConstraints<T> constraints_;
  RankWatch<T> rank_;
  StepperPointer<T> apart_;  // for steps that are not the run's own
  Sampler<T> sampler_;
  bool singular_ = false, ended_ = false;
  std::vector<T> z_;
  std::vector<double> in_double_;  // the same state
};

}  // namespace pfaff
