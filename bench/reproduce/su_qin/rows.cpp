#include <pfaff/bench/reproduce/su_qin/rows.hpp>

#include <algorithm>
#include <cmath>

#include <pfaff/integrators/generating_gradient.hpp>

namespace pfaff::su_qin {

std::string shown(const Numbers& x) {
  std::string text;
  for (const Quad& v : x) {
    if (!text.empty()) text += ' ';
    text += to_string(v, 6);
  }
  return text;
}
double distance(const Numbers& a, const Numbers& b) {
  if (a.size() != b.size()) return INFINITY;
  double worst = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const auto difference = static_cast<double>(abs(a[k] - b[k]));
    if (!std::isfinite(difference)) return INFINITY;
    worst = std::max(worst, difference);
  }
  return worst;
}

void Rows::add(ReproducedRow row) {
  row.section = section_;
  row.id = row.equation + " " + row.id;
  rows_.push_back(std::move(row));
}
void Rows::reproduced(const std::string& equation, const std::string& what, const Numbers& printed,
                      const Numbers& ours) {
  ReproducedRow r{what,         "", equation, shown(printed), shown(ours), distance(printed, ours),
                  at_round_off, "", ""};
  r.status = r.difference <= r.tolerance ? "reproduced" : "failed";
  add(r);
}
void Rows::measured(const std::string& equation, const std::string& what, double printed, double ours,
                    double tolerance) {
  ReproducedRow r{what,
                  "",
                  equation,
                  to_string(Quad(printed), 4),
                  to_string(Quad(ours), 4),
                  std::abs(printed - ours),
                  tolerance,
                  "",
                  ""};
  r.status = r.difference <= r.tolerance ? "reproduced" : "failed";
  add(r);
}
void Rows::erratum(const std::string& equation, const std::string& what, const Numbers& printed,
                   const Numbers& corrected, const Numbers& ours, const std::string& entry) {
  ReproducedRow r{what,         "", equation, shown(printed), shown(ours), distance(printed, ours),
                  at_round_off, "", entry};
  const bool shown_to_be =
      r.difference > clearly && std::isfinite(r.difference) && distance(corrected, ours) <= at_round_off;
  r.status = shown_to_be ? "erratum" : "failed";
  add(r);
}
void Rows::claim(const std::string& equation, const std::string& what, const std::string& printed,
                 const std::string& ours, double difference, bool corrected_holds, const std::string& entry) {
  ReproducedRow r{what, "", equation, printed, ours, difference, at_round_off, "", entry};
  r.status = difference > clearly && std::isfinite(difference) && corrected_holds ? "erratum" : "failed";
  add(r);
}
void Rows::qualitative(const std::string& equation, const std::string& what, const std::string& printed,
                       const std::string& ours, double difference, double tolerance, bool holds,
                       const std::string& tested) {
  ReproducedRow r{what, "", equation, printed, ours, difference, tolerance, "", tested};
  r.status = holds ? "qualitative" : "failed";
  add(r);
}

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

std::vector<ReproducedRow> reproduce_su_qin() {
  std::vector<ReproducedRow> all;
  for (const auto section : {su_qin::birkhoffian_systems, su_qin::inverse_problem,
                             su_qin::generating_functions, su_qin::evolution_rows, su_qin::expansion_rows,
                             su_qin::oscillator_form, su_qin::oscillator_schemes}) {
    const auto rows = section();
    all.insert(all.end(), rows.begin(), rows.end());
  }
  return all;
}

}  // namespace pfaff
