// There and back again: how far a method misses its start when it turns round.
//
// A method without memory takes steps of -h on the way back, or, where the system states a reversal (of
// momenta, say), steps of h from the reversed state, whose end is reversed once more. Symmetric and
// reversible methods come back but for rounding; what one rounding of the state at the turn becomes on the
// way back says how much rounding may be.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <pfaff/runs/history.hpp>
#include <pfaff/runs/measure.hpp>
#include <pfaff/runs/support/linear_step.hpp>
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
  // The numbers of steps after which it turns round: evenly spaced in their logarithm, and fewer of them
  // where states are large.
  template <class T>
  [[nodiscard]] std::vector<std::int64_t> looks(const Measured<T>& run) const {
    const std::int64_t of_large = 64 * std::int64_t{most} / run.start.model()->dimension();
    const std::int64_t limit = std::clamp<std::int64_t>(of_large, std::min(most, 100), most);
    const auto all = static_cast<double>(std::min(run.steps, limit));
    std::vector<std::int64_t> found;
    for (int k = 0; k <= intervals; ++k) {
      const std::int64_t turn = std::llround(std::pow(all, static_cast<double>(k) / intervals));
      if (found.empty() || found.back() < turn) found.push_back(turn);
    }
    return found;
  }

  template <class T>
  struct Work {
    std::vector<T> start;
    bool remembers = false;  // what is remembered belongs to the state that was reached, and to no other
    std::optional<WayBack<T>> back;  // nothing leads the method back

    Work(const Reversibility& /*measure*/, const Measured<T>& run)
        : start(run.start.state().begin(), run.start.state().end()) {
      const Model& model = *run.start.model();
      const MethodInstance& method = run.start.method();
      remembers = keeps_history(method, run.start.model(), Quad(run.start.time()), Quad(run.start.step()),
                                {start.begin(), start.end()});
      const bool stated = model.given(Formula::reversal) && model.autonomous();
      const std::vector<Claim> claims = claims_in_scope(method.preserves(model), model);
      const auto claimed = [&](Claim claim) {
        return std::find(claims.begin(), claims.end(), claim) != claims.end();
      };
      if (stated && (!remembers || claimed(Claim::reversible))) {
        back = WayBack<T>(run.start.model());
      } else if (!remembers || claimed(Claim::symmetric)) {
        back = WayBack<T>();
      }
    }
  };

  // Each turn has a run of its own, so that it is what a run of so many steps would be, with its history.
  template <class T>
  bool look(const Measured<T>& run, const RunState<T>& at, Work<T>& work, Row& row) const {
    if (!work.back)
      throw RunError("the method remembers earlier steps, and nothing is known to lead it back");
    Integration<T> there = run.start.beside(work.start);
    if (!there.steps(at.step).reached()) return false;
    std::optional<std::vector<T>> other;
    if (!work.remembers) {
      Integration<T> moved = there.beside(changed(there.state()));
      other = (*work.back)(moved, at.step);
      there.forget();
    }
    const auto end = (*work.back)(there, at.step);
    // Every longer way back ends with that step.
    if (!end && at.step == 1)
      throw RunError("the first step cannot be taken back: the step back does not converge");
    const T norm = apart(work.start, std::vector<T>(work.start.size(), T(0)));
    const T size = norm > T(0) ? norm : T(1), unit = std::numeric_limits<T>::epsilon() / T(2);
    const T not_known(std::numeric_limits<double>::quiet_NaN());
    row = {end ? apart(*end, work.start) / size : not_known,
           end && other ? apart(*other, *end) / size * (unit / change<T>()) : not_known,
           work.back->by_reversal() ? "reversal" : "negative steps"};
    return true;
  }

  // Verlet comes back but for the rounding of two hundred steps. Of the oscillator RK4 multiplies the
  // distance from the origin by the root of the determinant of its step, there and back, wherever it is.
  static std::vector<MeasureControl> controls() {
    const double of_rk4 = 1 - std::pow(std::norm(factor_of_rk4({0, 0.1})), 100);
    const auto of = [](const char* system, const char* method, double expected, bool fault) {
      return MeasureControl{.system = system,
                            .method = method,
                            .step = "0.1",
                            .steps = 100,
                            .column = "distance",
                            .expected = expected,
                            .allowed = 1e-12,
                            .fault = fault};
    };
    return {of("pendulum", "verlet", 0, false), of("harmonic-oscillator", "rk4", of_rk4, false),
            of("pendulum", "rk4", 0, true)};
  }

 private:
  // So small that it acts linearly, and far above round-off.
  template <class T>
  static T change() {
    return sqrt(std::numeric_limits<T>::epsilon());
  }
  // What a rounding of each coordinate may be: relative changes of either sign, without a pattern that
  // symmetric states have.
  template <class T>
  static std::vector<T> changed(std::span<const T> state) {
    std::vector<T> z(state.begin(), state.end());
    for (std::size_t i = 0; i < z.size(); ++i)
      z[i] *= std::cos(1 + 2 * static_cast<double>(i)) > 0 ? T(1) + change<T>() : T(1) - change<T>();
    return z;
  }
  template <class T>
  static T apart(const std::vector<T>& a, const std::vector<T>& b) {
    T square(0);
    for (std::size_t i = 0; i < a.size(); ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
    return sqrt(square);
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
