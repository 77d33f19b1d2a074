// Friction in formulations: the power that each of its forms takes from the energy, and where the forms
// coincide.
#include <gtest/gtest.h>

#include "off_the_surface.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

// <H, H>_D of the symmetric bracket, densely: v.Lambda v - w.(S^D)^-1 w with w = P Lambda v.
Quad dissipation(const Model& model, Quad t, const std::vector<Quad>& z) {
  const auto constraints = model.holonomic_constraints<Quad>();
  const std::size_t n = constraints->degrees(), count = constraints->count();
  EXPECT_EQ(constraints->place(t, In<Quad>(z).first(n), In<Quad>(z).subspan(n)), Status::converged);
  Matrix<Quad> p(count, n);
  for (std::size_t a = 0; a < n; ++a) {
    std::vector<Quad> unit(n), column(count);
    unit[a] = Quad(1);
    constraints->hidden_by_momentum(unit, column);
    for (std::size_t i = 0; i < count; ++i) p(i, a) = column[i];
  }
  const In<Quad> lambda = constraints->friction(), v = constraints->velocities();
  LU<Quad> lu(count);
  std::vector<Quad> w(count), x(count);
  Quad sum(0);
  for (std::size_t a = 0; a < n; ++a) sum += v[a] * lambda[a] * v[a];
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t a = 0; a < n; ++a) w[i] += p(i, a) * lambda[a] * v[a];
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j) {
      lu(i, j) = Quad(0);
      for (std::size_t a = 0; a < n; ++a) lu(i, j) = lu(i, j) + p(i, a) * lambda[a] * p(j, a);
    }
  EXPECT_TRUE(lu.factor());
  lu.solve(w.data(), x.data());
  for (std::size_t i = 0; i < count; ++i) sum -= w[i] * x[i];
  return sum;
}

TEST(Formulations, MetriplecticFrictionDissipatesByTheSymmetricDiracBracket) {
  const auto model = chain(golden_rods().drag);
  Points<Quad> at;
  for (const char* formulation : {"dirac", "simplified-dirac", "lmm", "ggl"})
    for (int k = 0; k < points; ++k) {
      const auto z = at.near(*model);
      const auto rate = [&](const char* form) {
        return Rates<Quad>(*model, field(motion(model, formulation, {{"friction-form", form}}), Quad(0), z),
                           Quad(0), z);
      };
      const Rates<Quad> none = rate("none"), metriplectic = rate("metriplectic"), stokes = rate("stokes");
      const Quad lost = dissipation(*model, Quad(0), z);
      EXPECT_GT(lost, Quad(0));
      EXPECT_LE(none.relative(metriplectic.energy_rate - none.energy_rate + lost), kept<Quad>);
      EXPECT_GT(none.relative(stokes.energy_rate - none.energy_rate + lost), 1e-3);
      // Neither form moves the hidden constraints.
      for (std::size_t i = 0; i < none.hidden_rates.size(); ++i) {
        EXPECT_LE(none.relative(metriplectic.hidden_rates[i] - none.hidden_rates[i]), kept<Quad>);
        EXPECT_LE(none.relative(stokes.hidden_rates[i] - none.hidden_rates[i]), kept<Quad>);
      }
    }
}

template <class T>
double difference_of_friction_forms(const std::vector<Real>& drag) {
  const auto model = chain(drag);
  Points<T> at;
  double worst = 0;
  for (int k = 0; k < points; ++k) {
    const auto z = at.near(*model);
    worst = std::max(worst, relative_distance<T>(
                                field(motion(model, "dirac", {{"friction-form", "metriplectic"}}), T(0), z),
                                field(motion(model, "dirac", {{"friction-form", "stokes"}}), T(0), z)));
  }
  return worst;
}
TEST(Formulations, FrictionFormsCoincideWhereItIsProportionalToMass) {
  std::vector<Real> drag = golden_rods().masses;
  for (Real& x : drag) x = x * 3 / 10;
  EXPECT_LE(difference_of_friction_forms<double>(drag), kept<double>);
  EXPECT_LE(difference_of_friction_forms<Quad>(drag), kept<Quad>);
  drag.back() = drag.back() + Real::fraction(1, 1000);  // the control
  EXPECT_GT(difference_of_friction_forms<Quad>(drag), 1e-7);
  EXPECT_GT(difference_of_friction_forms<Quad>(golden_rods().drag), 1e-3);
}

}  // namespace
