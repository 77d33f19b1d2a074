// Methods for velocity constraints against reference values of 36 digits, which were computed with 50 digits
// from the discrete Lagrangians and from M, without any of Pfaff's code: one step and ten steps of 0.1.
#include <gtest/gtest.h>

#include <pfaff/tests/integrators/nonholonomic_samples.hpp>

namespace pfaff {
namespace {
using namespace nonholonomic;

// Ten steps of numbers of order one round some hundred times, 1.1e-16 or 9.6e-35 each.
template <class T>
constexpr double bound = std::is_same_v<T, Quad> ? 1e-31 : 2e-14;

constexpr std::array<const char*, 2> lengths{"one_step", "ten_steps"};

template <class T>
std::vector<T> first(std::vector<T> list, std::size_t count) {
  list.resize(count);
  return list;
}
template <class T>
std::vector<T> last_half(const std::vector<T>& z) {
  return {z.begin() + static_cast<std::ptrdiff_t>(z.size() / 2), z.end()};
}

// The published methods carry p^-; a run sees the positions and the projected momentum.
template <class T>
void expect_projected(const char* name, const char* key) {
  const auto models = golden_models();
  const auto cases = golden_cases();
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const auto& entry = cases[k]["methods"].at(key);
    for (std::size_t i = 0; i < 2; ++i) {
      const auto z = after_steps(*method_named(name), models[k], T(Real::fraction(1, 10)), i == 0 ? 1 : 10,
                                 initial_state<T>(*models[k]));
      const auto expected = joined(first(numbers<T>(entry[lengths[i]]), z.size() / 2),
                                   numbers<T>(entry["projected p after one, ten"][i]));
      EXPECT_LE(distance(z, expected), bound<T>) << name << ' ' << models[k]->name() << ' ' << lengths[i];
    }
  }
}

TEST(NonholonomicGolden, DiscreteLagrangeDAlembert) {
  expect_projected<double>("dla", "dla state (q,p-)");
  expect_projected<Quad>("dla", "dla state (q,p-)");
}
TEST(NonholonomicGolden, GeometricNonholonomicIntegrator) {
  expect_projected<double>("gni", "gni state (q,p-)");
  expect_projected<Quad>("gni", "gni state (q,p-)");
}
template <class T>
void expect_lobatto_pairs() {
  const auto models = golden_models();
  const auto cases =
      nlohmann::json::parse(std::ifstream(PFAFF_GOLDEN "/nonholonomic_lobatto.json")).at("cases");
  ASSERT_EQ(cases.size(), models.size());
  for (std::size_t k = 0; k < cases.size(); ++k)
    for (const char* stages : {"2", "3", "4"})
      for (std::size_t i = 0; i < 2; ++i) {
        const auto z = after_steps(*method_named("nonholonomic-lobatto", {{"stages", stages}}), models[k],
                                   T(Real::fraction(1, 10)), i == 0 ? 1 : 10, initial_state<T>(*models[k]));
        EXPECT_LE(distance(z, numbers<T>(cases[k]["stages"][stages][lengths[i]])), bound<T>)
            << models[k]->name() << ' ' << stages << ' ' << lengths[i];
      }
}
TEST(NonholonomicGolden, LobattoPairs) {
  expect_lobatto_pairs<double>();
  expect_lobatto_pairs<Quad>();
}
TEST(NonholonomicGolden, TheTwoAreNotTheSame) {  // control
  const auto model = golden_models().front();
  const auto start = initial_state<Quad>(*model);
  EXPECT_GT(distance(after_steps(*method_named("dla"), model, Quad(0.1), 10, start),
                     after_steps(*method_named("gni"), model, Quad(0.1), 10, start)),
            1e-4);
}

template <class T>
void expect_mclachlan_perlmutter() {
  const auto models = golden_models();
  const auto cases = golden_cases();
  for (std::size_t k = 0; k < 3; ++k)  // those with a constant mass matrix
    for (std::size_t i = 0; i < 2; ++i) {
      const auto z = after_steps(*method_named("mclachlan-perlmutter"), models[k], T(Real::fraction(1, 10)),
                                 i == 0 ? 1 : 10, initial_state<T>(*models[k]));
      const auto found = joined(first(z, z.size() / 2), velocity(*models[k], z));
      const auto& entry = cases[k]["methods"].at("mclachlan-perlmutter state (q,v)");
      EXPECT_LE(distance(found, numbers<T>(entry[lengths[i]])), 5 * bound<T>)
          << models[k]->name() << ' ' << lengths[i];
    }
}
TEST(NonholonomicGolden, McLachlanPerlmutter) {
  expect_mclachlan_perlmutter<double>();
  expect_mclachlan_perlmutter<Quad>();
}

// The reference values start from v_{-1/2} = v0. At a state from outside the method takes p^- = p, which is
// M v_{-1/2} + h/2 f(q0). The velocity v_{k-1/2} between two positions is (q_k - q_{k-1})/h.
template <class T>
void expect_leap_frog() {
  const auto models = golden_models();
  const auto cases = golden_cases();
  const T h(Real::fraction(1, 10));
  for (std::size_t k = 0; k < 3; ++k) {
    auto start = initial_state<T>(*models[k]);
    const auto slopes = values(*models[k], Formula::hamiltonian_gradient, T(0), start);
    const std::size_t n = start.size() / 2;
    for (std::size_t i = 0; i < n; ++i) start[n + i] = start[n + i] - h / T(2) * slopes[i];
    for (std::size_t i = 0; i < 2; ++i) {
      const std::int64_t count = i == 0 ? 1 : 10;
      const auto m = method_named("nonholonomic-leap-frog");
      const auto z = after_steps(*m, models[k], h, count, start),
                 before = after_steps(*m, models[k], h, count - 1, start);
      auto found = first(z, n);
      for (std::size_t j = 0; j < n; ++j) found.push_back((z[j] - before[j]) / h);
      const auto& entry = cases[k]["methods"].at("nonholonomic leap-frog state (q_k,v_{k-1/2})");
      EXPECT_LE(distance(found, numbers<T>(entry[lengths[i]])), 20 * bound<T>)  // divided by h
          << models[k]->name() << ' ' << lengths[i];
      const auto expected_slip = std::is_same_v<T, Quad> ? 1e-32 : 1e-15;
      EXPECT_LE(slip(*models[k], T(0), z), expected_slip);
    }
  }
}
TEST(NonholonomicGolden, LeapFrog) {
  expect_leap_frog<double>();
  expect_leap_frog<Quad>();
}

// pi = X(q)^T p with the columns X of the reference values, written out.
template <class T>
std::vector<T> reduced_momenta(std::size_t system, const std::vector<T>& z) {
  if (system == 0) return {z[4], z[5] - z[1] * z[3]};
  if (system != 2) return {cos(z[2]) * z[3] + sin(z[2]) * z[4], z[5]};
  const T c = cos(z[4]);  // the snakeboard, with l = 1/2
  return {c * c * (cos(z[2]) * z[5] + sin(z[2]) * z[6]) - T(2) * sin(z[4]) * c * z[7], z[8], z[9]};
}
template <class T>
void expect_discrete_gradient(const Assignments& parameters, const char* key) {
  const auto models = golden_models();
  const auto cases = golden_cases();
  for (std::size_t k = 0; k < cases.size(); ++k)
    for (std::size_t i = 0; i < 2; ++i) {
      const auto z = after_steps(*method_named("nonholonomic-discrete-gradient", parameters), models[k],
                                 T(Real::fraction(1, 10)), i == 0 ? 1 : 10, initial_state<T>(*models[k]));
      const auto& entry = cases[k]["methods"].at(key);
      EXPECT_LE(
          distance(joined(first(z, z.size() / 2), reduced_momenta(k, z)), numbers<T>(entry[lengths[i]])),
          bound<T>)
          << models[k]->name() << ' ' << lengths[i];
    }
}
TEST(NonholonomicGolden, DiscreteGradient) {
  expect_discrete_gradient<double>({}, "energy-preserving gonzalez state (q,pi)");
  expect_discrete_gradient<Quad>({}, "energy-preserving gonzalez state (q,pi)");
}
TEST(NonholonomicGolden, MeanValueDiscreteGradient) {  // the reference values have 18 nodes
  const Assignments parameters{{"gradient", "mean-value"}, {"nodes", "18"}};
  expect_discrete_gradient<double>(parameters, "energy-preserving mean-value state (q,pi)");
  expect_discrete_gradient<Quad>(parameters, "energy-preserving mean-value state (q,pi)");
}
// Control: with multipliers the method is another one, near but not the same.
TEST(NonholonomicGolden, DiscreteGradientWithMultipliersIsAnotherMethod) {
  const auto models = golden_models();
  const auto cases = golden_cases();
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const auto z = after_steps(*method_named("nonholonomic-discrete-gradient", {{"form", "multipliers"}}),
                               models[k], Quad(Real::fraction(1, 10)), 10, initial_state<Quad>(*models[k]));
    const auto theirs =
        first(numbers<Quad>(cases[k]["methods"].at("energy-preserving gonzalez state (q,pi)")["ten_steps"]),
              z.size() / 2);
    EXPECT_LE(distance(positions(z), theirs), 3e-2) << models[k]->name();
    EXPECT_GT(distance(positions(z), theirs), 1e-5) << models[k]->name();
  }
}

}  // namespace
}  // namespace pfaff
