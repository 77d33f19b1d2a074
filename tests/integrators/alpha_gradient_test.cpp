// The gradient of the generating function for any transformation alpha: its terms against those of the
// Darboux chart's engine and against the recursion written out literally, and identities between
// transformations.
#include <gtest/gtest.h>

#include <pfaff/core/system.hpp>
#include <pfaff/integrators/generating/alpha_gradient.hpp>
#include <pfaff/integrators/generating/generating_gradient.hpp>
#include <pfaff/tests/generating/generating_expansion.hpp>

#include "generating_samples.hpp"
#include "mixed_alpha.hpp"

namespace pfaff {
namespace {

using testing::AlphaKind;
using testing::at_round_off;
using testing::bent_with;
using testing::BentWithAlpha;
using testing::distance;
using testing::Numbers;
using testing::shared;
using testing::size_of;
using testing::start_time;

// phi_w^(0), .., phi_w^(order) at w.
std::vector<Numbers> terms(const Model& model, const std::shared_ptr<const Tape>& alpha, int order,
                           const Numbers& w, const Numbers& guess) {
  AlphaGradient<Quad> gradient(model.tape(Formula::field), alpha, order, gauss_coefficients((order + 1) / 2));
  gradient.set_step(start_time, Quad(1));
  gradient.search_from(guess, guess);
  const std::size_t n = w.size();
  Numbers all(gradient.term_count() * n);
  EXPECT_EQ(gradient.terms(w.data(), all.data()), Status::converged);
  std::vector<Numbers> list;
  for (std::size_t k = 0; k < gradient.term_count(); ++k)
    list.emplace_back(all.begin() + static_cast<std::ptrdiff_t>(k * n),
                      all.begin() + static_cast<std::ptrdiff_t>((k + 1) * n));
  return list;
}
std::vector<Numbers> terms(const Model& model, int order, const Numbers& w, const Numbers& guess) {
  return terms(model, model.tape(Formula::alpha), order, w, guess);
}
// The same in the chart, (psi_p, -psi_q).
std::vector<Numbers> chart_terms(const Model& model, int order, const Numbers& w) {
  GeneratingGradient<Quad> gradient(model.tape(Formula::chart_field), order, false, GeneratingForm::midpoint,
                                    gauss_coefficients((order + 1) / 2));
  gradient.set_step(start_time, Quad(1));
  const std::size_t n = w.size(), half = n / 2;
  Numbers all(gradient.term_count() * n);
  gradient.terms(w.data(), all.data());
  std::vector<Numbers> list;
  for (std::size_t k = 0; k <= static_cast<std::size_t>(order); ++k) {
    Numbers term(n);
    for (std::size_t i = 0; i < half; ++i) {
      term[i] = all[k * n + half + i];
      term[half + i] = -all[k * n + i];
    }
    list.push_back(term);
  }
  return list;
}

TEST(AlphaGradient, OfTheStandardAlphaIsTheCharts) {
  const auto expect = [](const std::shared_ptr<const Model>& model, const Numbers& z) {
    Numbers w(z.size());
    Replay<Quad>(model->tape(Formula::chart))(start_time, z.data(), w.data());
    Numbers away = z;  // the search has to find z
    for (Quad& x : away) x = x * Quad(1.05) + Quad(0.01);
    for (int order = 1; order <= 9; ++order) {
      const auto found = terms(*model, shared(chart_alpha(*model).forward), order, w, away);
      const auto expected = chart_terms(*model, order, w);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t k = 0; k < found.size(); ++k)
        EXPECT_LE(distance(found[k], expected[k]), at_round_off * std::max(1.0, size_of(expected[k])))
            << model->name() << " order " << order << " term " << k;
    }
  };
  expect(bent_with(AlphaKind::standard), {Quad(0.6), Quad(-0.3)});
  for (const char* name : {"damped-pendulum", "lotka-volterra"})
    expect(systems().get(name, "system").make({}), {Quad(0.6), Quad(0.3)});
  for (const char* name : {"henon-heiles", "damped-bead-in-bowl", "dense-time-structure"})
    expect(systems().get(name, "system").make({}), {Quad(0.1), Quad(-0.3), Quad(0.25), Quad(0.2)});
}

TEST(AlphaGradient, OfANonlinearAlphaSatisfiesTheRecursion) {
  for (const AlphaKind kind : {AlphaKind::standard, AlphaKind::mixed}) {
    BentWithAlpha author;
    author.kind = kind;
    const auto model = bent_with(kind);
    const AlphaTapes alpha{*model->tape(Formula::alpha),
                           record(5, 4, [&](const Recorded& t, In<Recorded> x, Out<Recorded> out) {
                             author.alpha_inverse<Recorded>(t, x[4], x.first(2), x.subspan(2, 2),
                                                            out.first(2), out.subspan(2, 2));
                           })};
    const auto oracle = expand_gradient(evolution(*model, alpha), 2, 5, ExpansionRule::total_derivative);
    const Numbers w{Quad(0.6), Quad(1.2)};
    const auto found = terms(*model, 5, w, {Quad(0.6), Quad(0.1)});
    for (std::size_t k = 0; k <= 5; ++k) {
      Numbers expected(2);
      Replay<Quad>(shared(oracle[k]))(start_time, w.data(), expected.data());
      EXPECT_LE(distance(found[k], expected), at_round_off * std::max(1.0, size_of(expected))) << k;
    }
  }
}

// The terms do differ, and terms of low degree do not depend on where the series is cut.
TEST(AlphaGradient, DependsOnAlphaAndNotOnTheTruncation) {
  const Numbers w{Quad(3) / Quad(5), Quad(6) / Quad(5)}, guess{Quad(0.6), Quad(0.1)};
  const auto model = bent_with(AlphaKind::mixed);
  const auto many = terms(*model, 12, w, guess), few = terms(*model, 4, w, guess);
  for (std::size_t k = 0; k <= 4; ++k) EXPECT_LE(distance(many[k], few[k]), at_round_off * size_of(many[4]));
  // On the diagonal the mixed w is the standard one with 1 added to w_2, and w^ enters it squared: the terms
  // differ from the third on.
  const auto standard = terms(*bent_with(AlphaKind::standard), 4, {w[0], w[1] - Quad(1)}, guess);
  for (std::size_t k = 0; k <= 2; ++k) EXPECT_LE(distance(few[k], standard[k]), at_round_off) << k;
  for (std::size_t k = 3; k <= 4; ++k) EXPECT_GT(distance(few[k], standard[k]), 1e-3) << k;
}

// (w^, w) -> (w^ + grad s(w), w) adds grad s to the term of degree 0 and changes no other.
TEST(AlphaGradient, KeepsWhatDoesNotVanishOnTheDiagonal) {
  const Numbers w{Quad(0.6), Quad(0.2)}, guess{Quad(0.6), Quad(0.1)};
  const auto sheared = terms(*bent_with(AlphaKind::sheared), 6, w, guess);
  const auto standard = terms(*bent_with(AlphaKind::standard), 6, w, guess);
  EXPECT_LE(size_of(standard[0]), at_round_off);
  EXPECT_LE(distance(sheared[0], {Quad(2) * w[0] * w[1] + cos(w[0]), w[0] * w[0]}), at_round_off);
  for (std::size_t k = 1; k <= 6; ++k)
    EXPECT_LE(distance(sheared[k], standard[k]), at_round_off * std::max(1.0, size_of(standard[k]))) << k;
}

double gradient_asymmetry(const Model& model, int order) {
  using D = Dual<Quad, 2>;
  AlphaGradient<D> gradient(model.tape(Formula::field), model.tape(Formula::alpha), order,
                            gauss_coefficients((order + 1) / 2));
  gradient.set_step(D(start_time), D(Quad(1) / Quad(4)));
  const std::vector<D> near{D(Quad(0.6)), D(Quad(0.1))};
  gradient.search_from(near, near);
  const std::vector<D> w{D::variable(Quad(0.6), 0), D::variable(Quad(1.1), 1)};
  std::vector<D> psi(2);
  EXPECT_EQ(gradient(w.data(), psi.data()), Status::converged);
  return static_cast<double>(abs(psi[0].derivative[1] - psi[1].derivative[0]));
}

TEST(AlphaGradient, IsAGradientWhereAlphaIsLagrangian) {
  for (int order = 1; order <= 8; ++order) {
    for (const AlphaKind kind : {AlphaKind::standard, AlphaKind::mixed, AlphaKind::sheared})
      EXPECT_LE(gradient_asymmetry(*bent_with(kind), order), at_round_off) << order;
    // The control. To first order psi is h times the field, wherever w is.
    if (order > 1) {
      EXPECT_GT(gradient_asymmetry(*bent_with(AlphaKind::weighted), order), 1e-4) << order;
    }
  }
}

TEST(AlphaGradient, IsOddInTimeWhereAlphaIsSymmetricAndNothingDependsOnTime) {
  const auto& plugin = systems().get("damped-relativistic-oscillator", "system");
  const Numbers w{Quad(0.6), Quad(0.2)}, guess{Quad(0.6), Quad(0.2)};
  const auto free = terms(*plugin.make({{"nu", "0"}}), 6, w, guess);
  const auto damped = terms(*plugin.make({}), 6, w, guess);
  for (const std::size_t k : {2U, 4U, 6U}) {
    EXPECT_LE(size_of(free[k]), at_round_off) << k;
    EXPECT_GT(size_of(damped[k]), 1e-4) << k;
  }
}

TEST(AlphaGradient, StatesThatCannotBeFoundAreReported) {
  const auto model = systems().get("damped-relativistic-oscillator", "system").make({});
  AlphaGradient<double> gradient(model->tape(Formula::field), model->tape(Formula::alpha), 2,
                                 gauss_coefficients(1));
  gradient.set_step(0.7, 0.1);
  const std::vector<double> faster_than_light{0.5, 1.5};
  gradient.search_from(faster_than_light, faster_than_light);
  const std::vector<double> w{0.6, 0.2};
  std::vector<double> psi(2);
  EXPECT_NE(gradient(w.data(), psi.data()), Status::converged);
}

}  // namespace
}  // namespace pfaff
