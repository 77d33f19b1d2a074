// Parts of a text model that are solved exactly, against the same parts written in C++.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/systems/text/text_system.hpp>

namespace {
using namespace pfaff;

std::shared_ptr<const Model> as_text(const Assignments& set = {}) {
  return system_named(
             (std::filesystem::path(PFAFF_GOLDEN) / "../../examples/models/henon-heiles.toml").string())
      .make(set);
}
std::shared_ptr<const Model> as_code(const Assignments& set = {}) {
  return systems().get("henon-heiles", "system").make(set);
}

// The largest difference of the changes, relative to the time of the flow, at states of order one.
template <class T>
double difference(const Model& a, const Model& b, const T& h) {
  const auto first = a.exact_flows<T>(), second = b.exact_flows<T>();
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  double worst = 0;
  for (int k = 0; k < 20; ++k) {
    std::vector<T> z(4), x(4), y(4);
    for (T& c : z) c = T(number(random));
    for (std::size_t part = 0; part < 2; ++part) {
      EXPECT_EQ(first->change(part, h, z, x), Status::converged);
      EXPECT_EQ(second->change(part, h, z, y), Status::converged);
      for (std::size_t i = 0; i < 4; ++i)
        worst = std::max(worst, std::abs(static_cast<double>(value_of(x[i]) - value_of(y[i]))) /
                                    std::abs(static_cast<double>(value_of(h))));
    }
  }
  return worst;
}

TEST(TextParts, ChangeTheStateAsTheirTwinsDo) {
  const Assignments set{{"lambda", "7/10"}};
  const auto text = as_text(set), code = as_code(set);
  EXPECT_EQ(text->part_names(), code->part_names());
  EXPECT_EQ(text->small_part(), code->small_part());
  for (const double h : {0.3, -0.7, 1e-9}) {
    // A few operations in another order; relative to h also where h is short.
    EXPECT_LT(difference<double>(*text, *code, h), 3e-15) << h;
    EXPECT_LT(difference<Quad>(*text, *code, Quad(h)), 3e-33) << h;
    EXPECT_GT(difference<double>(*as_text(), *code, h), 1e-2) << h;  // control: another strength
  }
}

// Derivatives by the time of a flow and by the state.
TEST(TextParts, HaveTheDerivativesOfTheirTwins) {
  using D = StepDual<Quad>;
  const auto text = as_text()->exact_flows<D>(), code = as_code()->exact_flows<D>();
  const D h = D::variable(Quad(0.4), 0);
  std::vector<D> z{D::variable(Quad(0.3), 1), D::variable(Quad(-0.2), 2), D(Quad(0.5)), D(Quad(0.1))}, x(4),
      y(4);
  for (std::size_t part = 0; part < 2; ++part) {
    ASSERT_EQ(text->change(part, h, z, x), Status::converged);
    ASSERT_EQ(code->change(part, h, z, y), Status::converged);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t d = 0; d < 3; ++d)
        EXPECT_LT(abs(x[i].derivative[d] - y[i].derivative[d]), Quad(1e-33)) << part << i << d;
  }
}

TEST(TextParts, AFlowThatIsNotFiniteIsToldByItsStatus) {
  const auto flows = as_text()->exact_flows<double>();
  std::vector<double> z{1e200, 1e200, 0, 0}, change(4);
  EXPECT_EQ(flows->change(1, 0.1, z, change), Status::non_finite);
}

}  // namespace
