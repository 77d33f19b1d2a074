// How a method contracts the plane.
//
// A system of one q and one p with friction, q' = T_p, p' = -V_q - nu p, states by its damping nu how it
// contracts areas: dq ^ dp shrinks as e^{-nu t}, whatever the potential is. What a method makes of an area
// around the initial state is the determinant of the tangent map of its steps, whose columns are the
// derivatives of the state with respect to the first q and p. For the eye the outline of a disc is moved
// point by point beside it.
#include <algorithm>
#include <cmath>
#include <complex>

#include <pfaff/core/numbers/formatted.hpp>
#include <pfaff/runs/measure.hpp>
#include <pfaff/runs/scales_at_start.hpp>
#include <pfaff/runs/support/linear_step.hpp>

namespace {
using namespace pfaff;

struct Contraction {
  int corners = 96, count = 120;

  static std::vector<Parameter> parameters() {
    return {parameter(&Contraction::corners, "corners", "", 3, 1024, "of the outline of the disc"),
            parameter(&Contraction::count, "looks", "", 1, 1000, "at the disc")};
  }
  [[nodiscard]] std::vector<Column> columns(const Model& /*model*/) const {
    return {{"area"}, {"law"}, {.name = "outline", .kind = Column::Kind::text}};
  }
  [[nodiscard]] std::string refuses(const Model& model, const MethodInstance& /*method*/) const {
    const bool contracts =
        model.dimension() == 2 && model.facets().has(Facet::conformal) && model.damping() > Real(0);
    return contracts ? ""
                     : "needs one q and one p with a damping > 0, which " + model.name() + " does not state";
  }
  // Until the law has come to e^{-folds}, to e^{folds} on the way back in time, or the run ends.
  template <class T>
  [[nodiscard]] std::vector<std::int64_t> looks(const Measured<T>& run) const {
    const double steps = std::floor(folds / run.start.model()->damping().value() /
                                    std::abs(static_cast<double>(run.start.step())));
    return evenly(static_cast<std::int64_t>(std::clamp(steps, 1.0, static_cast<double>(run.steps))), count);
  }

  template <class T>
  struct Work {
    std::vector<Integration<T>> outline;
    std::vector<std::int64_t> shown;  // the looks at which the table has the outline
    Integration<StepDual<T>> tangent;

    Work(const Contraction& measure, const Measured<T>& run) : tangent(run.start.differentiated()) {
      const T q = run.start.state()[0], p = run.start.state()[1];
      const std::vector<double> scales = scales_at_start(run);
      const T size = scaled_norm<T>(run.start.state(), scales);
      const T r = T(radius) * (size > T(0) ? size : T(1));
      for (int k = 0; k < measure.corners; ++k) {
        const T angle = T(2) * T(pi) * T(k) / T(measure.corners);
        outline.push_back(
            run.start.beside({q + T(scales[0]) * r * cos(angle), p + T(scales[1]) * r * sin(angle)}));
      }
      const std::vector<std::int64_t> looks = measure.looks(run);
      for (std::size_t j = 0; j < outlines; ++j)
        shown.push_back(looks[j * (looks.size() - 1) / (outlines - 1)]);
    }
  };

  template <class T>
  bool look(const Measured<T>& run, const RunState<T>& at, Work<T>& work, Row& row) const {
    std::string text;
    carry_to(at.step, work.tangent);
    if (std::find(work.shown.begin(), work.shown.end(), at.step) != work.shown.end())
      for (Integration<T>& point : work.outline) {
        carry_to(at.step, point);
        text += (text.empty() ? "" : ";") + in_six_digits(point.state());
      }
    const auto& q = work.tangent.state()[0].derivative;
    const auto& p = work.tangent.state()[1].derivative;
    const T area = q[0] * p[1] - q[1] * p[0];
    const T elapsed = T(static_cast<double>(at.step)) * run.start.step();
    row = {area, exp(-T(run.start.model()->damping()) * elapsed), text};
    return isfinite(area);
  }

  // Areas of r'' + nu r' + r = 0 shrink by e^{-nu t} in a scheme that keeps the structure, and by the
  // determinant of its step in RK4, R(h lambda) R(h conj lambda) with the polynomial R of degree 4.
  static std::vector<MeasureControl> controls() {
    constexpr double nu = 0.3, h = 0.1;
    constexpr int steps = 50;
    const std::complex<double> x = h * std::complex<double>(-nu / 2, std::sqrt(1 - nu * nu / 4));
    const double step_of_rk4 = std::norm(factor_of_rk4(x));
    const auto damped = [&](const char* method, double expected, bool fault) {
      return MeasureControl{.system = "damped-oscillator",
                            .system_parameters = {{"nu", "0.3"}},
                            .method = method,
                            .step = "0.1",
                            .steps = steps,
                            .column = "area",
                            .expected = expected,
                            .allowed = 1e-12,  // round-off of fifty linear steps
                            .fault = fault};
    };
    const double law = std::exp(-nu * h * steps);
    return {damped("generating-function", law, false), damped("rk4", std::pow(step_of_rk4, steps), false),
            damped("rk4", law, true)};
  }

 private:
  static constexpr std::size_t outlines = 6;
  static constexpr double radius = 0.25;  // over the size of the initial state, in the scales of q and p
  static constexpr double folds = 3;
  static inline const Real pi = 3.141592653589793238462643383279502884_r;

  template <class T>
  static std::string in_six_digits(std::span<const T> z) {
    return formatted("%.6g %.6g", static_cast<double>(z[0]), static_cast<double>(z[1]));
  }
};

const Measure<Contraction> registered{
    {.name = "contraction",
     .title = "How a method contracts areas of the plane, beside the law of the motion",
     .reference = "mclachlan-perlmutter2001",
     .description =
         "The area that the method makes of a small one around the initial state, over that at first, beside "
         "e^{-nu t}, which is the law of every system of one q and one p with the damping nu: the "
         "determinant of the tangent map of its steps. The outline is that of a disc whose points are "
         "carried "
         "along.",
     .version = 2,
     .watches = {Claim::conformal},
     .usual = true}};
}  // namespace
