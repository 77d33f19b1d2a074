// Watchers that note what they are shown.
#pragma once

#include <cstdint>
#include <vector>

#include <pfaff/runs/integration.hpp>

namespace pfaff::testing {

using Coordinates = std::vector<double>;

inline Coordinates state_of(const Integration<double>& run) {
  return {run.state().begin(), run.state().end()};
}

// Notes the steps, times and states that it is shown, and ends a run after a step.
class Notes final : public Watcher<double> {
 public:
  explicit Notes(std::int64_t last = -1) : last_(last) {}
  void start(const Integration<double>& run) override { note(run.steps_taken(), run.time(), state_of(run)); }
  std::size_t end(const Integration<double>& /*run*/, const Block<double>& block) override {
    return last_ < 0 ? block.rows : block.row_of(last_);
  }
  void look(const Integration<double>& /*run*/, const Block<double>& block) override {
    Coordinates z(block.states.components());
    for (std::size_t row = 0; row < block.rows; ++row) {
      block.states.get(row, z);
      note(block.step(row), block.time(row), z);
    }
  }
  std::vector<std::int64_t> steps;
  std::vector<double> times;
  std::vector<Coordinates> states;

 private:
  void note(std::int64_t step, double t, const Coordinates& z) {
    steps.push_back(step), times.push_back(t), states.push_back(z);
  }
  std::int64_t last_;
};

}  // namespace pfaff::testing
