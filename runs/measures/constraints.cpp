// How far a run is from the constraints of its system: every state counts.
#include <cmath>

#include <pfaff/runs/measure.hpp>
#include <pfaff/runs/watched/constraints.hpp>
#include <pfaff/runs/watched/watched_columns.hpp>

namespace {
using namespace pfaff;

struct ConstraintsOfRun {
  [[nodiscard]] std::vector<Column> columns(const Model& model) const {
    return watched_columns(true, model.time_unit());
  }
  [[nodiscard]] std::string refuses(const Model& model, const MethodInstance& /*method*/) const {
    return model.restricted() ? "" : "needs a system with constraints; " + model.name() + " has none";
  }
  template <class T>
  struct Work {
    WatchedConstraints<T> constraints;
    WatchedStates<T> states;
    Work(const ConstraintsOfRun& /*measure*/, const Measured<T>& run)
        : constraints(*run.start.model()), states(run) {}
  };
  template <class T>
  void block(const Measured<T>& run, const Block<T>& block, Work<T>& work) const {
    for (std::size_t row = 0; row < block.rows; ++row) {
      const T t = block.time(row);
      work.states.look(block, row);
      work.states.require(work.constraints.take(t, work.states.state()));
      if (!work.states.samples(block.step(row))) continue;
      const double elapsed = std::abs(static_cast<double>(t - run.start.time()));
      work.constraints.sample(static_cast<double>(t), elapsed, work.states.in_double());
    }
  }
  template <class T>
  std::vector<Row> end(const Measured<T>& run, Work<T>& work) const {
    const ConstraintsLeft left = work.constraints.left(run.now.steps_taken());
    std::vector<Row> rows;
    for (std::size_t i = 0; i < left.drift.size(); ++i)
      rows.push_back(watched_row({.drift = left.drift[i], .growth = left.growth[i], .residual = true},
                                 work.constraints.names()[i], "1", true));
    return rows;
  }

  // RATTLE ends its steps on both levels of constraints; RK4 does not, though its motion stays on them.
  static std::vector<MeasureControl> controls() {
    const auto of = [](const char* system, const char* method) {
      return MeasureControl::of(system, method, "0.01", 200);
    };
    const double known = 1e-13;  // some roundings of momenta of a size of ten
    return {of("n-pendulum", "rattle").gives("max", 0, known),
            of("n-pendulum", "rk4").does_not_give("max", 0, known),
            of("sphere-particle", "rattle").gives("max", 0, known)};
  }
};

const Measure<ConstraintsOfRun> registered{
    {.name = "constraints",
     .title = "How far a run is from the constraints of its system",
     .description =
         "A row for each level of constraints, of positions and of what follows for velocities: the largest "
         "residual "
         "of the level, its trend with an interval, its class and how fast it grows, from all steps.",
     .over = Over::step,
     .watches = {Claim::constraints, Claim::velocity_constraints}}};
}  // namespace
