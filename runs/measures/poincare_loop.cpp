// Poincare's integral invariant: a closed loop of states, carried along by a method.
//
// The integral of the one-form F(z, t) around a loop, p dq for canonical systems, is the same at all times
// while the motion carries the loop along, and so it is for a method exactly where its steps keep the
// structure K = dF. Unlike the residual of a step it adds up over the run, and it needs no Jacobian: the
// tangent of the loop is found by spectral differentiation along it, so that a loop that is still resolved is
// measured to round-off.
#include <algorithm>
#include <cmath>
#include <optional>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/runs/measure.hpp>
#include <pfaff/runs/scales_at_start.hpp>
#include <pfaff/runs/support/linear_step.hpp>

namespace {
using namespace pfaff;

struct PoincareLoop {
  int points = 64, count = 50, most = 1000;

  static std::vector<Parameter> parameters() {
    return {parameter(&PoincareLoop::points, "points", "", 8, 1024, "of the loop, of which half are odd"),
            parameter(&PoincareLoop::count, "looks", "", 1, 1000, "at the loop"),
            parameter(&PoincareLoop::most, "steps", "", 1, 1000000, "that the loop is carried along")};
  }
  [[nodiscard]] std::vector<Column> columns(const Model& /*model*/) const {
    return {{"integral"}, {.name = "uncertainty", .digits = 3}};
  }
  [[nodiscard]] std::string refuses(const Model& model, const MethodInstance& /*method*/) const {
    const bool has = model.dimension() <= 64 && !model.restricted() &&
                     ((model.source().canonical && model.facets().has(Facet::hamiltonian)) ||
                      model.facets().has(Facet::birkhoffian));
    return has ? ""
               : "needs a canonical energy or a one-form, at most 64 coordinates and no constraints; " +
                     model.name() + " does not have them";
  }
  template <class T>
  [[nodiscard]] std::vector<std::int64_t> looks(const Measured<T>& run) const {
    return evenly(std::min<std::int64_t>(run.steps, most), count);
  }

  template <class T>
  struct Work {
    std::vector<Integration<T>> loop;
    std::optional<Evaluator<T>> one_form;  // of canonical systems it is (p, 0)
    T first{1};

    // A circle about the initial state in a plane that is none of the coordinates'.
    Work(const PoincareLoop& measure, const Measured<T>& run) {
      const std::span<const T> z = run.start.state();
      const auto n = static_cast<double>(z.size());
      if (!run.start.model()->source().canonical)
        one_form = make_evaluator<T>(run.start.model(), Formula::one_form);
      const std::vector<double> scales = scales_at_start(run);
      const T norm = scaled_norm<T>(z, scales);
      const T size = norm > T(0) ? norm / sqrt(T(n)) : T(1);
      for (int j = 0; j < measure.points; ++j) {
        const T angle = T(2) * T(pi) * T(j) / T(measure.points);
        std::vector<T> point;
        for (std::size_t i = 0; i < z.size(); ++i) {
          const T scale = T(extent) * std::max(T(abs(z[i])), T(T(scales[i]) * size / T(2)));
          const auto turn = static_cast<double>(i);
          point.push_back(z[i] + scale * (T(std::cos(1 + 2 * turn)) * cos(angle) +
                                          T(std::sin(2 + 3 * turn)) * sin(angle)));
        }
        loop.push_back(run.start.beside(std::move(point)));
      }
    }
  };

  template <class T>
  bool look(const Measured<T>& /*run*/, const RunState<T>& at, Work<T>& work, Row& row) const {
    std::vector<std::vector<T>> states, forms;
    for (Integration<T>& point : work.loop) {
      carry_to(at.step, point);
      states.emplace_back(point.state().begin(), point.state().end());
      forms.push_back(form(work, at.t, states.back()));
    }
    const T integral = around(states, forms, 1), coarse = around(states, forms, 2);
    if (at.step == 0) work.first = integral;
    if (!isfinite(T(integral / work.first))) return false;
    row = {integral / work.first, abs((integral - coarse) / work.first)};
    return true;
  }

  // Errors add up over the run: of a loop of 64 points and of size 1/1000 in double the integral is known to
  // 1e-16 * 1000 * 64, a few times over. A step of RK4 of the oscillator changes areas by its determinant.
  static std::vector<MeasureControl> controls() {
    const double by_rk4 = std::pow(std::norm(factor_of_rk4({0, 0.1})), 200);
    const auto oscillator = [](const char* method, double expected, bool fault) {
      return MeasureControl{.system = "harmonic-oscillator",
                            .method = method,
                            .step = "0.1",
                            .steps = 200,
                            .column = "integral",
                            .expected = expected,
                            .allowed = 3e-11,
                            .fault = fault};
    };
    return {oscillator("verlet", 1, false),
            oscillator("rk4", by_rk4, false),
            oscillator("rk4", 1, true),
            {.system = "damped-pendulum",
             .method = "generating-function",
             .step = "0.1",
             .steps = 200,
             .column = "integral",
             .expected = 1,
             .allowed = 3e-11},
            {.system = "damped-pendulum",
             .method = "implicit-midpoint",
             .step = "0.1",
             .steps = 200,
             .column = "integral",
             .expected = 1,
             .allowed = 3e-11,
             .fault = true}};
  }

 private:
  static constexpr double extent = 1e-3;  // of the loop, over the sizes of the coordinates
  static inline const Real pi = 3.141592653589793238462643383279502884_r;

  static double tangent(double angle) { return std::tan(angle); }
  static Quad tangent(const Quad& angle) { return sin(angle) / cos(angle); }

  template <class T>
  static std::vector<T> form(const Work<T>& work, const T& t, const std::vector<T>& z) {
    std::vector<T> form(z.size(), T(0));
    if (work.one_form) {
      work.one_form->call(work.one_form->context, t, z.data(), form.data());
    } else {
      std::copy(z.begin() + static_cast<std::ptrdiff_t>(z.size() / 2), z.end(), form.begin());
    }
    return form;
  }
  // The integral around a loop of every `stride`-th of the points: the mean of F . dz/ds over s, with the
  // derivative of the trigonometric polynomial through these points.
  template <class T>
  static T around(const std::vector<std::vector<T>>& points, const std::vector<std::vector<T>>& forms,
                  std::size_t stride) {
    const std::size_t count = points.size() / stride;
    // What is constant along the loop gives nothing but rounding errors.
    std::vector<T> mean(forms.front().size(), T(0));
    for (const std::vector<T>& form : forms)
      for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += form[i] / T(static_cast<double>(forms.size()));
    T total(0);
    for (std::size_t j = 0; j < count; ++j)
      for (std::size_t k = 0; k < count; ++k) {
        if (j == k) continue;
        const T angle =
            T(pi) * (T(static_cast<double>(j)) - T(static_cast<double>(k))) / T(static_cast<double>(count));
        const T weight = T((j + k) % 2 == 0 ? 0.5 : -0.5) / tangent(angle);
        T along(0);
        for (std::size_t i = 0; i < mean.size(); ++i)
          along += (forms[j * stride][i] - mean[i]) * (points[k * stride][i] - points.front()[i]);
        total += weight * along;
      }
    return T(2) * T(pi) * total / T(static_cast<double>(count));
  }
};

const Measure<PoincareLoop> registered{
    {.name = "poincare-loop",
     .title = "Poincare's integral around a loop of states that a method carries along",
     .reference = "hairer-lubich-wanner2006 VI.2",
     .description =
         "The integral of the one-form, p dq of canonical systems, around a closed loop of states, "
         "over that at the start. It stays where every step keeps the structure. Its uncertainty is "
         "what it changes by where every other point is left out; a loop that winds up is known no "
         "longer.",
     .version = 2,
     .watches = {Claim::symplectic, Claim::k_symplectic},
     .usual = true}};
}  // namespace
