// There and back again: how far a method misses its start when it turns round (way_back.hpp). Symmetric and
// reversible methods come back but for rounding; what one rounding of the state at the turn becomes on the
// way back says how much rounding may be.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <pfaff/runs/history.hpp>
#include <pfaff/runs/measure.hpp>
#include <pfaff/runs/support/linear_step.hpp>
#include <pfaff/runs/support/moved_state.hpp>
#include <pfaff/runs/way_back.hpp>

namespace {
using namespace pfaff;

struct Reversibility {
  int most = 1000, intervals = 12;

  static std::vector<Parameter> parameters() {
    return {parameter(&Reversibility::most, "steps", "", 1, 1000000, "after which it turns round at last"),
            parameter(&Reversibility::intervals, "intervals", "", 1, 100, "between the turns")};
  }
  [[nodiscard]] std::vector<Column> columns(const Model& /*model*/) const {
    return {{.name = "distance", .digits = 9},
            {.name = "rounding", .digits = 9},
            {.name = "by", .kind = Column::Kind::text}};
  }
  // The steps after which it turns round; not so many of them where states are large.
  template <class T>
  [[nodiscard]] std::vector<std::int64_t> looks(const Measured<T>& run) const {
    const std::int64_t of_large = 64 * std::int64_t{most} / run.start.model()->dimension();
    const std::int64_t limit = std::clamp<std::int64_t>(of_large, std::min(most, 100), most);
    return evenly_in_logarithm(std::min(run.steps, limit), intervals);
  }
  template <class T>
  struct Work {
    std::vector<T> start;
    bool remembers = false;  // what is remembered belongs to the state that was reached, and to no other
    std::optional<WayBack<T>> back;
    T size;
    Work(const Reversibility& /*measure*/, const Measured<T>& run)
        : start(run.start.state().begin(), run.start.state().end()),
          remembers(keeps_history(run.start.method(), run.start.model(), Quad(run.start.time()),
                                  Quad(run.start.step()), {start.begin(), start.end()})),
          back(way_back(run.start, remembers)),
          size(euclidean_distance<T>(start, std::vector<T>(start.size(), T(0)))) {
      if (!(size > T(0))) size = T(1);
    }
  };
  // Each turn has a run of its own, so that it is what a run of so many steps would be, with its history.
  template <class T>
  bool look(const Measured<T>& run, const RunState<T>& at, Work<T>& work, Row& row) const {
    if (!work.back)
      throw RunError("the method remembers earlier steps, and nothing is known to lead it back");
    Integration<T> there = run.start.beside(work.start);
    if (!there.steps(at.step).reached()) return false;
    // It acts linearly, and is far above round-off.
    const T unit = std::numeric_limits<T>::epsilon() / T(2), change = sqrt(T(2) * unit);
    std::optional<std::vector<T>> other;
    if (!work.remembers) {
      Integration<T> moved = there.beside(moved_by<T>(change, there.state()));
      other = (*work.back)(moved, at.step);
      there.forget();
    }
    const auto end = (*work.back)(there, at.step);
    // Every longer way back ends with that step.
    if (!end && at.step == 1)
      throw RunError("the first step cannot be taken back: the step back does not converge");
    const T not_known(std::numeric_limits<double>::quiet_NaN());
    row = {end ? euclidean_distance<T>(*end, work.start) / work.size : not_known,
           end && other ? euclidean_distance<T>(*other, *end) / work.size * (unit / change) : not_known,
           work.back->by_reversal() ? "reversal" : "negative steps"};
    return true;
  }
  // Verlet comes back but for the rounding of two hundred steps. Of the oscillator RK4 multiplies the
  // distance from the origin by the root of the determinant of its step, there and back, wherever it is.
  static std::vector<MeasureControl> controls() {
    const double of_rk4 = 1 - std::pow(std::norm(factor_of_rk4({0, 0.1})), 100), known = 1e-12;
    const auto of = [](const char* system, const char* method) {
      return MeasureControl::of(system, method, "0.1", 100);
    };
    return {of("pendulum", "verlet").gives("distance", 0, known),
            of("harmonic-oscillator", "rk4").gives("distance", of_rk4, known),
            of("pendulum", "rk4").does_not_give("distance", 0, known)};
  }
};

const Measure<Reversibility> registered{
    {.name = "reversibility",
     .title = "How far a method misses its start when it turns round",
     .reference = "hairer-lubich-wanner2006 V.1",
     .description =
         "The distance from the start after as many steps back as there were, over the size of the "
         "start, beside what one rounding of the state at the turn becomes on the way back. It is "
         "empty where a step on the way back fails.",
     .watches = {Claim::reversible, Claim::symmetric},
     .usual = true}};
}  // namespace
