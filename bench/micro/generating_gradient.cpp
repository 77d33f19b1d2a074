// Measures one gradient psi(w) of the generating function truncated at degree m, variant S, interpreted from
// the tape and compiled. The time is that of one evaluation, in nanoseconds (the counter calls it a step).
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/integrators/generating/gradient_evaluator.hpp>

#include "cases.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::micro;

template <class S, class Gradient>
void add_gradient(int order, const std::string& path, const std::shared_ptr<const Model>& model,
                  std::shared_ptr<Gradient> gradient) {
  gradient->set_step(0.1, 0.1);
  add<S>("psi-" + std::to_string(order), path, [gradient, model](auto& w, double /*h*/) {
    auto psi = w;
    for (std::int64_t k = 0; k < chunk; ++k) {
      (*gradient)(w.data(), psi.data());
      // The next point depends on this gradient, as the next correction of a step does, so that evaluations
      // cannot overlap.
      for (std::size_t i = 0; i < w.size(); ++i) w[i] += 1e-9 * psi[i];
    }
  });
}

template <class S>
void add_gradients() {
  const auto model = systems().get(Case<S>::name, "system").make({});
  const Problem<double> problem(model);
  for (const int order : {4, 8, 12, 16}) {
    const GaussCoefficients gauss = gauss_coefficients(order / 2);
    add_gradient<S>(order, "interpreted", model,
                    std::make_shared<GeneratingGradient<double>>(model->tape(Formula::chart_field), order,
                                                                 true, GeneratingForm::midpoint, gauss));
    add_gradient<S>(order, "compiled", model,
                    std::make_shared<GradientEvaluator<double>>(problem, order, true, 0,
                                                                GeneratingForm::midpoint, gauss));
  }
}

[[maybe_unused]] const bool added =
    (add_gradients<HenonHeiles>(), add_gradients<DampedPendulum>(), add_gradients<LotkaVolterra>(), true);
}  // namespace
