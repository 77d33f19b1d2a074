// How the invariants of a system drift along a run: every state counts.
#include <algorithm>
#include <cmath>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/runs/measure.hpp>
#include <pfaff/runs/support/linear_step.hpp>
#include <pfaff/runs/watched/invariants.hpp>
#include <pfaff/runs/watched/watched_columns.hpp>

namespace {
using namespace pfaff;

struct DriftOfInvariants {
  [[nodiscard]] std::vector<Column> columns(const Model& model) const {
    std::vector<Column> columns = watched_columns(false, model.time_unit());
    columns.push_back({.name = "setback"});
    return columns;
  }
  [[nodiscard]] std::string refuses(const Model& model, const MethodInstance& /*method*/) const {
    return model.invariants().empty() ? "needs a system with invariants; " + model.name() + " states none"
                                      : "";
  }
  template <class T>
  struct Work {
    WatchedInvariants<T> invariants;
    WatchedStates<T> states;
    Work(const DriftOfInvariants& /*measure*/, const Measured<T>& run)
        : invariants(run.start.model(), run.start.step() < T(0), most_samples + 1), states(run) {}
  };
  template <class T>
  void block(const Measured<T>& /*run*/, const Block<T>& block, Work<T>& work) const {
    WatchedInvariants<T>& invariants = work.invariants;
    const bool together = block.first > 0 && invariants.evaluate(block);
    for (std::size_t row = 0; row < block.rows; ++row) {
      const bool samples = work.states.samples(block.step(row));
      if (together && !samples) continue;
      work.states.look(block, row);
      if (together) {
        invariants.at_row(row);
      } else {
        work.states.require(invariants.take(block.time(row), work.states.state()));
      }
      if (samples) invariants.sample(static_cast<double>(block.time(row)), work.states.in_double());
    }
    if (together) invariants.take(block, block.rows);
  }
  template <class T>
  std::vector<Row> end(const Measured<T>& run, Work<T>& work) const {
    const InvariantsLeft left = work.invariants.left(run.now.steps_taken());
    std::vector<Row> rows;
    for (std::size_t i = 0; i < left.drift.size(); ++i) {
      const Invariant& invariant = run.start.model()->invariants()[i];
      const bool conserved = invariant.behaviour == Behaviour::conserved;
      Row row = watched_row({.drift = left.drift[i], .round_off = left.round_off[i]}, invariant.name,
                            invariant.unit, conserved);
      const bool directed = setback_words(invariant.behaviour).has_value();
      row.push_back(directed ? left.setback[i] : std::nan(""));
      rows.push_back(std::move(row));
    }
    return rows;
  }

  // Of the oscillator a step of RK4 multiplies the energy, which is 1/2 at first, by the determinant of the
  // step. A step of Verlet of the size sqrt(2) is a quarter of a turn that keeps q^2 + p^2 (1 - h^2/4): from
  // (1, 0) the energy rises to twice what it was.
  static std::vector<MeasureControl> controls() {
    const double of_rk4 = (1 - std::pow(std::norm(factor_of_rk4({0, 0.1})), 1000)) / 2;
    const auto of = [](const char* method, const char* step) {
      return MeasureControl::of("harmonic-oscillator", method, step, 1000);
    };
    const double known = 1e-13;  // after a thousand steps, each with some roundings
    return {of("rk4", "0.1").gives("max", of_rk4, known), of("rk4", "0.1").does_not_give("max", 0, known),
            of("verlet", "1.4142135623730951").gives("max", 0.5, known)};
  }
};

const Measure<DriftOfInvariants> registered{{.name = "drift",
                                             .title = "How the invariants of a system drift",
                                             .description =
                                                 "A row for each invariant: of those that are conserved the "
                                                 "largest difference from the first value, its "
                                                 "trend with an interval and its class, from all steps; of "
                                                 "those that may only rise or fall the largest "
                                                 "move against that direction.",
                                             .over = Over::step,
                                             .watches = {Claim::energy}}};
}  // namespace
