// The theorems of su-qin about maps and generating functions, checked on maps: steps of registered methods,
// exact flows, and maps defined by a random gradient.
#include <gtest/gtest.h>

#include <random>

#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/examples/templates/alpha.hpp>
#include <pfaff/integrators/generating/generating_gradient.hpp>
#include <pfaff/integrators/generating/lagrangian_transformation.hpp>
#include <pfaff/runs/support/structure.hpp>
#include <pfaff/tests/generating/generating_expansion.hpp>

#include "bent.hpp"
#include "generating_samples.hpp"

namespace pfaff {
namespace {

using testing::asymmetry;
using testing::at_round_off;
using testing::bent;
using testing::distance;
using testing::Numbers;
using testing::shared;
using testing::size_of;
using testing::start_time;
using testing::structure_at;

const Quad tau = Quad(1) / Quad(5), t1 = start_time + tau;

struct TheoremCase {
  std::shared_ptr<const Model> model;
  Numbers z;
};
std::vector<TheoremCase> theorem_cases() {
  const auto q = [](int x) { return Quad(x) / Quad(20); };
  return {{systems().get("damped-pendulum", "system").make({{"nu", "0.3"}}), {q(17), q(-9)}},
          {bent(), {q(8), q(5)}},
          {systems().get("henon-heiles", "system").make({}), {q(2), q(-3), q(5), q(4)}}};
}

// f = phi_w of the truncation, -K_c psi, and its Jacobian in w.
class Gradient {
 public:
  Gradient(const Model& model, int order)
      : gradient_(model.tape(Formula::chart_field), order, false, GeneratingForm::midpoint,
                  gauss_coefficients((order + 1) / 2)) {
    gradient_.set_step(StepDual<Quad>(start_time), StepDual<Quad>(tau));
  }
  Numbers operator()(const Numbers& w) {
    const std::size_t n = w.size(), half = n / 2;
    std::vector<StepDual<Quad>> dual(n), psi(n);
    for (std::size_t k = 0; k < n; ++k) dual[k] = StepDual<Quad>::variable(w[k], static_cast<int>(k));
    gradient_(dual.data(), psi.data());
    jacobian = Matrix<Quad>(n, n);
    Numbers value(n);
    for (std::size_t i = 0; i < half; ++i) {
      value[i] = psi[half + i].value;
      value[half + i] = -psi[i].value;
      for (std::size_t j = 0; j < n; ++j) {
        jacobian(i, j) = psi[half + i].derivative[j];
        jacobian(half + i, j) = -psi[i].derivative[j];
      }
    }
    return value;
  }
  Matrix<Quad> jacobian{0, 0};

 private:
  GeneratingGradient<StepDual<Quad>> gradient_;
};

StepJacobian<Quad> step(const std::string& name, const Assignments& parameters, const TheoremCase& c,
                        const Numbers& z) {
  const auto method = integrators().get(name, "integrator").make(parameters);
  StepDifferentiator<Quad> differentiate(*method, c.model);
  auto result = differentiate(start_time, tau, z);
  EXPECT_EQ(result.status, Status::converged);
  return result;
}

// Theorem 3.1 with (41) and (42), and (55): the step is what its gradient says, N = sigma(M) is that
// gradient's Jacobian, and symmetric.
TEST(GeneratingTheorems, StepsHaveGeneratingFunctions) {
  for (const TheoremCase& c : theorem_cases())
    for (const int order : {1, 4}) {
      const auto s = step("generating-function",
                          {{"order", std::to_string(order)}, {"variant", "P"}, {"extra", "0"}}, c, c.z);
      LagrangianTransformation<Quad> alpha(shared(chart_alpha(*c.model).forward));
      const Matrix<Quad> n = alpha.blocks(t1, start_time, s.z, c.z)(Matrix<Quad>(c.z.size(), s.jacobian));
      EXPECT_LE(asymmetry(n), at_round_off) << c.model->name();

      const Numbers pair = alpha(t1, start_time, s.z, c.z);
      const auto middle = pair.begin() + static_cast<std::ptrdiff_t>(c.z.size());
      Gradient f(*c.model, order);
      EXPECT_LE(distance(f(Numbers(middle, pair.end())), Numbers(pair.begin(), middle)), at_round_off);
      EXPECT_LE(size_of(f.jacobian - n), at_round_off);
    }
}

TEST(GeneratingTheorems, StepsThatAreNotSymplecticHaveNone) {  // control
  for (const TheoremCase& c : theorem_cases()) {
    const auto s = step("rk4", {}, c, c.z);
    LagrangianTransformation<Quad> alpha(shared(chart_alpha(*c.model).forward));
    EXPECT_GT(asymmetry(alpha.blocks(t1, start_time, s.z, c.z)(Matrix<Quad>(c.z.size(), s.jacobian))), 1e-10)
        << c.model->name();
  }
}

// The same step has a generating function in every alpha that satisfies (34), linear or not: here new
// position with old momentum, and that followed by the shear w^ -> w^ + grad s(w), whose w^ does not vanish
// on the diagonal. The weight 1/3 in w is the control.
struct ShearedAlpha {
  int parts = 0;  // of w_0 that are the old position, in thirds
  template <class T>
  void alpha(const T& t, const T& before, In<T> new_z, In<T> old_z, Out<T> w_hat, Out<T> w) const {
    examples::NewPositionOldMomentum{.mass = 1, .damping = 0.3_r}.alpha(t, before, new_z, old_z, w_hat, w);
    w[0] = w[0] + parts * (old_z[0] - new_z[0]) / 3;
    w_hat[0] = w_hat[0] + 2 * w[0] * w[1] + cos(w[0]);
    w_hat[1] = w_hat[1] + w[0] * w[0];
  }
};

TEST(GeneratingTheorems, AnyAlphaThatKeepsTheStructureServes) {
  const TheoremCase c = theorem_cases().front();
  const auto s = step("generating-function", {{"order", "3"}, {"variant", "P"}, {"extra", "0"}}, c, c.z);
  const auto image = [&](const Tape& alpha) {
    LagrangianTransformation<Quad> transformation(shared(alpha));
    return transformation.blocks(t1, start_time, s.z, c.z)(Matrix<Quad>(2, s.jacobian));
  };
  EXPECT_LE(asymmetry(image(record_alpha(examples::NewPositionOldMomentum{.mass = 1, .damping = 0.3_r}, 2))),
            at_round_off);
  EXPECT_LE(asymmetry(image(record_alpha(ShearedAlpha{}, 2))), at_round_off);
  EXPECT_GT(asymmetry(image(record_alpha(ShearedAlpha{1}, 2))), 1e-4);
}

// Proposition 3.2, (52): from any w, the states that f and alpha^-1 give are one step apart.
TEST(GeneratingTheorems, GradientsAreStepsSeenFromTheOtherSide) {
  for (const TheoremCase& c : theorem_cases()) {
    const std::size_t n = c.z.size();
    Numbers w(c.z);
    Gradient f(*c.model, 4);
    Numbers arguments = f(w), states(2 * n);
    arguments.insert(arguments.end(), w.begin(), w.end());
    arguments.push_back(start_time);
    Replay<Quad> backward(shared(chart_alpha(*c.model).backward));
    backward(t1, arguments.data(), states.data());
    const Numbers old_z(states.begin() + static_cast<std::ptrdiff_t>(n), states.end());
    states.resize(n);
    EXPECT_LE(
        distance(step("generating-function", {{"order", "4"}, {"variant", "P"}, {"extra", "0"}}, c, old_z).z,
                 states),
        at_round_off);
    EXPECT_GT(
        distance(step("generating-function", {{"order", "2"}, {"variant", "P"}, {"extra", "0"}}, c, old_z).z,
                 states),
        1e-9);
  }
}

// Theorem 3.2: a random gradient w -> grad phi(w), put into (55) and solved for z', is a K-symplectic map
// with M = (A - N C)^-1 (N D - B). What is not a gradient is not.
class RandomMap {
 public:
  RandomMap(const TheoremCase& c, unsigned seed, bool gradient)
      : alpha_(shared(chart_alpha(*c.model).forward)), n_(c.z.size()) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> draw(-9, 9);
    const auto coefficient = [&] { return Recorded(Real::fraction(draw(random), 200)); };
    std::vector<Recorded> list(n_ * n_ * 2);
    for (Recorded& x : list) x = coefficient();
    const int n = static_cast<int>(n_);
    const Tape phi =
        record(n, 1, [&](const Recorded& t, std::span<const Recorded> w, std::span<Recorded> out) {
          for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t j = 0; j < n_; ++j)
              out[0] =
                  out[0] + list[i * n_ + j] * w[i] * w[j] + list[n_ * n_ + i * n_ + j] * w[i] * sin(w[j] + t);
        });
    const Tape map =
        record(n, n, [&](const Recorded& t, std::span<const Recorded> w, std::span<Recorded> out) {
          const auto slope = pfaff::gradient(phi, t, w, std::vector<Recorded>{Recorded(1)});
          std::copy(slope.begin(), slope.end(), out.begin());
          if (!gradient) out[0] = out[0] + w[1] * w[1] / Recorded(50);
        });
    value_ = std::make_unique<Replay<Quad>>(shared(map));
    slope_ = std::make_unique<Replay<Quad>>(shared(jacobian_tape(map)));
  }
  // z' by Newton's method from z, M with it.
  Numbers operator()(const Numbers& z) {
    Numbers next = z, f(n_), slope(n_ * n_);
    for (int iteration = 0; iteration < 30; ++iteration) {
      const Numbers pair = alpha_(t1, start_time, next, z);
      (*value_)(t1, pair.data() + n_, f.data());
      (*slope_)(t1, pair.data() + n_, slope.data());
      const auto blocks = alpha_.blocks(t1, start_time, next, z);
      const Matrix<Quad> n(n_, slope);
      for (std::size_t k = 0; k < n_; ++k) f[k] -= pair[k];
      const Numbers correction = inverse(blocks.a - n * blocks.c) * f;
      for (std::size_t k = 0; k < n_; ++k) next[k] += correction[k];
      jacobian = blocks.solved_for(n);
    }
    return next;
  }
  Matrix<Quad> jacobian{0, 0};

 private:
  LagrangianTransformation<Quad> alpha_;
  std::size_t n_;
  std::unique_ptr<Replay<Quad>> value_, slope_;
};

TEST(GeneratingTheorems, GradientsDefineSymplecticMaps) {
  for (const TheoremCase& c : theorem_cases())
    for (unsigned seed = 1; seed <= 5; ++seed)
      for (const bool gradient : {true, false}) {
        RandomMap map(c, seed, gradient);
        const Numbers after = map(c.z);
        const Matrix<Quad> m = map.jacobian;
        const double residual = size_of(pulled_back(structure_at(*c.model, t1, after), m) -
                                        structure_at(*c.model, start_time, c.z));
        if (gradient) {
          EXPECT_LE(residual, at_round_off * (1 + size_of(m) * size_of(m))) << c.model->name() << ' ' << seed;
        } else {
          EXPECT_GT(residual, 1e-6) << c.model->name() << ' ' << seed;
        }
        // M is the map's Jacobian: central differences, whose error is about h^2.
        const Quad h(1e-10);
        for (std::size_t j = 0; j < c.z.size(); ++j) {
          Numbers up = c.z, down = c.z;
          up[j] += h;
          down[j] -= h;
          const Numbers a = map(up), b = map(down);
          for (std::size_t i = 0; i < c.z.size(); ++i)
            EXPECT_LE(static_cast<double>(abs((a[i] - b[i]) / (Quad(2) * h) - m(i, j))), 1e-17);
        }
      }
}

// Theorem 4.1 on the exact flow of the oscillator: phi_w = N(t) w with N = sigma(M), and its derivative in t
// at fixed w, by dual numbers, is (A - N C) K^-1 g + d_t alpha_1 - N d_t alpha_2. With the K^-1 D printed in
// (61) it would not be.
TEST(GeneratingTheorems, EvolutionOfTheExactGeneratingFunction) {
  using D = Dual<Quad, 1>;
  const auto model = systems().get("damped-oscillator", "system").make({{"nu", "0.3"}});
  const AlphaTapes tapes = chart_alpha(*model);
  Replay<D> flow(model->tape(Formula::exact_solution));
  Matrix<D> m(2, 2);
  for (std::size_t j = 0; j < 2; ++j) {
    const std::vector<D> initial{D(j == 0 ? 1 : 0), D(j == 1 ? 1 : 0), D(start_time)};
    std::vector<D> after(2);
    flow(D::variable(tau, 0), initial.data(), after.data());
    for (std::size_t i = 0; i < 2; ++i) m(i, j) = after[i];
  }
  LagrangianTransformation<D> alpha(shared(tapes.forward));
  const std::vector<D> anywhere(2);
  const Matrix<D> n = alpha.blocks(D::variable(t1, 0), D(start_time), anywhere, anywhere)(m);

  const Numbers w{Quad(0.6), Quad(-0.3)};
  Numbers u(9), rate(2), expected(2);
  u[2] = w[0];
  u[3] = w[1];
  u[8] = start_time;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      u[i] += n(i, j).value * w[j];
      expected[i] += n(i, j).derivative[0] * w[j];
      u[4 + 2 * i + j] = n(i, j).value;
    }
  Replay<Quad> evolve(shared(evolution(*model, tapes)));
  evolve(t1, u.data(), rate.data());
  EXPECT_LE(distance(rate, expected), at_round_off);

  // Control: the sign as printed turns the part along the flow around.
  Numbers pair(u.begin(), u.begin() + 4), states(4);
  pair.push_back(start_time);
  Replay<Quad> backward(shared(tapes.backward));
  backward(t1, pair.data(), states.data());
  LagrangianTransformation<Quad> in_quad(shared(tapes.forward));
  const Numbers partial = in_quad.time_derivative(t1, start_time, std::span<const Quad>(states).first(2),
                                                  std::span<const Quad>(states).subspan(2));
  Numbers printed(2);
  for (std::size_t i = 0; i < 2; ++i) {
    Quad at_rest = partial[i];
    for (std::size_t j = 0; j < 2; ++j) at_rest -= u[4 + 2 * i + j] * partial[2 + j];
    printed[i] = Quad(2) * at_rest - rate[i];
  }
  EXPECT_GT(distance(printed, expected), 1e-2);
}

}  // namespace
}  // namespace pfaff
