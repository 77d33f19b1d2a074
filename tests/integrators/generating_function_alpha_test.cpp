// The schemes of a transformation alpha that a user gives: structure, order, symmetry, agreement with the
// scheme in the chart, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/integrators/generating/generating_map_check.hpp>
#include <pfaff/runs/support/structure.hpp>
#include <pfaff/verify/check.hpp>

#include "generating_samples.hpp"
#include "methods.hpp"
#include "mixed_alpha.hpp"

namespace pfaff {
namespace {

using testing::after_steps;
using testing::AlphaKind;
using testing::bent_with;
using testing::coupled;
using testing::distance;
using testing::initial_state;
using testing::method_named;
using testing::structure_residual;
using ModelPointer = std::shared_ptr<const Model>;

std::unique_ptr<MethodInstance> alpha_scheme(int order) {
  return method_named("generating-function-alpha", {{"order", std::to_string(order)}});
}
ModelPointer relativistic(const Assignments& parameters = {}) {
  return systems().get("damped-relativistic-oscillator", "system").make(parameters);
}
// Round-off of a step: what the schemes in a chart are held to.
template <class T>
constexpr double step_round_off = std::is_same_v<T, Quad> ? 1e-31 : 1e-14;

// By the stepper itself: one of the systems has an alpha that the method refuses.
template <class T>
std::vector<T> steps(const MethodInstance& method, const ModelPointer& model, int count) {
  std::vector<T> z = initial_state<T>(*model);
  std::int64_t completed = 0;
  EXPECT_EQ(method.stepper(model, T())
                ->advance(T(Real::fraction(7, 10)), 0, T(Real::fraction(1, 20)), count, z, completed),
            Status::converged);
  return z;
}

template <class T>
class GeneratingFunctionAlphaTest : public ::testing::Test {};
using TestedScalars = ::testing::Types<double, Quad>;
TYPED_TEST_SUITE(GeneratingFunctionAlphaTest, TestedScalars);

// K(z, t), and w a nonlinear mix of both states.
TYPED_TEST(GeneratingFunctionAlphaTest, KeepsTheStructure) {
  for (int order = 1; order <= 8; ++order) {
    const auto method = alpha_scheme(order);
    for (const ModelPointer& model :
         {relativistic(), bent_with(AlphaKind::standard), bent_with(AlphaKind::mixed),
          bent_with(AlphaKind::sheared), coupled()}) {
      EXPECT_LE(structure_residual<TypeParam>(*method, model), step_round_off<TypeParam>)
          << model->name() << " order " << order;
      EXPECT_TRUE(method->refuses(*model).empty()) << method->refuses(*model);
    }
  }
}

// The control: RK4 on the same systems, and an alpha that (34) does not hold for.
TYPED_TEST(GeneratingFunctionAlphaTest, OthersDoNot) {
  const auto rk4 = integrators().get("rk4", "integrator").make({});
  for (const ModelPointer& model : {relativistic(), bent_with(AlphaKind::mixed), coupled()})
    EXPECT_GT(structure_residual<TypeParam>(*rk4, model), 1e-9);
  for (int order = 1; order <= 4; ++order)
    EXPECT_GT(structure_residual<TypeParam>(*alpha_scheme(order), bent_with(AlphaKind::weighted)), 1e-9)
        << order;
}

// With the standard alpha the step is that of the scheme in the chart, whatever coordinates it is solved in;
// and a shear of w^ along w, or its sign, changes nothing.
TYPED_TEST(GeneratingFunctionAlphaTest, StandardAlphaIsTheChartsScheme) {
  for (int order = 1; order <= 7; ++order) {
    const auto method = alpha_scheme(order);
    const auto in_chart = integrators()
                              .get("generating-function", "integrator")
                              .make({{"order", std::to_string(order)}, {"variant", "P"}, {"extra", "0"}});
    const auto expected = steps<TypeParam>(*in_chart, bent_with(AlphaKind::standard), 10);
    for (const AlphaKind kind : {AlphaKind::standard, AlphaKind::sheared, AlphaKind::negative})
      EXPECT_LE(distance(steps<TypeParam>(*method, bent_with(kind), 10), expected),
                10 * step_round_off<TypeParam>)
          << order;
    EXPECT_GT(distance(steps<TypeParam>(*method, bent_with(AlphaKind::mixed), 10), expected), 1e-10) << order;
  }
}

TEST(GeneratingFunctionAlpha, HasItsOrder) {
  for (int order = 1; order <= 6; ++order)
    for (const ModelPointer& model :
         {relativistic(), bent_with(AlphaKind::mixed), bent_with(AlphaKind::sheared), coupled()}) {
      const auto method = alpha_scheme(order);
      EXPECT_EQ(method->order(*model), order);
      const MeasuredOrder measured = measure_order(*method, model);
      EXPECT_TRUE(measured.reason.empty()) << measured.reason;
      EXPECT_NEAR(measured.slope, order, 0.1) << model->name();
    }
}

TEST(GeneratingFunctionAlpha, GainsAnOrderWhereNothingDependsOnTime) {
  const ModelPointer free = relativistic({{"nu", "0"}});
  for (int order = 1; order <= 5; order += 2) {
    const auto method = alpha_scheme(order);
    EXPECT_EQ(method->order(*free), order + 1);
    EXPECT_NEAR(measure_order(*method, free).slope, order + 1, 0.1);
    const auto claims = method->preserves(*free), damped = method->preserves(*relativistic());
    EXPECT_EQ(std::count(claims.begin(), claims.end(), Claim::symmetric), 1);
    EXPECT_EQ(std::count(damped.begin(), damped.end(), Claim::symmetric), 0);
  }
  EXPECT_FALSE(check_generating_map(*bent_with(AlphaKind::sheared)).symmetric);
}

TEST(GeneratingFunctionAlpha, WrongAlphasAreRefused) {
  const auto refusal = [](const Model& model) { return alpha_scheme(2)->refuses(model); };
  const auto expect = [&](const Model& model, const std::string& said) {
    const std::string text = refusal(model);
    EXPECT_NE(text.find(said), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos);
  };
  expect(*bent_with(AlphaKind::negative), "bent: alpha: alpha_*^T J alpha_* is -1 times diag(K, -K0)");
  expect(*bent_with(AlphaKind::negative), "change the sign of w_hat");
  expect(*bent_with(AlphaKind::weighted),
         "bent: alpha: alpha_*^T J alpha_* is not diag(K, -K0): block (new, new): A^T C - C^T A must be "
         "K(z', t)");
  expect(*systems().get("kepler", "system").make({}), "needs vector-field, generating-map");
  expect(*systems().get("kepler", "system").make({}), "write alpha(t, t0, new_z, old_z, w_hat, w)");
}

// w = y' - y cannot tell states apart that are mapped to themselves: (34) holds and (37) does not.
struct Displacements : testing::Bent {
  template <class T>
  void alpha(const T& t, const T& t0, In<T> new_z, In<T> old_z, Out<T> w_hat, Out<T> w) const {
    const T new_p = momentum<T>(t, new_z), old_p = momentum<T>(t0, old_z);
    w_hat[0] = -(new_z[0] + old_z[0]) / 2;
    w_hat[1] = -(new_p + old_p) / 2;
    w[0] = new_p - old_p;
    w[1] = old_z[0] - new_z[0];
  }
};
TEST(GeneratingFunctionAlpha, TransversalityIsNeeded) {
  const auto model = make_model(
      {.name = "displacements", .title = "", .reference = "", .initial = {1, 0.5_r}}, Displacements{});
  EXPECT_NE(alpha_scheme(2)->refuses(*model).find("(C + D) is singular"), std::string::npos)
      << alpha_scheme(2)->refuses(*model);
  auto z = initial_state<double>(*model);
  std::int64_t completed = 0;
  EXPECT_NE(alpha_scheme(2)->stepper(model, 0.0)->advance(0.0, 0, 0.1, 1, z, completed), Status::converged);
  EXPECT_EQ(z, initial_state<double>(*model));
}

struct Unwritten : testing::Bent {
  template <class T>
  void alpha(const T& /*t*/, const T& /*t0*/, In<T> new_z, In<T> old_z, Out<T> w_hat, Out<T> w) const {
    w_hat[0] = new_z[1] - old_z[1];
    w_hat[1] = old_z[0] - new_z[0];
    w[0] = new_z[0];
  }
};
TEST(GeneratingFunctionAlpha, ResultsThatAreNotWrittenAreNamed) {
  try {
    (void)make_model({.name = "short", .title = "", .reference = "", .initial = {1, 0.5_r}}, Unwritten{});
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "system short: alpha(t, t0, new_z, old_z, w_hat, w) does not write result 4; expected 4");
  }
}

// Components pass through 0 in thousands of steps, and start there.
TEST(GeneratingFunctionAlpha, LongRunsSolveEveryStep) {
  for (const int order : {1, 4, 6})
    for (const std::vector<double>& start : {std::vector<double>{0.5, 0}, {0, 0.4}, {1, -0.5}}) {
      const auto model = relativistic({{"nu", "0"}});
      (void)after_steps(*alpha_scheme(order), model, 0.05, 4000, start);
    }
}

// From a speed of 0.999 a step of 3 finds no state; what was reached is kept.
TEST(GeneratingFunctionAlpha, StepsThatFailSaySo) {
  const auto model = relativistic();
  std::vector<double> z{5, 0.999};
  std::int64_t completed = 0;
  EXPECT_NE(alpha_scheme(4)->stepper(model, 0.0)->advance(0.0, 0, 3.0, 5, z, completed), Status::converged);
  EXPECT_EQ(completed, 0);
  EXPECT_EQ(z, (std::vector<double>{5, 0.999}));
}

}  // namespace
}  // namespace pfaff
