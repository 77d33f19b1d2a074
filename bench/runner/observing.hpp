// The watcher of a run with steps of one size, which shows its states to an Observer.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/bench/runner/observer.hpp>
#include <pfaff/core/errors/budget.hpp>
#include <pfaff/runs/integration.hpp>

namespace pfaff {

/// Ends a run at which something measured is not finite; true where there is such a thing.
template <class T>
bool ended_by(const std::string& not_finite, const T& t, std::int64_t step, RunRecord& record) {
  if (not_finite.empty()) return false;
  record.status = Status::non_finite;
  record.message = not_finite + " " + place_of(Quad(t), step);
  return true;
}

/// Shows the states of a run to its observer, and ends it where something measured is not finite.
template <class T>
class Observing final : public Watcher<T> {
 public:
  Observing(const ResolvedRun& run, Observer<T>& observer, RunRecord& record, const Progress& progress)
      : run_(run),
        observer_(observer),
        record_(record),
        progress_(progress),
        structure_rows_(std::max<std::int64_t>(1, (run.steps / run.every + 1) / 50)),
        z_(run.initial.size()) {}

  void start(const Integration<T>& run) override {
    z_.assign(run.state().begin(), run.state().end());
    ended_ = ended_by(observer_.observe(run.time(), exact(run, 0), z_, true, true), run.time(), 0, record_);
  }
  // Nobody else watches, so that what is seen here may be kept.
  std::size_t end(const Integration<T>& run, const Block<T>& block) override {
    return seen_together(block) ? together(run, block) : one_by_one(run, block);
  }
  void look(const Integration<T>& /*run*/, const Block<T>& /*block*/) override {}
  /// The state that is reached, where it is none of those that are shown.
  void last(const Integration<T>& run) {
    z_.assign(run.state().begin(), run.state().end());
    (void)one(run, run.steps_taken(), run.time());
  }
  [[nodiscard]] bool ended() const { return ended_; }

 private:
  [[nodiscard]] bool keeps(std::int64_t step) const { return step % run_.every == 0 || step == run_.steps; }
  // The time without rounding, which costs as much as a short step and which errors alone are measured at.
  [[nodiscard]] Quad exact(const Integration<T>& run, std::int64_t step) const {
    if (!observer_.measures_errors()) return Quad(0);
    return Quad(value_of(run.time_of(0))) + Quad(static_cast<double>(step)) * Quad(value_of(run.step()));
  }
  [[nodiscard]] bool structure_at(std::int64_t step) {
    ++row_;
    return row_ % structure_rows_ == 0 || step == run_.steps;
  }
  void passed(std::int64_t step) const {
    if (progress_ && keeps(step)) progress_(static_cast<double>(step) / static_cast<double>(run_.steps));
  }
  // What a formula throws at several states is thrown anew at one of them.
  [[nodiscard]] bool seen_together(const Block<T>& block) {
    try {
      return observer_.evaluate(block);
    } catch (const BudgetSpent&) {
      throw;
    } catch (...) {
      return false;
    }
  }
  [[nodiscard]] std::size_t together(const Integration<T>& run, const Block<T>& block) {
    for (std::size_t row = 0; row < block.rows; ++row) {
      const std::int64_t step = block.step(row);
      if (!keeps(step)) continue;
      record_.completed = step;  // also where what follows throws
      const std::string not_finite = observer_.sample(block, row, exact(run, step), structure_at(step));
      if (ended_by(not_finite, block.time(row), step, record_)) {
        ended_ = true;
        observer_.take(block, row + 1);
        record_.completed = step - block.stride;  // the steps behind which all was finite
        return row;
      }
      passed(step);
    }
    observer_.take(block, block.rows);
    record_.completed = block.step(block.rows - 1);
    return block.rows;
  }
  [[nodiscard]] std::size_t one_by_one(const Integration<T>& run, const Block<T>& block) {
    for (std::size_t row = 0; row < block.rows; ++row) {
      block.states.get(row, z_);
      if (one(run, block.step(row), block.time(row))) return row;
    }
    return block.rows;
  }
  // Observes z_; true where that ends the run.
  bool one(const Integration<T>& run, std::int64_t step, const T& t) {
    const bool keep = keeps(step), structure = keep && structure_at(step);
    const std::int64_t before = std::exchange(record_.completed, step);
    ended_ = ended_by(observer_.observe(t, keep ? exact(run, step) : Quad(0), z_, keep, structure), t, step,
                      record_);
    if (ended_) record_.completed = before;  // the steps behind which all was finite
    passed(step);
    return ended_;
  }

  const ResolvedRun& run_;
  Observer<T>& observer_;
  RunRecord& record_;
  const Progress& progress_;
  std::int64_t structure_rows_, row_ = 0;
  bool ended_ = false;
  std::vector<T> z_;
};

}  // namespace pfaff
