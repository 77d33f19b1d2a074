// How the rows of Su & Qin are made, section by section, and what the sections share.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <pfaff/bench/measure/structure.hpp>
#include <pfaff/bench/reproduce/reproduce.hpp>
#include <pfaff/core/linear/matrix.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff::su_qin {

using Numbers = std::vector<Quad>;
using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;

/// Quad: 1e-34 a rounding, a few hundred of them on numbers about 1.
inline constexpr double at_round_off = 1e-30;
/// What a misprint must differ by to be called one.
inline constexpr double clearly = 1e-6;

/// Six digits of each number.
std::string shown(const Numbers& x);
/// The largest difference of two entries; infinite where one is not a number.
double distance(const Numbers& a, const Numbers& b);

/// Collects the rows of one section.
class Rows {
 public:
  explicit Rows(std::string section) : section_(std::move(section)) {}

  /// Printed and ours agree to round-off.
  void reproduced(const std::string& equation, const std::string& what, const Numbers& printed,
                  const Numbers& ours);
  /// A number agrees to a tolerance of its own.
  void measured(const std::string& equation, const std::string& what, double printed, double ours,
                double tolerance);
  /// A misprint: the printed value must differ from ours clearly, and the corrected one must not.
  void erratum(const std::string& equation, const std::string& what, const Numbers& printed,
               const Numbers& corrected, const Numbers& ours, const std::string& entry);
  /// A claim that is wrong as printed, with what was measured, how far off it is and whether the corrected
  /// one was seen to hold.
  void claim(const std::string& equation, const std::string& what, const std::string& printed,
             const std::string& ours, double difference, bool corrected_holds, const std::string& entry);
  /// Something that no printed number says: a misprint of notation, whose corrected form is tested, or a
  /// property.
  void qualitative(const std::string& equation, const std::string& what, const std::string& printed,
                   const std::string& ours, double difference, double tolerance, bool holds,
                   const std::string& tested);

  [[nodiscard]] std::vector<ReproducedRow> take() { return std::move(rows_); }

 private:
  void add(ReproducedRow row);
  std::string section_;
  std::vector<ReproducedRow> rows_;
};

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

std::vector<ReproducedRow> birkhoffian_systems();   // section 2
std::vector<ReproducedRow> inverse_problem();       // section 2, (14)-(18)
std::vector<ReproducedRow> generating_functions();  // section 3
std::vector<ReproducedRow> evolution_rows();        // section 4, (56)-(76)
std::vector<ReproducedRow> expansion_rows();        // section 4, (77)-(91)
std::vector<ReproducedRow> oscillator_form();       // section 5, (93)-(99)
std::vector<ReproducedRow> oscillator_schemes();    // section 5, (100)-(107)

}  // namespace pfaff::su_qin
