// Order conditions and zero-stability of linear multistep methods.
#include <gtest/gtest.h>

#include <pfaff/integrators/order_conditions/multistep_conditions.hpp>

namespace {
using namespace pfaff;

std::vector<Quad> over(int denominator, const std::vector<int>& numerators) {
  std::vector<Quad> list;
  for (const int n : numerators) list.push_back(Quad(n) / Quad(denominator));
  return list;
}

int multistep_order(const MultistepPolynomials& method, int most) {
  return order_shown(multistep_conditions(method, most), precision_of_quad_coefficients);
}

// hairer-norsett-wanner1993 III.1
const MultistepPolynomials adams_bashforth_4{over(1, {0, 0, 0, -1, 1}), over(24, {-9, 37, -59, 55, 0})};
const MultistepPolynomials adams_moulton_4{over(1, {0, 0, -1, 1}), over(24, {1, -5, 19, 9})};
const MultistepPolynomials leap_frog{over(1, {-1, 0, 1}), over(1, {0, 2, 0})};
const MultistepPolynomials milne_simpson{over(1, {-1, 0, 1}), over(3, {1, 4, 1})};
const MultistepPolynomials backward_2{over(2, {1, -4, 3}), over(1, {0, 0, 1})};
// III.3 there: of order 3, explicit, and not stable, with the roots 1 and -5.
const MultistepPolynomials unstable{over(1, {-5, 4, 1}), over(1, {2, 4, 0})};

TEST(MultistepConditions, GiveTheKnownOrders) {
  EXPECT_EQ(multistep_order(adams_bashforth_4, 7), 4);
  EXPECT_EQ(multistep_order(adams_moulton_4, 7), 4);
  EXPECT_EQ(multistep_order(leap_frog, 5), 2);
  EXPECT_EQ(multistep_order(milne_simpson, 7), 4);
  EXPECT_EQ(multistep_order(backward_2, 5), 2);
  EXPECT_EQ(multistep_order(unstable, 5), 3);
}

TEST(MultistepConditions, NameTheConditionThatAChangeOf1e9Violates) {
  MultistepPolynomials changed = adams_bashforth_4;
  changed.sigma[1] += Quad(1e-9);
  const auto conditions = multistep_conditions(changed, 4);
  const OrderCondition* first = first_violated(conditions, 4, precision_of_quad_coefficients);
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(first->name, "the sum of j rho_j - sigma_j = 0");
  EXPECT_LT(abs(first->residual + Quad(1e-9) / Quad(4)), Quad(1e-32));
  changed.rho[2] += Quad(1e-9);
  EXPECT_EQ(first_violated(multistep_conditions(changed, 4), 4, precision_of_quad_coefficients)->name,
            "the sum of rho_j = 0");
}

TEST(MultistepConditions, RootsAreFound) {
  // (x - 2) (x + 1/2) (x^2 + 1) = x^4 - 3/2 x^3 - 3/2 x - 1
  const auto roots = polynomial_roots({Quad(-1), Quad(-1.5), Quad(0), Quad(-1.5), Quad(1)});
  ASSERT_EQ(roots.size(), 4U);
  for (const auto& [real, imaginary] : {std::pair(2.0, 0.0), {-0.5, 0.0}, {0.0, 1.0}, {0.0, -1.0}}) {
    int found = 0;
    for (const ComplexQuad& z : roots)
      found += abs(z.real - Quad(real)) < Quad(1e-30) && abs(z.imaginary - Quad(imaginary)) < Quad(1e-30);
    EXPECT_EQ(found, 1) << real << " " << imaginary;
  }
}

TEST(MultistepConditions, ZeroStabilityIsTheConditionOfTheRoots) {
  for (const auto& stable : {adams_bashforth_4, adams_moulton_4, leap_frog, milne_simpson, backward_2})
    EXPECT_EQ(instability(stable), "");
  EXPECT_NE(instability(unstable).find("of modulus 5, outside the unit circle"), std::string::npos)
      << instability(unstable);
  const MultistepPolynomials doubled{over(1, {1, -2, 1}), over(1, {0, 1, 0})};
  EXPECT_NE(instability(doubled).find("multiple root"), std::string::npos) << instability(doubled);
  // A root just outside is found, one just inside is allowed.
  const auto beside = [](const Quad& distance) {
    const Quad root = Quad(-1) - distance;  // (x - 1) (x - root)
    return MultistepPolynomials{{root, Quad(-1) - root, Quad(1)}, over(1, {0, 1, 0})};
  };
  EXPECT_NE(instability(beside(Quad(1e-9))), "");
  EXPECT_EQ(instability(beside(Quad(-1e-9))), "");
}

}  // namespace
