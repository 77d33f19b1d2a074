// The particle in a tokamak against Lorentz's force in the field that is printed of it.
#include <gtest/gtest.h>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/system.hpp>

#include "../formula_values.hpp"
#include "taylor_flow.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::Numbers;
using pfaff::testing::taylor_flow;

const Numbers somewhere{Quad(0.8), Quad(0.5), Quad(-0.2)}, moving{Quad(0.01), Quad(-0.03), Quad(0.02)};

// he2015 section 4.2, q = 2: B = (-(2y + xz)/(2R^2), (2x - yz)/(2R^2), (R - 1)/(2R)).
Numbers printed_field(const Numbers& x) {
  const Quad square = x[0] * x[0] + x[1] * x[1], r = sqrt(square);
  return {-(Quad(2) * x[1] + x[0] * x[2]) / (Quad(2) * square),
          (Quad(2) * x[0] - x[1] * x[2]) / (Quad(2) * square), (r - Quad(1)) / (Quad(2) * r)};
}

// x'' at a position and a velocity, by central differences of x' along the motion. Momenta are v + A, where
// -A = H_p at p = 0.
Numbers acceleration(const std::shared_ptr<const Model>& model, const Numbers& x, const Numbers& v) {
  const auto field = make_evaluator<Quad>(model, Formula::field);
  Numbers z = x, out(6);
  z.resize(6, Quad(0));
  field.call(field.context, Quad(0), z.data(), out.data());
  for (std::size_t k = 0; k < 3; ++k) z[3 + k] = v[k] - out[k];
  const Quad h(1e-5);
  Numbers result(3, Quad(0));
  for (const int side : {1, -1}) {
    const Numbers moved = taylor_flow(model->tape(Formula::field), Quad(0), z, Quad(side) * h);
    field.call(field.context, Quad(0), moved.data(), out.data());
    for (std::size_t k = 0; k < 3; ++k) result[k] += Quad(side) * out[k] / (Quad(2) * h);
  }
  return result;
}

double off_lorentz(const Assignments& set) {
  const auto model = systems().get("tokamak-particle", "system").make(set);
  const Numbers b = printed_field(somewhere), a = acceleration(model, somewhere, moving);
  double worst = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    worst = std::max(worst, static_cast<double>(abs(a[k] - (moving[i] * b[j] - moving[j] * b[i]))));
  }
  return worst;
}

TEST(TokamakParticle, FeelsTheForceOfLorentz) {
  EXPECT_LT(off_lorentz({}), 1e-10);
  EXPECT_GT(off_lorentz({{"q", "2.001"}}), 1e-7);  // control: another field
}

TEST(TokamakParticle, StartsWithThePrintedVelocity) {
  const auto model = systems().get("tokamak-particle", "system").make({});
  Numbers z;
  for (const Real& x : model->initial()) z.push_back(x.quad());
  const auto field = make_evaluator<Quad>(model, Formula::field);
  Numbers out(6);
  field.call(field.context, Quad(0), z.data(), out.data());
  EXPECT_LT(static_cast<double>(abs(out[0])), 1e-30);
  EXPECT_NEAR(static_cast<double>(out[1]), 4.816e-4, 1e-18);
  EXPECT_NEAR(static_cast<double>(out[2]), -2.059e-3, 1e-18);
}

}  // namespace
