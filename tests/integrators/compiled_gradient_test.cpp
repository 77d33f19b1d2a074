// The compiled gradient of a generating function gives the same as the interpreted one, for every operation
// that a formula may use, every registered field that is compiled, every number of lanes, and every share of
// old and new coordinates in w.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/integrators/generating/gradient_evaluator.hpp>
#include <pfaff/verify/check.hpp>

namespace pfaff {
namespace {

// Every operation of the vocabulary, on the state, on time alone, on constants, and on mixtures of them.
struct EveryOperation {
  static constexpr int dimension = 4;
  Real a = 0.7_r, b = -0.3_r;
  template <class T>
  T hamiltonian(const T& t, In<T> z) const {
    return z[0] * z[1] + z[2] * z[3] + t;
  }
  template <class T>
  void chart_field(const T& t, In<T> y, Out<T> rate) const {
    const T growth = exp(a * t), wave = sin(2 * t) * cos(2 * t), decay = T(1) / growth,
            root = sqrt(T(3) + t * t);
    const T square = y[0] * y[0], inside = T(2) + square + y[1] * y[2] + b * y[3];
    rate[0] = sqrt(inside) * growth - sin(y[1]) * wave + cos(y[1]) / inside + T(a);
    rate[1] = log(inside) / root + pow(inside, Real::fraction(3, 2)) * decay - (3 - y[2]) + b;
    rate[2] = select(y[3] - 1, y[0] * t, exp(y[3]) * log(growth)) + pow(T(2) + t, Real(3)) - y[0] / 3;
    rate[3] = select(t - 1, t * t, sqrt(T(2))) * y[2] - (-y[1]) + select(T(1), y[0], y[1]) +
              exp(T(a)) / y[4 - 1 - 2];
  }
};
// A rate that is constant, one that depends on time alone, one that is an input, one shared with another.
struct TrivialRates {
  static constexpr int dimension = 4;
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return z[0];
  }
  template <class T>
  void chart_field(const T& t, In<T> y, Out<T> rate) const {
    rate[0] = T(5);
    rate[1] = t * t;
    rate[2] = y[3];
    rate[3] = y[3];
  }
};

template <class S>
std::shared_ptr<const Model> compiled_sample(const char* name, const S& system = S()) {
  return make_model({.name = name,
                     .title = "",
                     .reference = "",
                     .coordinates = {{"a", ""}, {"b", ""}, {"c", ""}, {"d", ""}},
                     .initial = {0.3_r, 0.5_r, 0.2_r, 0.9_r}},
                    system);
}

struct Scheme {
  int order;
  bool symmetric;
  int extra;
  GeneratingShare share;
};
std::vector<Scheme> schemes() {
  std::vector<Scheme> list;
  for (int m = 2; m <= 16; m += 2) list.push_back({m, true, 0, GeneratingForm::midpoint});
  list.push_back({4, true, 4, GeneratingForm::midpoint});
  list.push_back({8, true, 2, GeneratingForm::midpoint});
  for (int m = 1; m <= 8; ++m)
    for (const GeneratingForm form :
         {GeneratingForm::midpoint, GeneratingForm::new_q_old_p, GeneratingForm::old_q_new_p})
      list.push_back({m, false, m % 3, form});
  return list;
}

// Largest difference of psi, compiled and interpreted, relative to psi; how many schemes were in fact
// compiled.
double worst_difference(const Model& model, const std::vector<double>& w, int& compiled) {
  const Problem<double> problem(std::shared_ptr<const Model>(std::shared_ptr<void>(), &model));
  const auto n = static_cast<std::size_t>(model.dimension());
  double worst = 0;
  for (const Scheme& s : schemes()) {
    const GaussCoefficients gauss = gauss_coefficients((s.order + 1) / 2);
    GradientEvaluator<double> fast(problem, s.order, s.symmetric, s.extra, s.share, gauss);
    GeneratingGradient<double> slow(model.tape(Formula::chart_field), s.order, s.symmetric, s.share, gauss,
                                    s.extra);
    compiled += fast.is_compiled() ? 1 : 0;
    std::vector<double> a(n), b(n);
    for (const double t : {0.0, 0.4, 1.7})
      for (const double tau : {0.05, -0.02}) {
        fast.set_step(t, tau);
        slow.set_step(t, tau);
        fast(w.data(), a.data());
        slow(w.data(), b.data());
        for (std::size_t k = 0; k < n; ++k)
          worst = std::max(
              worst, std::isnan(a[k]) ? INFINITY : std::abs(a[k] - b[k]) / (std::abs(b[k]) + std::abs(tau)));
      }
  }
  return worst;
}

// A hundred units of round-off: sums of up to 16 levels in another order, reciprocals for quotients by
// constants.
constexpr double compiled_tolerance = 1e-14;

TEST(CompiledGradient, IsTheInterpretedOneForEveryOperation) {
  int compiled = 0;
  EXPECT_LE(
      worst_difference(*compiled_sample<EveryOperation>("every-operation"), {0.3, 0.5, 0.2, 0.9}, compiled),
      compiled_tolerance);
  EXPECT_LE(
      worst_difference(*compiled_sample<EveryOperation>("every-operation"), {0.1, 0.4, -0.6, 1.3}, compiled),
      compiled_tolerance);
  EXPECT_LE(worst_difference(*compiled_sample<TrivialRates>("trivial-rates"), {0.3, 0.5, 0.2, 0.9}, compiled),
            compiled_tolerance);
  EXPECT_EQ(compiled, 3 * static_cast<int>(schemes().size()));
}

TEST(CompiledGradient, IsTheInterpretedOneForEveryRegisteredField) {
  int systems_compiled = 0;
  for (const SystemPlugin* plugin : systems().all()) {
    const auto model = plugin->make({});
    if (!model->facets().has(Facet::darboux_chart)) continue;
    std::vector<double> z, w(static_cast<std::size_t>(model->dimension()));
    for (const Real& x : generic_state(*model)) z.push_back(x.value());
    Replay<double>(model->tape(Formula::chart))(0.4, z.data(), w.data());
    int compiled = 0;
    EXPECT_LE(worst_difference(*model, w, compiled), compiled_tolerance) << plugin->name();
    systems_compiled += compiled > 0 ? 1 : 0;
  }
  EXPECT_GE(systems_compiled, 7);
}

// The control: a field that differs by 1e-9 is told apart.
TEST(CompiledGradient, TellsADifferentFieldApart) {
  const auto sound = compiled_sample<EveryOperation>("sound"),
             spoiled = compiled_sample("spoiled", EveryOperation{.b = -0.300000001_r});
  const GaussCoefficients gauss = gauss_coefficients(4);
  GradientEvaluator<double> a(Problem<double>(sound), 8, true, 0, GeneratingForm::midpoint, gauss);
  GradientEvaluator<double> b(Problem<double>(spoiled), 8, true, 0, GeneratingForm::midpoint, gauss);
  const std::vector<double> w{0.3, 0.5, 0.2, 0.9};
  std::vector<double> x(4), y(4);
  a.set_step(0.1, 0.1);
  b.set_step(0.1, 0.1);
  a(w.data(), x.data());
  b(w.data(), y.data());
  double apart = 0;
  for (std::size_t k = 0; k < 4; ++k) apart = std::max(apart, std::abs(x[k] - y[k]) / std::abs(x[k]));
  EXPECT_GT(apart, 1e-10);
}

}  // namespace
}  // namespace pfaff
