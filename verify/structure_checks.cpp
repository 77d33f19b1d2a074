// The claims of systems K zdot + D = 0: their equations are self-adjoint, and their charts are Darboux's.
#include <pfaff/verify/residuals.hpp>

namespace pfaff {

std::shared_ptr<const Tape> darboux_residual(const Tape& chart, const Tape& structure) {
  const int n = chart.inputs;
  const auto size = static_cast<std::size_t>(n), half = size / 2;
  return expression(n, n * n, [&](const Recorded& t, Arguments z, Results out) {
    const auto y = jacobian(chart, t, z);
    const auto k = evaluate(structure, t, z);
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j) {
        out[i * size + j] = -k[i * size + j];
        for (std::size_t a = 0; a < half; ++a)
          out[i * size + j] = out[i * size + j] + y[(half + a) * size + i] * y[a * size + j] -
                              y[a * size + i] * y[(half + a) * size + j];
      }
  });
}

namespace {

// K + K^T, d_i K_jk + d_j K_ki + d_k K_ij and d_t K_ij - d_j D_i + d_i D_j (su-qin (8)).
struct SelfAdjointnessResiduals {
  std::shared_ptr<const Tape> skew, closed, rate;
};
SelfAdjointnessResiduals self_adjointness_residuals(const Tape& structure, const Tape& covector) {
  const int n = structure.inputs;
  const auto size = static_cast<std::size_t>(n);
  const auto closed = expression(n, n * n * n, [&](const Recorded& t, Arguments z, Results out) {
    const auto slope = jacobian(structure, t, z);  // [(i n + j) n + l]
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j)
        for (std::size_t k = 0; k < size; ++k)
          out[(i * size + j) * size + k] = slope[(j * size + k) * size + i] +
                                           slope[(k * size + i) * size + j] +
                                           slope[(i * size + j) * size + k];
  });
  const auto rate = expression(n, n * n, [&](const Recorded& t, Arguments z, Results out) {
    const auto timed = time_derivative(structure, t, z), d = jacobian(covector, t, z);
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j)
        out[i * size + j] = timed[i * size + j] - d[i * size + j] + d[j * size + i];
  });
  return {symmetric_part(structure, n), closed, rate};
}

// The tape with one output changed by a millionth of change(t, z).
template <class F>
std::shared_ptr<const Tape> changed(const Tape& tape, std::size_t output, F&& change) {
  return expression(tape.inputs, static_cast<int>(tape.outputs.size()),
                    [&](const Recorded& t, Arguments z, Results out) {
                      const auto values = evaluate(tape, t, z);
                      std::copy(values.begin(), values.end(), out.begin());
                      out[output] = out[output] + Recorded(Real::fraction(1, 1000000)) * change(t, z);
                    });
}
}  // namespace

std::vector<Check> check_self_adjointness(const std::string& plugin, const Model& model) {
  const Region region = region_of(model, generic_state(model));
  const auto residuals =
      self_adjointness_residuals(*model.tape(Formula::structure), *model.tape(Formula::covector));
  std::vector<Check> checks;
  both(checks, plugin, "self-adjoint: K skew", plugin, residuals.skew, region);
  both(checks, plugin, "self-adjoint: K closed", plugin, residuals.closed, region);
  both(checks, plugin, "self-adjoint: rate of K", plugin, residuals.rate, region);
  return checks;
}

std::vector<Check> check_false_structures() {
  const auto model = systems().get("magnetic-induction", "system").make({});
  const auto structure = model->tape(Formula::structure), covector = model->tape(Formula::covector);
  const std::vector<Real> centre = generic_state(*model);
  std::vector<Check> checks;
  const auto control = [&](const char* what, const char* claim, const std::shared_ptr<const Tape>& residual) {
    Check check = named(what, claim, model->name(), "quad", largest<Quad>(residual, centre),
                        residual_tolerance<Quad>());
    check.scope = "control";
    check.control = true;
    check.result = check.result == CheckResult::fail ? CheckResult::rejected : CheckResult::pass;
    checks.push_back(check);
  };
  const auto one = [](const Recorded&, Arguments) { return Recorded(1); };
  const auto speed = [](const Recorded&, Arguments z) { return z[2]; };
  control("K_12 changed by 1e-6, K_21 not", "self-adjoint: K skew",
          self_adjointness_residuals(*changed(*structure, 1, one), *covector).skew);
  const auto twice =
      changed(*changed(*structure, 1, speed), 4, [](const Recorded&, Arguments z) { return -z[2]; });
  control("K_12 and K_21 changed by 1e-6 z3", "self-adjoint: K closed",
          self_adjointness_residuals(*twice, *covector).closed);
  const auto not_faraday = changed(*covector, 0, [](const Recorded&, Arguments z) { return z[1]; });
  control("D_1 changed by 1e-6 z2: not Faraday's law", "self-adjoint: rate of K",
          self_adjointness_residuals(*structure, *not_faraday).rate);
  const auto chart = model->tape(Formula::chart);
  const auto late =
      expression(model->dimension(), model->dimension(), [&](const Recorded& t, Arguments z, Results out) {
        const auto y = evaluate(*chart, t + Recorded(Real::fraction(1, 1000000)), z);
        std::copy(y.begin(), y.end(), out.begin());
      });
  control("derived chart, late by 1e-6", "chart is Darboux", darboux_residual(*late, *structure));
  return checks;
}

}  // namespace pfaff
