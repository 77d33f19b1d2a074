// <one line: what it measures>, how neighbours of a motion separate under a method.
//
// Copy to runs/measures/<name>.cpp. What a measure looks at, and what its table has, is all there is to
// write; the table is made for every run that it fits, drawn in reports, and what controls() states is tested
// by `pfaff verify NAME`. end() adds rows at the end, in the place of looks() and look() or beside them, and
// block() sees every state (runs/measure.hpp).
#include <cmath>

#include <pfaff/runs/measure.hpp>

namespace {
using namespace pfaff;

struct Separation {
  int count = 50;
  static std::vector<Parameter> parameters() {
    return {parameter(&Separation::count, "looks", "", 1, 1000, "at both runs")};
  }

  [[nodiscard]] std::vector<Column> columns(const Model& /*model*/) const { return {{"separation"}}; }
  // A predicate: the name of the measure is put before it.
  [[nodiscard]] std::string refuses(const Model& model, const MethodInstance& /*method*/) const {
    return model.restricted() ? "needs states without constraints; " + model.name() + " has some" : "";
  }
  // The numbers of steps after which it looks.
  template <class T>
  [[nodiscard]] std::vector<std::int64_t> looks(const Measured<T>& run) const {
    return evenly(run.steps, count);
  }

  // What it keeps: here a run of its own, from a state beside the start.
  template <class T>
  struct Work {
    Integration<T> neighbour;
    T first{0};
    Work(const Separation& /*measure*/, const Measured<T>& run) : neighbour(run.start.beside(beside(run))) {}
    static std::vector<T> beside(const Measured<T>& run) {
      std::vector<T> z(run.start.state().begin(), run.start.state().end());
      z[0] += T(0x1p-20);
      return z;
    }
  };

  // A row of the table, a cell for each column. A cell that is not finite is left empty; false ends the
  // table.
  template <class T>
  bool look(const Measured<T>& /*run*/, const RunState<T>& at, Work<T>& work, Row& row) const {
    carry_to(at.step, work.neighbour);
    T square(0);
    for (std::size_t i = 0; i < at.z.size(); ++i) {
      const T apart = work.neighbour.state()[i] - at.z[i];
      square += apart * apart;
    }
    const T distance = sqrt(square);
    if (at.step == 0) work.first = distance;
    row = {distance / work.first};
    return true;
  }

  // Two answers that are known, and a fault that it has to see. Neighbours of an oscillator stay as far apart
  // as they are, in the midpoint rule too; RK4 brings them together by the root of the determinant of its
  // step. Differences of 1e-6 of numbers of size 1 are known to 1e-10.
  static std::vector<MeasureControl> controls() {
    const double h = 0.2, even = 1 - h * h / 2 + std::pow(h, 4) / 24, odd = h - h * h * h / 6;
    const double by_rk4 = std::pow(even * even + odd * odd, 50);
    const auto oscillator = [](const char* method) {
      return MeasureControl::of("harmonic-oscillator", method, "0.2", 100);
    };
    return {oscillator("implicit-midpoint").gives("separation", 1, 1e-8),
            oscillator("rk4").gives("separation", by_rk4, 1e-8),
            oscillator("rk4").does_not_give("separation", 1, 1e-8)};
  }
};

const Measure<Separation> registered{
    {.name = "template-measure",
     .title = "How neighbours of a motion separate",
     .reference = "hairer-lubich-wanner2006 XII",
     .description =
         "The distance of a neighbour of the run, over that at the start, the template of a measure. "
         "Say what it is and when it says something. Say where it ends, too.",
     .version = 1}};
}  // namespace
