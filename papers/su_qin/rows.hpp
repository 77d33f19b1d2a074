// How the rows of Su & Qin are made, section by section, and what the sections share.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <pfaff/core/linear/matrix.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/papers/rows.hpp>
#include <pfaff/runs/support/structure.hpp>

namespace pfaff::su_qin {

using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;

/// A tape evaluated once.
Numbers value(const Tape& tape, const Quad& t, const Numbers& x);
inline std::shared_ptr<const Tape> shared(Tape tape) { return std::make_shared<const Tape>(std::move(tape)); }
Numbers joined(const Numbers& a, const Numbers& b);
Numbers part(const Numbers& x, std::size_t first, std::size_t count);

/// Everything is evaluated at nu = 3/10, t0 = 7/10, tau = 1/5.
std::shared_ptr<const Model> damped(const std::string& system);
inline const Quad nu = Quad(3) / Quad(10), t0 = Quad(7) / Quad(10), tau = Quad(1) / Quad(5), t1 = t0 + tau;

/// One step of a registered method from z at t0, with its Jacobian.
StepJacobian<Quad> step_of(const std::string& method, const Assignments& parameters,
                           const std::shared_ptr<const Model>& model, const Numbers& z);
/// K(z, t).
Matrix<Quad> structure(const Model& model, const Quad& t, const Numbers& z);
/// phi_w^(k)(w, t0) of the chart's alpha, from the engine that the schemes use.
Numbers engine_term(const Model& model, int k, const Numbers& w);
/// The Jacobian of the exact solution from t0, whose elapsed time is of any scalar, for a linear flow.
template <class T>
Matrix<T> linear_flow(const Model& model, const T& elapsed) {
  const auto n = static_cast<std::size_t>(model.dimension());
  Replay<T> flow(model.tape(Formula::exact_solution));
  Matrix<T> m(n, n);
  for (std::size_t j = 0; j < n; ++j) {
    std::vector<T> initial(n + 1), after(n);
    initial[j] = T(1);
    initial[n] = T(t0);
    flow(elapsed, initial.data(), after.data());
    for (std::size_t i = 0; i < n; ++i) m(i, j) = after[i];
  }
  return m;
}

void birkhoffian_systems(Rows& rows);   // section 2
void inverse_problem(Rows& rows);       // section 2, (14)-(18)
void generating_functions(Rows& rows);  // section 3
void evolution_rows(Rows& rows);        // section 4, (56)-(76)
void expansion_rows(Rows& rows);        // section 4, (77)-(91)
void oscillator_form(Rows& rows);       // section 5, (93)-(99)
void oscillator_schemes(Rows& rows);    // section 5, (100)-(107)

}  // namespace pfaff::su_qin
