// How a method contracts the plane.
//
// A system of one q and one p with friction, q' = T_p, p' = -V_q - nu p, states by its damping nu how it
// contracts areas: dq ^ dp shrinks as e^{-nu t}, whatever the potential is. What a method makes of an area
// around the initial state is the determinant of the tangent map of its steps. For the eye the outline of a
// disc is moved point by point beside it.
#include <algorithm>
#include <cmath>

#include <pfaff/core/numbers/formatted.hpp>
#include <pfaff/runs/measure.hpp>
#include <pfaff/runs/scales_at_start.hpp>
#include <pfaff/runs/support/linear_step.hpp>
#include <pfaff/runs/support/loops.hpp>

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
    if (model.dimension() == 2 && model.facets().has(Facet::conformal) && model.damping() > Real(0))
      return "";
    return "needs one q and one p with a damping > 0, which " + model.name() + " does not state";
  }
  // Until the law has come to e^{-3}, to e^3 on the way back in time, or the run ends.
  template <class T>
  [[nodiscard]] std::vector<std::int64_t> looks(const Measured<T>& run) const {
    const double h = std::abs(static_cast<double>(run.start.step()));
    const double steps = std::floor(3 / run.start.model()->damping().value() / h);
    return evenly(static_cast<std::int64_t>(std::clamp(steps, 1.0, static_cast<double>(run.steps))), count);
  }
  template <class T>
  struct Work {
    std::vector<Integration<T>> outline;
    std::vector<std::int64_t> shown;  // the looks that have the outline
    Integration<StepDual<T>> tangent;
    Work(const Contraction& measure, const Measured<T>& run) : tangent(run.start.differentiated()) {
      const std::vector<double> scales = scales_at_start(run);
      const T r = size_at_start(run, scales) / T(4);
      for (auto& corner :
           ellipse<T>(run.start.state(), {T(scales[0]) * r, T(0)}, {T(0), T(scales[1]) * r}, measure.corners))
        outline.push_back(run.start.beside(std::move(corner)));
      const std::vector<std::int64_t> looks = measure.looks(run);
      for (std::size_t j = 0; j < 6; ++j) shown.push_back(looks[j * (looks.size() - 1) / 5]);
    }
  };

  template <class T>
  bool look(const Measured<T>& run, const RunState<T>& at, Work<T>& work, Row& row) const {
    std::string text;
    carry_to(at.step, work.tangent);
    if (std::find(work.shown.begin(), work.shown.end(), at.step) != work.shown.end())
      for (Integration<T>& point : work.outline) {
        carry_to(at.step, point);
        const double x = static_cast<double>(point.state()[0]), y = static_cast<double>(point.state()[1]);
        text += formatted("%s%.6g %.6g", text.empty() ? "" : ";", x, y);
      }
    const auto &q = work.tangent.state()[0].derivative, &p = work.tangent.state()[1].derivative;
    const T area = q[0] * p[1] - q[1] * p[0];
    const T elapsed = T(static_cast<double>(at.step)) * run.start.step();
    row = {area, exp(-T(run.start.model()->damping()) * elapsed), text};
    return isfinite(area);
  }

  // Areas of r'' + .3 r' + r = 0 shrink by e^{-.3 t} in a scheme that keeps the structure, and by the
  // determinant of its step in RK4, R(h lambda) R(h conj lambda) with the polynomial R of degree 4.
  static std::vector<MeasureControl> controls() {
    constexpr double nu = 0.3, h = 0.1, steps = 50;
    const double step_of_rk4 = std::norm(factor_of_rk4({-h * nu / 2, h * std::sqrt(1 - nu * nu / 4)}));
    const auto damped = [](const char* method) {
      return MeasureControl::of("damped-oscillator", method, "0.1", 50);
    };
    const double law = std::exp(-nu * h * steps), known = 1e-12;  // round-off of fifty linear steps
    return {damped("generating-function").gives("area", law, known),
            damped("rk4").gives("area", std::pow(step_of_rk4, steps), known),
            damped("rk4").does_not_give("area", law, known)};
  }
};

const Measure<Contraction> registered{
    {.name = "contraction",
     .title = "How a method contracts areas of the plane, beside the law of the motion",
     .reference = "mclachlan-perlmutter2001",
     .description =
         "The area that the method makes of a small one around the initial state, over that at first, beside "
         "e^{-nu t}, which is the law of every system of one q and one p with the damping nu: the "
         "determinant of the tangent map of its steps. The outline is that of a disc that is carried along.",
     .version = 2,
     .watches = {Claim::conformal},
     .usual = true}};
}  // namespace
