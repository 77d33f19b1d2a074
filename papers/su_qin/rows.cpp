#include <pfaff/papers/su_qin/rows.hpp>

#include <algorithm>

#include <pfaff/integrators/generating/generating_gradient.hpp>

namespace pfaff::su_qin {

Numbers value(const Tape& tape, const Quad& t, const Numbers& x) {
  Numbers out(tape.outputs.size());
  Replay<Quad> replay(shared(tape));
  replay(t, x.data(), out.data());
  return out;
}
Numbers joined(const Numbers& a, const Numbers& b) {
  Numbers all(a);
  all.insert(all.end(), b.begin(), b.end());
  return all;
}
Numbers part(const Numbers& x, std::size_t first, std::size_t count) {
  const auto begin = x.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

std::shared_ptr<const Model> damped(const std::string& system) {
  return systems().get(system, "system").make({{"nu", "3/10"}});
}
StepJacobian<Quad> step_of(const std::string& method, const Assignments& parameters,
                           const std::shared_ptr<const Model>& model, const Numbers& z) {
  const auto instance = integrators().get(method, "integrator").make(parameters);
  return StepDifferentiator<Quad>(*instance, model)(t0, tau, z);
}
Matrix<Quad> structure(const Model& model, const Quad& t, const Numbers& z) {
  return {z.size(), value(*model.tape(Formula::structure), t, z)};
}

Numbers engine_term(const Model& model, int k, const Numbers& w) {
  GeneratingGradient<Quad> gradient(model.tape(Formula::chart_field), std::max(k, 1), false,
                                    GeneratingForm::midpoint, gauss_coefficients((std::max(k, 1) + 1) / 2));
  gradient.set_step(t0, Quad(1));
  const std::size_t n = w.size(), half = n / 2;
  Numbers terms(gradient.term_count() * n), result(n);
  gradient.terms(w.data(), terms.data());
  for (std::size_t i = 0; i < half; ++i) {  // -K_c (psi_q, psi_p)
    result[i] = terms[static_cast<std::size_t>(k) * n + half + i];
    result[half + i] = -terms[static_cast<std::size_t>(k) * n + i];
  }
  return result;
}

}  // namespace pfaff::su_qin

namespace pfaff {

std::vector<PartOfPaper> su_qin_parts() {
  return {{"2", su_qin::birkhoffian_systems},  {"2", su_qin::inverse_problem},
          {"3", su_qin::generating_functions}, {"4", su_qin::evolution_rows},
          {"4", su_qin::expansion_rows},       {"5", su_qin::oscillator_form},
          {"5", su_qin::oscillator_schemes}};
}

}  // namespace pfaff
