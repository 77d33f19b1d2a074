// Splittings for H = A + eps B: their generalised order conditions by words, and their orders measured on
// matrices, where no word takes part; and what they do on planets.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/integrators/splitting/near_integrable_schemes.hpp>
#include <pfaff/runs/block_values.hpp>
#include <pfaff/runs/integrate.hpp>

#include "methods.hpp"

namespace {
using namespace pfaff;

std::shared_ptr<const Model> system_of(const char* name, const Assignments& set = {}) {
  return systems().get(name, "system").make(set);
}
std::unique_ptr<MethodInstance> splitting_of(const std::string& scheme) {
  return integrators().get("exact-flow-splitting", "integrator").make({{"scheme", scheme}});
}

std::vector<NearIntegrableScheme> all_schemes() {
  std::vector<NearIntegrableScheme> list;
  for (const std::string& name : near_integrable_names()) list.push_back(near_integrable_scheme(name));
  return list;
}

const OrderCondition* violated(const NearIntegrableScheme& scheme, const std::vector<int>& orders) {
  static std::vector<OrderCondition> conditions;
  conditions = near_integrable_conditions(scheme.flows, orders);
  return first_violated(conditions, orders.front(), precision_of_quad_coefficients);
}

TEST(NearIntegrable, ConditionsAreAsManyAsTheirWords) {
  const auto count = [](std::vector<int> orders) {
    return near_integrable_conditions({{0, Quad(1)}, {1, Quad(1)}}, orders).size();
  };
  // One of A, and one for each degree with one B.
  EXPECT_EQ(count({8, 1}), 9U);
  // With all letters up to one degree, those of all Lyndon words: 2 + 1 + 2 + 3.
  EXPECT_EQ(count({4}), 8U);
  // A and eight with one B; with two B none of degree 2, one of degree 3 (A B B) and of degree 4 (A A B B);
  // A B B B of degree 4.
  EXPECT_EQ(count({8, 4}), 12U);
}

TEST(NearIntegrable, SchemesFulfilTheirConditionsAndNoOthers) {
  for (const NearIntegrableScheme& scheme : all_schemes()) {
    const OrderCondition* wrong = violated(scheme, scheme.orders);
    EXPECT_EQ(wrong, nullptr) << scheme.name << ": " << (wrong == nullptr ? "" : wrong->name);
    // No entry can be larger by two (of palindromes those of even degree hold by themselves).
    for (std::size_t k = 0; k < scheme.orders.size(); ++k) {
      std::vector<int> more = scheme.orders;
      more[k] += 2;
      if (more[k] > largest_degree || (k > 0 && more[k] > more[k - 1])) continue;
      EXPECT_NE(violated(scheme, more), nullptr) << scheme.name << " " << k;
    }
    bool palindrome = true;
    for (std::size_t k = 0; k < scheme.flows.size(); ++k) {
      const PartialFlow &a = scheme.flows[k], &b = scheme.flows[scheme.flows.size() - 1 - k];
      palindrome = palindrome && a.part == b.part && abs(a.length - b.length) < Quad(1e-32);
    }
    EXPECT_EQ(palindrome, scheme.symmetric) << scheme.name;
  }
}

TEST(NearIntegrable, ACoefficientWrongByABillionthIsRefused) {
  for (const NearIntegrableScheme& scheme : all_schemes()) {
    // Words of degree 10 and 12 take a second for each change: of those schemes the first flows and the
    // middle.
    const std::size_t count = scheme.flows.size(), stride = scheme.orders.front() > 8 ? count / 2 : 1;
    for (std::size_t k = 0; k < count; k += stride) {
      // What one flow has more another of the same part has less, so that the lengths still add up to one.
      for (const std::size_t other : {(k + 2) % scheme.flows.size(), (k + 4) % scheme.flows.size()}) {
        if (other == k || scheme.flows[other].part != scheme.flows[k].part) continue;
        NearIntegrableScheme changed = scheme;
        changed.flows[k].length += Quad(1e-9);
        changed.flows[other].length -= Quad(1e-9);
        const OrderCondition* first = violated(changed, scheme.orders);
        ASSERT_NE(first, nullptr) << scheme.name << " " << k;
        EXPECT_GE(first->order, 2) << scheme.name << " " << k;
      }
    }
  }
}

// Matrices with a number eps: dual numbers of dual numbers give the derivatives by eps at eps = 0.
using One = Dual<Quad, 1>;
using Two = Dual<One, 1>;
constexpr std::size_t matrix_size = 3;
template <class T>
using Square = std::array<T, matrix_size * matrix_size>;

template <class T>
Square<T> product(const Square<T>& a, const Square<T>& b) {
  Square<T> c;
  c.fill(T(0));
  for (std::size_t i = 0; i < matrix_size; ++i)
    for (std::size_t k = 0; k < matrix_size; ++k)
      for (std::size_t j = 0; j < matrix_size; ++j)
        c[i * matrix_size + j] = c[i * matrix_size + j] + a[i * matrix_size + k] * b[k * matrix_size + j];
  return c;
}
template <class T>
Square<T> exponential(Square<T> x, const T& length) {
  for (T& entry : x) entry = entry * length;
  Square<T> sum, term;
  sum.fill(T(0));
  for (std::size_t i = 0; i < matrix_size; ++i) sum[i * matrix_size + i] = T(1);
  term = sum;
  for (int k = 1; k < 45; ++k) {
    term = product(term, x);
    for (T& entry : term) entry = entry / T(k);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = sum[i] + term[i];
  }
  return sum;
}
const std::array<int, matrix_size * matrix_size> first_matrix{3, -7, 2, 5, 1, -4, -2, 6, -5},
    second_matrix{-1, 4, 6, -3, 2, 5, 7, -2, 1};

// The error of a step of size h: its first and second derivative by eps, the largest entries.
std::array<double, 2> errors(const NearIntegrableScheme& scheme, const Quad& h) {
  Two eps(One(0));
  eps.value.derivative[0] = Quad(1);
  eps.derivative[0] = One(1);
  Square<Two> a, b, whole;
  for (std::size_t k = 0; k < a.size(); ++k) {
    a[k] = Two(One(Quad(first_matrix[k]) / Quad(8)));
    b[k] = eps * Two(One(Quad(second_matrix[k]) / Quad(8)));
    whole[k] = a[k] + b[k];
  }
  Square<Two> step;
  step.fill(Two(0));
  for (std::size_t i = 0; i < matrix_size; ++i) step[i * matrix_size + i] = Two(1);
  for (const PartialFlow& flow : scheme.flows)
    step = product(exponential(flow.part == 0 ? a : b, Two(One(flow.length * h))), step);
  const Square<Two> exact = exponential(whole, Two(One(h)));
  std::array<double, 2> worst{};
  for (std::size_t k = 0; k < step.size(); ++k) {
    const Two difference = step[k] - exact[k];
    EXPECT_LT(static_cast<double>(abs(difference.value.value)), 1e-31);  // eps = 0: A alone
    worst[0] = std::max(worst[0], static_cast<double>(abs(difference.value.derivative[0])));
    worst[1] = std::max(worst[1], static_cast<double>(abs(difference.derivative[0].derivative[0])));
  }
  return worst;
}

// Errors of one step fall as h^(n_k + 1). The slope is taken from the largest steps whose errors are series
// in h by then and above round-off, and may be off by what the next term of the series, h^2 as large, adds.
TEST(NearIntegrable, OrdersOfBothPowersOfThePerturbationShowOnMatrices) {
  for (const NearIntegrableScheme& scheme : all_schemes()) {
    if (scheme.name == "corrected-11") continue;  // its sub-steps reach two steps away: no series at these h
    const Quad h = Quad(1) / Quad(scheme.symmetric ? 8 : 32);
    const auto coarse = errors(scheme, h), fine = errors(scheme, h / Quad(2));
    for (std::size_t k = 0; k < 2; ++k) {
      const double slope = std::log2(coarse[k] / fine[k]);
      const int order = scheme.orders[std::min(k, scheme.orders.size() - 1)];
      EXPECT_NEAR(slope, order + 1, 0.15) << scheme.name << ", order " << k + 1 << " in eps: " << coarse[k];
    }
  }
}
// The control: a scheme that claims one more flow of each kind than it has.
TEST(NearIntegrable, AWrongLengthShowsOnMatrices) {
  NearIntegrableScheme scheme = near_integrable_scheme("aba-8-4");
  scheme.flows[1].length += Quad(1e-9);
  scheme.flows[3].length -= Quad(1e-9);
  const auto coarse = errors(scheme, Quad(1) / Quad(64)), fine = errors(scheme, Quad(1) / Quad(128));
  EXPECT_LT(std::log2(coarse[0] / fine[0]), 4);
}

// The largest relative error of the energy in a run of the outer planets, with all planets' masses scaled.
double planetary_energy_error(const std::string& scheme, const Quad& scale, const Quad& h, int steps) {
  Assignments masses;
  for (const auto& [name, mass] : {std::pair{"jupiter", 0.000954786104043_r},
                                   {"saturn", 0.000285583733151_r},
                                   {"uranus", 0.0000437273164546_r},
                                   {"neptune", 0.0000517759138449_r},
                                   {"pluto", Real::fraction(1, 130000000)}})
    masses.emplace_back(name, to_string(Real(mass.quad() * scale)));
  const auto model = system_of("outer-solar-system", masses);
  auto run = integrate<Quad>(model, splitting_of(scheme), h);
  BlockValues<Quad> invariants(model, Formula::invariants, model->invariants().size(), 1);
  const Quad start = invariants.at(run.time(), run.state())[0];
  double worst = 0;
  for (int k = 0; k < steps; ++k) {
    run.steps(1).expect_reached();
    const Quad energy = invariants.at(run.time(), run.state())[0];
    worst = std::max(worst, static_cast<double>(abs(energy / start - Quad(1))));
  }
  return worst;
}

// H is wrong by eps h^(n_1) + eps^2 h^(n_2) + eps^3 h^(n_3) relative to A: at planets of a tenth of the mass
// the error is a tenth, a hundredth or a thousandth, whichever term is the largest.
TEST(NearIntegrable, ErrorsScaleWithThePowerOfThePlanetsMasses) {
  struct Row {
    const char* scheme;
    double h;   // days; Jupiter goes round in 4333
    int power;  // of eps
  };
  for (const Row& row : {Row{"strang", 100, 1}, Row{"aba-8-2", 800, 1}, Row{"aba-8-2", 20, 2},
                         Row{"aba-8-4", 50, 2}, Row{"corrected-7", 40, 2}}) {
    const int steps = static_cast<int>(std::max(3000.0, 8 * row.h) / row.h);
    const double full = planetary_energy_error(row.scheme, Quad(1), Quad(row.h), steps),
                 tenth = planetary_energy_error(row.scheme, Quad(1) / Quad(10), Quad(row.h), steps);
    EXPECT_NEAR(std::log10(full / tenth), row.power, 0.2) << row.scheme << " at " << row.h << ": " << full;
  }
}
// And with the step: aba-8-2 is of order 8 at steps so long that the term with eps prevails, of order 2
// below.
TEST(NearIntegrable, OrdersInTheStepChangeWhereTheTermsDo) {
  const auto slope = [](const char* scheme, double h) {
    const int steps = static_cast<int>(3200 / h);
    return std::log2(planetary_energy_error(scheme, Quad(1), Quad(h), steps) /
                     planetary_energy_error(scheme, Quad(1), Quad(h / 2), 2 * steps));
  };
  EXPECT_NEAR(slope("strang", 100), 2, 0.2);
  EXPECT_NEAR(slope("aba-8-2", 20), 2, 0.2);
  EXPECT_GT(slope("aba-8-2", 800), 5);
  EXPECT_NEAR(slope("aba-8-4", 50), 4, 0.4);
}

TEST(NearIntegrable, TheMapOfWisdomAndHolmanIsHalfAKeplerStepAKickAndHalfAKeplerStep) {
  const auto model = system_of("outer-solar-system");
  std::vector<Quad> z, change(36);
  for (const Real& x : model->initial()) z.push_back(x.quad());
  const auto stepped =
      pfaff::testing::after_steps(*pfaff::testing::method_named("wisdom-holman"), model, Quad(30), 1, z);
  const auto flows = model->exact_flows<Quad>();
  for (const auto& [part, h] : {std::pair{0U, 15}, {1U, 30}, {0U, 15}}) {
    ASSERT_EQ(flows->change(part, Quad(h), z, change), Status::converged);
    for (std::size_t k = 0; k < z.size(); ++k) z[k] += change[k];
  }
  for (std::size_t k = 0; k < z.size(); ++k)
    EXPECT_LE(abs(z[k] - stepped[k]), Quad(1e-32) * (abs(z[k]) + Quad(1e-12))) << k;
}

TEST(NearIntegrable, SystemsThatDoNotFitAreRefusedWithTheReason) {
  EXPECT_EQ(splitting_of("strang")
                ->refuses(*system_of("pendulum"))
                .find("exact-flow-splitting needs exact-flows; pendulum offers "),
            0U);
  EXPECT_EQ(
      splitting_of("aba-8-4")->refuses(*system_of("free-rigid-body")),
      "exact-flow-splitting with scheme=aba-8-4 needs a system of two parts; free-rigid-body has 3, for "
      "which there is scheme=strang");
  EXPECT_EQ(splitting_of("strang")->refuses(*system_of("free-rigid-body")), "");
  EXPECT_NE(splitting_of("strang")->refuses(*system_of("n-body", {{"softening", "0.1"}})), "");
  EXPECT_EQ(splitting_of("strang")->refuses(*system_of("n-body", {{"bodies", "4"}})), "");
  EXPECT_THROW((void)splitting_of("aba-9-4"), InputError);
}

// Two planets in the same place, a planet in the Sun, and a state that is not finite: a status, and the state
// as it was before the step.
TEST(NearIntegrable, EncountersThatHaveNoFlowEndWithAStatus) {
  const auto model = system_of("outer-solar-system");
  const auto stepper = splitting_of("strang")->stepper(model, 0.0);
  std::vector<double> start;
  for (const Real& x : model->initial()) start.push_back(x.value());
  std::int64_t completed = 0;
  for (const std::size_t with : {std::size_t{0}, std::size_t{2}}) {
    std::vector<double> z = start;
    // A step of size zero leaves them where they are until the kick.
    for (const std::size_t x : {0U, 6U, 12U}) z[x + 1] = z[x + with];
    const std::vector<double> before = z;
    EXPECT_EQ(stepper->advance(0, 0, 0, 1, z, completed), Status::non_finite) << with;
    EXPECT_EQ(z, before);
    EXPECT_EQ(completed, 0);
  }
  std::vector<double> z = start;
  z[20] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(stepper->advance(0, 0, 10, 1, z, completed), Status::non_finite);
}

}  // namespace
