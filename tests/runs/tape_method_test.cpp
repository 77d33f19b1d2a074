// Methods whose step is a recorded formula: the numbers of the same step written as a struct, in every
// scalar, replayed and compiled.
#include <pfaff/runs/tape_method.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pfaff/core/native/compiled_model.hpp>
#include <pfaff/core/native/compiler.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/runs/asked_for.hpp>
#include <pfaff/runs/integrate.hpp>

namespace {
using namespace pfaff;

// z + h X(t, z), which counts one right-hand side; with memory, z + h times the sum of X and of the last one.
StepTape euler(const std::shared_ptr<const Model>& model, bool remembers) {
  const auto n = static_cast<std::size_t>(model->dimension()), kept = remembers ? n : 0;
  const auto field = model->tape(Formula::field);
  return {std::make_shared<const Tape>(record(static_cast<int>(n + kept + 1), static_cast<int>(n + kept),
                                              [&](const Recorded& t, In<Recorded> x, Out<Recorded> out) {
                                                const std::vector<Recorded> rate =
                                                    evaluate(*field, t, x.first(n));
                                                for (std::size_t i = 0; i < n; ++i) {
                                                  const Recorded all =
                                                      remembers ? rate[i] + x[n + i] : rate[i];
                                                  out[i] = x[i] + x[n + kept] * all;
                                                  if (remembers) out[n + i] = rate[i];
                                                }
                                              })),
          1, kept};
}

std::shared_ptr<const TapeMethod> method_of(bool compiled, bool remembers = false) {
  return std::make_shared<const TapeMethod>(
      TapeMethodStatement{{.name = "recorded-euler",
                           .title = "Euler",
                           .reference = "",
                           .order = 1,
                           .preserves = {Claim::none}},
                          {},
                          facets(Facet::vector_field),
                          compiled},
      [remembers](const std::shared_ptr<const Model>& model) { return euler(model, remembers); });
}

std::shared_ptr<const Model> kepler() { return system_asked_for("kepler").make({{"eccentricity", "0.3"}}); }

template <class T>
std::vector<T> after(const std::shared_ptr<const MethodInstance>& method, int steps) {
  Integration<T> run = integrate<T>(kepler(), method, T(Real::fraction(1, 8)));
  run.steps(steps).expect_reached();
  return {run.state().begin(), run.state().end()};
}

// The same by hand.
template <class T>
std::vector<T> by_hand(int steps, bool remembers = false) {
  const Problem<T> problem(kepler());
  auto z = problem.make_state(), rate = problem.make_state(), before = problem.make_state();
  for (std::size_t i = 0; i < z.size(); ++i) z[i] = T(problem.model()->initial()[i]), before[i] = T(0);
  for (int k = 0; k < steps; ++k) {
    problem.field(T(0), z, rate);
    for (std::size_t i = 0; i < z.size(); ++i)
      z[i] = z[i] + T(Real::fraction(1, 8)) * (remembers ? rate[i] + before[i] : rate[i]);
    before = rate;
  }
  return {z.begin(), z.end()};
}

// The field of Kepler's problem is compiled in C++ and recorded in the tape: a few roundings apart.
TEST(TapeMethod, TakesTheStepThatItsTapeSays) {
  const std::vector<double> one = after<double>(method_of(false), 3), other = by_hand<double>(3);
  EXPECT_THAT(one, ::testing::Pointwise(::testing::DoubleNear(1e-14), other));
  EXPECT_THAT(after<double>(method_of(false), 2),
              ::testing::Not(::testing::Pointwise(::testing::DoubleNear(1e-3), other)));
  const std::vector<Quad> quad = after<Quad>(method_of(false), 3), exact = by_hand<Quad>(3);
  for (std::size_t i = 0; i < quad.size(); ++i)
    EXPECT_LT(static_cast<double>(abs(quad[i] - exact[i])), 1e-32);
}

TEST(TapeMethod, KeepsItsMemoryBetweenSteps) {
  const std::vector<double> one = after<double>(method_of(false, true), 3), other = by_hand<double>(3, true);
  EXPECT_THAT(one, ::testing::Pointwise(::testing::DoubleNear(1e-14), other));
  EXPECT_THAT(one, ::testing::Not(::testing::Pointwise(::testing::DoubleNear(1e-3), by_hand<double>(3))));
}

TEST(TapeMethod, HasTheSameBitsCompiled) {
  if (native::compiler_version().empty()) GTEST_SKIP() << "there is no compiler here";
  EXPECT_EQ(after<double>(method_of(true), 5), after<double>(method_of(false), 5));
  EXPECT_EQ(after<double>(method_of(true, true), 5), after<double>(method_of(false, true), 5));
}

TEST(TapeMethod, CountsRightHandSidesAndIsRecordedOnceForEachModel) {
  int recorded = 0;
  const auto method = std::make_shared<const TapeMethod>(
      TapeMethodStatement{{.name = "counted", .title = "Euler", .reference = "", .order = 1},
                          {},
                          facets(Facet::vector_field)},
      [&](const std::shared_ptr<const Model>& model) {
        ++recorded;
        return euler(model, false);
      });
  const auto model = kepler();
  Integration<double> run = integrate<double>(model, method, 0.125);
  run.steps(7).expect_reached();
  EXPECT_EQ(run.counters().fields, 7);
  (void)integrate<double>(model, method, 0.25);
  EXPECT_EQ(recorded, 1);
  (void)integrate<double>(kepler(), method, 0.25);
  EXPECT_EQ(recorded, 2);
}
}  // namespace
