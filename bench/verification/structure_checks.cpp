// The claims of equations K zdot + D = 0: that they are self-adjoint, and that charts are Darboux's.
#include <pfaff/bench/verification/residuals.hpp>
#include <pfaff/brackets/birkhoffian/self_adjointness.hpp>

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
struct Worst {
  double skew = 0, closed = 0, time = 0;
};

// The largest residuals relative to their terms, at random states near `centre`.
template <class T>
Worst largest_residuals(const std::shared_ptr<const Tape>& structure, const Tape& covector,
                        const std::vector<Real>& centre) {
  std::mt19937_64 random(20041);
  std::uniform_real_distribution<double> offset(-0.05, 0.05);
  std::vector<T> z(centre.size());
  Worst worst;
  const auto note = [](double& largest, const Residual<T>& r) {
    const auto value = static_cast<double>(r.scale == T(0) ? r.residual : T(r.residual / r.scale));
    largest = std::isnan(value) || std::isnan(largest) ? NAN : std::max(largest, value);
  };
  for (int k = 0; k < 5; ++k) {
    for (std::size_t i = 0; i < z.size(); ++i) z[i] = T(centre[i]) + T(offset(random));
    const auto r = self_adjointness<T>(structure, covector, T(1 + offset(random)), z);
    note(worst.skew, r.skew);
    note(worst.closed, r.closed);
    note(worst.time, r.time);
  }
  return worst;
}

// A tape with change(t, z) times a millionth added to one output.
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
  const auto structure = model.tape(Formula::structure), covector = model.tape(Formula::covector);
  const std::vector<Real> centre = generic_state(model);
  std::vector<Check> checks;
  const auto add = [&](const Worst& worst, const char* precision, double tolerance) {
    checks.push_back(named(plugin, "self-adjoint: K skew", plugin, precision, worst.skew, tolerance));
    checks.push_back(named(plugin, "self-adjoint: K closed", plugin, precision, worst.closed, tolerance));
    checks.push_back(named(plugin, "self-adjoint: rate of K", plugin, precision, worst.time, tolerance));
  };
  // Relative to the terms: what derivatives of a handful of operations lose.
  add(largest_residuals<double>(structure, *covector, centre), "double", 1e-13);
  add(largest_residuals<Quad>(structure, *covector, centre), "quad", 1e-31);
  return checks;
}

std::vector<Check> check_false_structures() {
  const auto model = systems().get("magnetic-induction", "system").make({});
  const auto structure = model->tape(Formula::structure), covector = model->tape(Formula::covector);
  const std::vector<Real> centre = generic_state(*model);
  std::vector<Check> checks;
  const auto control = [&](const char* what, const char* claim, double measured) {
    Check check = named(what, claim, model->name(), "quad", measured, 1e-31);
    check.scope = "control";
    check.control = true;
    check.result = measured <= check.tolerance ? CheckResult::pass : CheckResult::rejected;
    checks.push_back(check);
  };
  const auto one = [](const Recorded&, Arguments) { return Recorded(1); };
  const auto speed = [](const Recorded&, Arguments z) { return z[2]; };
  control("K_12 changed by 1e-6, K_21 not", "self-adjoint: K skew",
          largest_residuals<Quad>(changed(*structure, 1, one), *covector, centre).skew);
  const auto twice =
      changed(*changed(*structure, 1, speed), 4, [](const Recorded&, Arguments z) { return -z[2]; });
  control("K_12 and K_21 changed by 1e-6 z3", "self-adjoint: K closed",
          largest_residuals<Quad>(twice, *covector, centre).closed);
  control("D_1 changed by 1e-6 z2: not Faraday's law", "self-adjoint: rate of K",
          largest_residuals<Quad>(
              structure, *changed(*covector, 0, [](const Recorded&, Arguments z) { return z[1]; }), centre)
              .time);
  const auto chart = model->tape(Formula::chart);
  const auto late =
      expression(model->dimension(), model->dimension(), [&](const Recorded& t, Arguments z, Results out) {
        const auto y = evaluate(*chart, t + Recorded(Real::fraction(1, 1000000)), z);
        std::copy(y.begin(), y.end(), out.begin());
      });
  control("derived chart, late by 1e-6", "chart is Darboux",
          static_cast<double>(largest<Quad>(darboux_residual(*late, *structure), centre)));
  return checks;
}

}  // namespace pfaff
