// Bodies that attract each other: against sums over pairs, the same system as text, circles that turn and the
// eight of three bodies.
#include <gtest/gtest.h>

#include <filesystem>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/systems/text/text_system.hpp>

#include "../formula_values.hpp"
#include "samples.hpp"
#include "taylor_flow.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

std::shared_ptr<const Model> as_text(const Assignments& set = {}) {
  return system_named(
             (std::filesystem::path(PFAFF_GOLDEN) / "../../examples/models/outer-solar-system.toml").string())
      .make(set);
}
// The largest difference of components, each relative to its own size.
template <class T>
double componentwise_distance(const std::vector<T>& a, const std::vector<T>& b) {
  double worst = 0;
  for (std::size_t k = 0; k < b.size(); ++k)
    if (b[k] != T(0)) worst = std::max(worst, static_cast<double>(abs(a[k] - b[k]) / abs(b[k])));
  return worst;
}

// A planet pulls the Sun with 1e-9 of the pull of the Sun on others, so that components are compared one by
// one, at the start, where no two pulls cancel.
TEST(OuterSolarSystem, IsItsTextWrittenInCpp) {
  const auto text = as_text(), ours = model_named("outer-solar-system");
  const Numbers z = initial_state(*ours);
  EXPECT_EQ(distance(z, initial_state(*text)), 0);
  EXPECT_LT(
      componentwise_distance(evaluated(ours, Formula::field, z, 36), evaluated(text, Formula::field, z, 36)),
      1e-31);
  const std::vector<double> rounded(z.begin(), z.end());
  EXPECT_LT(componentwise_distance(evaluated(ours, Formula::field, rounded, 36),
                                   evaluated(text, Formula::field, rounded, 36)),
            1e-13);
  const auto heavier = as_text({{"pluto", "7.7e-9"}});
  EXPECT_GT(componentwise_distance(evaluated(ours, Formula::field, z, 36),
                                   evaluated(heavier, Formula::field, z, 36)),
            1e-4);
}

// The energy that is printed with figure I.2.4 is 3.2e-8 in size; angular momentum is mostly Jupiter's.
TEST(OuterSolarSystem, HasTheEnergyOfTheBook) {
  const auto model = model_named("outer-solar-system");
  const Numbers kept = evaluated(model, Formula::invariants, initial_state(*model), 7);
  EXPECT_NEAR(static_cast<double>(kept[0]), -3.215e-8, 0.001e-8);
  EXPECT_EQ(model->invariants()[6].name, "angular-momentum-z");
  const Numbers z = initial_state(*model);
  const Quad jupiter = z[1] * z[25] - z[7] * z[19];
  EXPECT_GT(static_cast<double>(jupiter / kept[6]), 0.5);
}

TEST(NBody, ForcesAreSumsOverPairs) {
  const std::size_t n = 19;  // more pairs than fit any block of registers, and an odd number
  const auto model = model_named(
      "n-body",
      {{"bodies", "19"}, {"dimension", "3"}, {"gravitation", "0.7"}, {"softening", "0.2"}, {"seed", "5"}});
  const Numbers q = initial_state(*model);
  Numbers expected(3 * n, Quad(0));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      if (i == j) continue;
      Quad square = Real::fraction(1, 25).quad();
      for (std::size_t x = 0; x < 3; ++x)
        square += (q[x * n + j] - q[x * n + i]) * (q[x * n + j] - q[x * n + i]);
      for (std::size_t x = 0; x < 3; ++x)
        expected[x * n + i] +=
            Real::fraction(7, 3610).quad() * (q[x * n + j] - q[x * n + i]) / (square * sqrt(square));
    }
  EXPECT_LT(distance(evaluated(model, Formula::force, q, 3 * n), expected), 1e-32);
  const std::vector<double> rounded(q.begin(), q.end());
  const auto in_double = evaluated(model, Formula::force, rounded, 3 * n);
  EXPECT_LT(distance(Numbers(in_double.begin(), in_double.end()), expected), 1e-15);
}

// Seed 0: every body stays on the circle and goes round at one rate.
TEST(NBody, CirclesTurnWithoutChange) {
  for (const Assignments& set : {Assignments{}, Assignments{{"bodies", "2"}, {"gravitation", "3"}},
                                 Assignments{{"bodies", "5"}, {"dimension", "3"}, {"softening", "0.5"}}}) {
    const auto model = model_named("n-body", set);
    const Numbers start = initial_state(*model);
    const std::size_t half = start.size() / 2;
    const std::size_t n = model->invariants().size() == 4 ? half / 2 : half / 3;
    const Quad rate = start[half + n] * Quad(static_cast<double>(n)), time(1);  // y' of the body at (1, 0)
    Numbers turned(start.size(), Quad(0));
    for (std::size_t at : {std::size_t{0}, half})
      for (std::size_t i = at; i < at + n; ++i) {
        turned[i] = cos(rate * time) * start[i] - sin(rate * time) * start[n + i];
        turned[n + i] = sin(rate * time) * start[i] + cos(rate * time) * start[n + i];
      }
    EXPECT_LT(distance(taylor_flow(model->tape(Formula::field), Quad(0), start, time), turned), 1e-30);
    Numbers faster = start;
    faster[half + n] *= Quad(1) + Quad(1e-9);
    EXPECT_GT(distance(taylor_flow(model->tape(Formula::field), Quad(0), faster, time), turned), 1e-11);
  }
}

// The eight of chenciner-montgomery2000, section 1: unit masses, which are thirds of ours with thrice the
// attraction. Its state is printed to eight digits.
TEST(NBody, ThreeBodiesGoRoundTheEight) {
  const auto model = model_named("n-body", {{"gravitation", "3"}});
  const Quad x(0.97000436), y(-0.24308753), u(-0.93240737 / 3), v(-0.86473146 / 3);
  const Numbers start{x, -x,           Quad(0),      y, -y, Quad(0), -u / Quad(2), -u / Quad(2),
                      u, -v / Quad(2), -v / Quad(2), v};
  const auto field = model->tape(Formula::field);
  EXPECT_LT(distance(taylor_flow(field, Quad(0), start, Quad(6.32591398)), start), 1e-6);
  EXPECT_GT(distance(taylor_flow(field, Quad(0), start, Quad(6.32)), start), 1e-3);  // control
}

TEST(NBody, CloudsRestAndDifferBySeed) {
  const Assignments set{{"bodies", "20"}, {"dimension", "3"}, {"softening", "0.1"}, {"seed", "1"}};
  const auto model = model_named("n-body", set);
  const Numbers kept = evaluated(model, Formula::invariants, initial_state(*model), 7);
  for (std::size_t k = 1; k < 4; ++k) EXPECT_LT(static_cast<double>(abs(kept[k])), 1e-32);
  Assignments other = set;
  other.back().second = "2";
  EXPECT_GT(distance(initial_state(*model_named("n-body", other)), initial_state(*model)), 0.1);
}

}  // namespace
