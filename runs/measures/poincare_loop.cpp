// Poincare's integral invariant: that of the one-form F(z, t) around a loop of states stays while the motion
// carries the loop along, and so it does for a method exactly where its steps keep the structure K = dF.
// Unlike the residual of a step it adds up over the run, and it needs no Jacobian.
#include <algorithm>
#include <cmath>

#include <pfaff/runs/measure.hpp>
#include <pfaff/runs/scales_at_start.hpp>
#include <pfaff/runs/support/linear_step.hpp>
#include <pfaff/runs/support/loops.hpp>

namespace {
using namespace pfaff;

struct PoincareLoop {
  int points = 64, count = 50, most = 1000;

  static std::vector<Parameter> parameters() {
    return {parameter(&PoincareLoop::points, "points", "", 8, 1024, "of the loop, an even number"),
            parameter(&PoincareLoop::count, "looks", "", 1, 1000, "at the loop"),
            parameter(&PoincareLoop::most, "steps", "", 1, 1000000, "that the loop is carried along")};
  }
  [[nodiscard]] std::vector<Column> columns(const Model& /*model*/) const {
    return {{"integral"}, {.name = "uncertainty", .digits = 3}};
  }
  [[nodiscard]] std::string refuses(const Model& model, const MethodInstance& /*method*/) const {
    if (points % 2 != 0) return "needs an even number of points";
    const bool canonical = model.source().canonical && model.facets().has(Facet::hamiltonian);
    if (model.dimension() <= 64 && !model.restricted() &&
        (canonical || model.facets().has(Facet::birkhoffian)))
      return "";
    return "needs a canonical energy or a one-form, at most 64 coordinates and no constraints; " +
           model.name() + " does not have them";
  }
  template <class T>
  [[nodiscard]] std::vector<std::int64_t> looks(const Measured<T>& run) const {
    return evenly(std::min<std::int64_t>(run.steps, most), count);
  }
  template <class T>
  struct Work {
    std::vector<Integration<T>> loop;
    OneForm<T> one_form;
    T first{1};
    // Its plane is none of the coordinates'.
    Work(const PoincareLoop& measure, const Measured<T>& run) : one_form(run.start.model()) {
      const std::span<const T> z = run.start.state();
      const std::vector<double> scales = scales_at_start(run);
      const T size = size_at_start(run, scales) / sqrt(T(static_cast<double>(z.size())));
      std::vector<T> a, b;
      for (std::size_t i = 0; i < z.size(); ++i) {
        const T extent = T(1e-3) * std::max(T(abs(z[i])), T(T(scales[i]) * size / T(2)));
        const auto turn = static_cast<double>(i);
        a.push_back(extent * T(std::cos(1 + 2 * turn))), b.push_back(extent * T(std::sin(2 + 3 * turn)));
      }
      for (std::vector<T>& point : ellipse(z, a, b, measure.points))
        loop.push_back(run.start.beside(std::move(point)));
    }
  };

  template <class T>
  bool look(const Measured<T>& /*run*/, const RunState<T>& at, Work<T>& work, Row& row) const {
    std::vector<std::vector<T>> states, forms;
    for (Integration<T>& point : work.loop) {
      carry_to(at.step, point);
      states.emplace_back(point.state().begin(), point.state().end());
      forms.push_back(work.one_form.at(at.t, point.state()));
    }
    const T integral = loop_integral(states, forms, 1), coarse = loop_integral(states, forms, 2);
    if (at.step == 0) work.first = integral;
    row = {integral / work.first, abs((integral - coarse) / work.first)};
    return isfinite(T(integral / work.first));
  }

  // RK4 changes areas by the determinant of its step. Errors add up over the run: of a loop of 64 points and
  // of size 1/1000 in double the integral is known to 1e-16 * 1000 * 64, a few times over.
  static std::vector<MeasureControl> controls() {
    const double by_rk4 = std::pow(std::norm(factor_of_rk4({0, 0.1})), 200), known = 3e-11;
    const auto of = [](const char* system, const char* method) {
      return MeasureControl::of(system, method, "0.1", 200);
    };
    return {of("harmonic-oscillator", "verlet").gives("integral", 1, known),
            of("harmonic-oscillator", "rk4").gives("integral", by_rk4, known),
            of("harmonic-oscillator", "rk4").does_not_give("integral", 1, known),
            of("damped-pendulum", "generating-function").gives("integral", 1, known),
            of("damped-pendulum", "implicit-midpoint").does_not_give("integral", 1, known)};
  }
};

const Measure<PoincareLoop> registered{
    {.name = "poincare-loop",
     .title = "Poincare's integral around a loop of states that a method carries along",
     .reference = "hairer-lubich-wanner2006 VI.2",
     .description =
         "The integral of the one-form, p dq of canonical systems, around a closed loop of states, over "
         "that at the start. It stays where every step keeps the structure. Its uncertainty is what it "
         "changes by where every other point is left out; a loop that winds up is known no longer.",
     .version = 2,
     .watches = {Claim::symplectic, Claim::k_symplectic},
     .usual = true}};
}  // namespace
