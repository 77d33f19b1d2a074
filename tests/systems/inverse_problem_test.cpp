// The inverse problem: F and B from K and D, against exact rational values, and by the identities dF = K and
// grad B + F_t = -D.
#include <gtest/gtest.h>

#include <fstream>
#include <pfaff/bench/runner/json.hpp>

#include <pfaff/brackets/birkhoffian/inverse_problem.hpp>
#include <pfaff/brackets/birkhoffian/self_adjointness.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>

#include "../golden_numbers.hpp"
#include "samples.hpp"

namespace {
using namespace pfaff;
using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;

Recorded fraction(int numerator, int denominator) { return Recorded(Real::fraction(numerator, denominator)); }

struct Equations {
  Tape structure, covector;
};

// The polynomial example of the reference file (its K and D, written out).
Equations polynomial() {
  return {record(4, 16,
                 [](const Recorded& t, Arguments z, Results k) {
                   k[1] = t * z[3] * z[3] / 5 + t / 2 + 1;
                   k[2] = t * t * z[1] / 9 - 2 * z[0] * z[2] / 7;
                   k[3] = 2 * z[0] * z[1] / 11;
                   k[6] = t * t * z[0] / 9;
                   k[7] = z[0] * z[0] / 11 - 2 * t * z[0] * z[3] / 5;
                   k[11] = Recorded(1);
                   for (std::size_t i = 0; i < 4; ++i)
                     for (std::size_t j = 0; j < i; ++j) k[i * 4 + j] = -k[j * 4 + i];
                 }),
          record(4, 4, [](const Recorded& t, Arguments z, Results d) {
            d[0] = z[1] / 4 - t * z[3] / 3 - z[0];
            d[1] = -(z[0] * z[3] * z[3] / 5) - z[0] / 4 - 2 * z[1] * z[2] / 5 - z[1];
            d[2] = -(2 * t * z[0] * z[1] / 9) - z[1] * z[1] / 5 - 2 * z[2];
            d[3] = -(t * z[0] / 3) - z[3];
          })};
}

// K and D of a given action form.
template <class OneForm, class Function>
Equations of_action(int n, OneForm&& one_form, Function&& function) {
  const auto size = static_cast<std::size_t>(n);
  const Tape form = record(n, n, one_form), b = record(n, 1, function);
  return {record(n, n * n,
                 [&](const Recorded& t, Arguments z, Results k) {
                   const auto slope = jacobian(form, t, z);
                   for (std::size_t i = 0; i < size; ++i)
                     for (std::size_t j = 0; j < size; ++j)
                       k[i * size + j] = slope[j * size + i] - slope[i * size + j];
                 }),
          record(n, n, [&](const Recorded& t, Arguments z, Results d) {
            const auto slope = gradient(b, t, z, std::vector<Recorded>{Recorded(1)});
            const auto timed = time_derivative(form, t, z);
            for (std::size_t i = 0; i < size; ++i) d[i] = -slope[i] - timed[i];
          })};
}

// Lotka and Volterra's structure 1/(z1 z2), singular at the origin, in a gauge that moves with time, and
// with a field strength that turns.
Equations transcendental() {
  return of_action(
      2,
      [](const Recorded& t, Arguments z, Results f) {
        f[0] = log(z[1]) / z[0] + exp(t / 2) * sin(z[1]) * z[0];
        f[1] = exp(t / 3) * z[0] * z[1];
      },
      [](const Recorded& t, Arguments z, Results b) {
        b[0] = z[0] - log(z[0]) + z[1] - 2 * log(z[1]) + sin(t) * z[0] * z[1];
      });
}

// The largest of |dF - K| and |grad B + F_t + D| near `state`.
template <class T>
double defect(const Equations& equations, const ActionForm& form, const std::vector<Real>& state) {
  const int n = equations.structure.inputs;
  const auto size = static_cast<std::size_t>(n);
  const auto difference =
      std::make_shared<const Tape>(record(n, n * n + n, [&](const Recorded& t, Arguments z, Results out) {
        const auto k = evaluate(equations.structure, t, z), d = evaluate(equations.covector, t, z);
        const auto slope = jacobian(form.one_form, t, z), timed = time_derivative(form.one_form, t, z);
        const auto b = gradient(form.birkhoffian, t, z, std::vector<Recorded>{Recorded(1)});
        for (std::size_t i = 0; i < size; ++i) {
          for (std::size_t j = 0; j < size; ++j)
            out[i * size + j] = slope[j * size + i] - slope[i * size + j] - k[i * size + j];
          out[size * size + i] = b[i] + timed[i] + d[i];
        }
      }));
  Replay<T> replay(difference);
  std::vector<T> z, out(difference->outputs.size());
  for (const Real& x : state) z.push_back(T(x));
  double worst = 0;
  for (const double t : {0.0, 0.25, 1.5}) {
    replay(T(t), z.data(), out.data());
    for (const T& x : out) worst = isfinite(x) ? std::max(worst, static_cast<double>(abs(x))) : INFINITY;
  }
  return worst;
}

Real rational(const std::string& text) {
  const auto slash = text.find('/');
  const Real numerator = *Real::parse(text.substr(0, slash));
  return slash == std::string::npos ? numerator : numerator / *Real::parse(text.substr(slash + 1));
}

template <class T>
void expect_golden(double tolerance) {
  const auto golden = pfaff::testing::golden("birkhoff_inverse_problem");
  const auto number = [](const nlohmann::json& j) { return T(rational(j.get<std::string>())); };
  const auto& point = golden.at("point");
  const std::vector<T> z{number(point.at("z1")), number(point.at("z2")), number(point.at("z3")),
                         number(point.at("z4"))};
  const T t = number(point.at("t"));
  const auto equations = polynomial();
  const auto form = inverse_problem(equations.structure, equations.covector, std::vector<Real>(4));
  std::vector<T> f(4), b(1);
  Replay<T>(std::make_shared<const Tape>(form.one_form))(t, z.data(), f.data());
  Replay<T>(std::make_shared<const Tape>(form.birkhoffian))(t, z.data(), b.data());
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_LE(abs(f[i] - number(golden.at("F_17_at_point").at(i))), T(tolerance)) << i;
  EXPECT_LE(abs(b[0] - number(golden.at("B_18_at_point"))), T(tolerance));
}

TEST(InverseProblem, AgreesWithExactValues) {
  expect_golden<double>(1e-14);
  expect_golden<Quad>(1e-30);
}

TEST(InverseProblem, ReproducesStructureAndCovector) {
  // Sums of 24 terms of order one to ten, differentiated once.
  const std::vector<Real> state{Real::fraction(1, 2), Real::fraction(-1, 3), Real::fraction(3, 4),
                                Real::fraction(2, 5)};
  for (const std::vector<Real>& centre :
       {std::vector<Real>(4), std::vector<Real>{1, 2, Real::fraction(-1, 3), 0}, state}) {
    const auto equations = polynomial();
    const auto form = inverse_problem(equations.structure, equations.covector, centre);
    EXPECT_LE(defect<double>(equations, form, state), 1e-13);
    EXPECT_LE(defect<Quad>(equations, form, state), 1e-31);
  }
  const auto equations = transcendental();
  const std::vector<Real> centre{1, 1}, near{Real::fraction(5, 4), Real::fraction(4, 5)};
  const auto form = inverse_problem(equations.structure, equations.covector, centre);
  EXPECT_LE(defect<double>(equations, form, near), 1e-13);
  EXPECT_LE(defect<Quad>(equations, form, near), 1e-30);
  // Controls: too few nodes, and the origin, where this K is singular, as the centre.
  EXPECT_GT(
      defect<Quad>(equations, inverse_problem(equations.structure, equations.covector, centre, 4), near),
      1e-12);
  EXPECT_GT(
      defect<Quad>(equations, inverse_problem(equations.structure, equations.covector, std::vector<Real>(2)),
                   near),
      1e-12);
}

// Controls: the formulas as printed, the weight 1/2 of (17) and the sign of (18), and equations that are not
// self-adjoint.
TEST(InverseProblem, PrintedFormulasAndUnfitEquationsFail) {
  const auto equations = polynomial();
  const std::vector<Real> centre(4), state{1, Real::fraction(1, 2), Real::fraction(3, 4), 1};
  const auto form = inverse_problem(equations.structure, equations.covector, centre);
  ASSERT_LE(defect<Quad>(equations, form, state), 1e-31);
  ActionForm printed = form;
  printed.one_form = record(4, 4, [&](const Recorded& t, Arguments z, Results out) {
    const auto k = evaluate(equations.structure, t, z);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) out[i] = out[i] + z[j] * k[j * 4 + i] / 2;
  });
  EXPECT_GT(defect<Quad>(equations, printed, state), 1e-3);
  printed = form;
  printed.birkhoffian = record(4, 1, [&](const Recorded& t, Arguments z, Results out) {
    out[0] = -evaluate(form.birkhoffian, t, z)[0];
  });
  EXPECT_GT(defect<Quad>(equations, printed, state), 1e-3);
  Equations unfit = equations;
  unfit.covector = record(4, 4, [&](const Recorded& t, Arguments z, Results out) {
    const auto d = evaluate(equations.covector, t, z);
    std::copy(d.begin(), d.end(), out.begin());
    out[0] = out[0] + fraction(1, 1000000) * z[1];
  });
  EXPECT_GT(defect<Quad>(unfit, inverse_problem(unfit.structure, unfit.covector, centre), state), 1e-8);
}

template <class T>
SelfAdjointness<T> measured(const Equations& equations, const std::vector<Real>& state) {
  std::vector<T> z;
  for (const Real& x : state) z.push_back(T(x));
  return self_adjointness<T>(std::make_shared<const Tape>(equations.structure), equations.covector, T(0.75),
                             z);
}
template <class T>
double relative_residual(const Residual<T>& r) {
  return static_cast<double>(r.residual / r.scale);
}

// Equations with one entry of K, or of D, changed by `change(t, z, entry)`.
template <class Change>
Tape changed(const Tape& tape, std::size_t entry, Change&& change) {
  return record(tape.inputs, static_cast<int>(tape.outputs.size()),
                [&](const Recorded& t, Arguments z, Results out) {
                  const auto values = evaluate(tape, t, z);
                  std::copy(values.begin(), values.end(), out.begin());
                  out[entry] = out[entry] + fraction(1, 1000000) * change(t, z);
                });
}

TEST(SelfAdjointness, HoldsForActionFormsAndSeesEachDefectAlone) {
  const std::vector<Real> state{1, Real::fraction(1, 2), Real::fraction(3, 4), Real::fraction(4, 5)};
  const std::vector<Real> near{Real::fraction(5, 4), Real::fraction(4, 5)};
  for (const auto& [equations, where] : {std::pair(polynomial(), state), std::pair(transcendental(), near)}) {
    const auto in_double = measured<double>(equations, where);
    const auto in_quad = measured<Quad>(equations, where);
    for (const auto& r : {in_double.skew, in_double.closed, in_double.time})
      EXPECT_LE(relative_residual(r), 1e-14);
    EXPECT_LE(relative_residual(in_quad.skew), 1e-32);
    EXPECT_LE(relative_residual(in_quad.time), 1e-32);
    EXPECT_GT(in_quad.time.scale, Quad(0.1));
  }
  EXPECT_LE(relative_residual(measured<Quad>(polynomial(), state).closed), 1e-32);
  // Controls, each by a millionth: one entry of K alone; a pair of entries by z3, which is not closed; D by a
  // covector that is not a gradient.
  Equations wrong = polynomial();
  wrong.structure = changed(wrong.structure, 1, [](const Recorded&, Arguments) { return Recorded(1); });
  auto r = measured<Quad>(wrong, state);
  EXPECT_GT(relative_residual(r.skew), 1e-8);
  EXPECT_LE(relative_residual(r.time), 1e-32);
  wrong = polynomial();
  wrong.structure = changed(wrong.structure, 1, [](const Recorded&, Arguments z) { return z[2]; });
  wrong.structure = changed(wrong.structure, 4, [](const Recorded&, Arguments z) { return -z[2]; });
  r = measured<Quad>(wrong, state);
  EXPECT_LE(relative_residual(r.skew), 1e-32);
  EXPECT_GT(relative_residual(r.closed), 1e-8);
  wrong = polynomial();
  wrong.covector = changed(wrong.covector, 0, [](const Recorded&, Arguments z) { return z[1]; });
  r = measured<Quad>(wrong, state);
  EXPECT_LE(relative_residual(r.closed), 1e-32);
  EXPECT_GT(relative_residual(r.time), 1e-8);
}

}  // namespace
