// The nonholonomic bracket: its flow against d'Alembert's principle with multipliers, solved densely from the
// derivatives of the Lagrangian and by no code of the bracket; its rank, Casimirs and Jacobiator.
#include <gtest/gtest.h>

#include <pfaff/brackets/conformance/residuals.hpp>
#include <pfaff/brackets/nonholonomic/nonholonomic_bracket.hpp>

#include "../formula_values.hpp"
#include "nonholonomic_samples.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

// |Pibar grad H - motion| at a constrained state.
template <class T, class S>
double flow_error(const S& system) {
  const auto model = make_model(descriptor, system);
  const NonholonomicBracket bracket(*model);
  double worst = 0;
  for (const int shift : {0, 3, -7}) {
    const auto z = bracket.projected(T(0), state<T>(static_cast<std::size_t>(model->dimension()), shift));
    const auto flow = bracket.tensor(T(0), z) * values(model->tape(Formula::hamiltonian_gradient), z);
    worst = std::max(worst, distance(flow, dalembert(system, z)));
  }
  return worst;
}

// Round-off of dense systems of up to 6 unknowns with entries about 10.
TEST(NonholonomicBracket, FlowIsDAlembertsMotion) {
  for (const int magnetic : {0, 1}) {
    EXPECT_LE(flow_error<double>(Curved{magnetic, 0}), 1e-12);
    EXPECT_LE(flow_error<Quad>(Curved{magnetic, 0}), 1e-30);
  }
  EXPECT_LE(flow_error<double>(ContactParticle{}), 1e-14);
  EXPECT_LE(flow_error<Quad>(ContactParticle{}), 1e-32);
  EXPECT_LE(flow_error<double>(Sleigh{}), 1e-14);
  EXPECT_LE(flow_error<Quad>(Sleigh{}), 1e-32);
  EXPECT_LE(flow_error<Quad>(Integrable{}), 1e-32);
  // Control: constraints with b != 0 do work, and no bracket of the energy gives their motion.
  EXPECT_GT(flow_error<Quad>(Curved{0, 1}), 1e-2);
}

// Controls of (41): the projector along the last coordinates in place of the orthogonal one, and -P in place
// of -P^T.
struct Oblique {
  Sleigh sleigh;
  template <class S>
  [[nodiscard]] MomentumProjector<S> at(const std::vector<S>& q) const {
    std::vector<S> rows(3);
    sleigh.velocity_constraints(S(0), In<S>(q), Out<S>(rows));
    return {oblique(std::vector{Covector<S>(rows)}).admissible(), Covector<S>(3)};
  }
};
TEST(NonholonomicBracket, NeedsTheOrthogonalProjectorAndItsTranspose) {
  const auto model = make_model(descriptor, Sleigh{});
  const NonholonomicBracket bracket(*model);
  const auto z = bracket.projected(Quad(0), state<Quad>(6, 1));
  const std::vector<Quad> q(z.begin(), z.begin() + 3), p(z.begin() + 3, z.end());
  const auto slopes = values(model->tape(Formula::hamiltonian_gradient), z), motion = dalembert(Sleigh{}, z);
  const auto wrong = pseudo_poisson_tensor<Quad>(Oblique{}, q, Covector<Quad>(p)) * slopes;
  for (std::size_t k = 0; k < 3; ++k) EXPECT_LE(abs(wrong[k] - motion[k]), Quad(1e-32));  // q' is right
  EXPECT_GT(distance(wrong, motion), 1e-2);
  Matrix<Quad> printed = bracket.tensor(Quad(0), z);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) printed(3 + i, j) = -printed(i, 3 + j);
  EXPECT_GT(static_cast<double>(largest(printed + printed.transposed())), 1e-2);
  EXPECT_LE(
      static_cast<double>(largest(bracket.tensor(Quad(0), z) + bracket.tensor(Quad(0), z).transposed())),
      1e-32);
}

// (40) with its last column, at p_z = y p_x.
TEST(NonholonomicBracket, ContactParticleInClosedForm) {
  const auto model = make_model(descriptor, ContactParticle{});
  const NonholonomicBracket bracket(*model);
  const Quad y = Quad(3) / Quad(5), px = Quad(7) / Quad(4), d = Quad(1) + y * y;
  const std::vector<Quad> z{Quad(1), y, Quad(2), px, Quad(-1) / Quad(3), y * px};
  Matrix<Quad> expected(6, 6);
  const auto set = [&](std::size_t i, std::size_t j, Quad x) {
    expected(i, j) = x;
    expected(j, i) = -x;
  };
  set(0, 3, Quad(1) / d);
  set(0, 5, y / d);
  set(1, 4, Quad(1));
  set(2, 3, y / d);
  set(2, 5, y * y / d);
  set(3, 4, -y * px / d);
  set(5, 4, px / d);
  EXPECT_LE(static_cast<double>(largest(bracket.tensor(Quad(0), z) - expected)), 1e-32);
  // The Jacobiator y/d^2 of (x, p_x, p_y) and -1/d^2 of (z, p_x, p_y), the largest as y < 1.
  const auto point = nonholonomic_point(*model, Quad(0), z);
  EXPECT_EQ(point.rank, 4U);
  EXPECT_EQ(point.jacobiator.coordinates, (std::array<std::size_t, 3>{2, 3, 4}));
  EXPECT_LE(abs(point.jacobiator.value + Quad(1) / (d * d)), Quad(1e-32));
  const auto slopes = bracket_slopes<Quad>(bracket, Quad(0), In<Quad>(z));
  const auto p = bracket.tensor(Quad(0), z);
  Quad sum(0);
  for (std::size_t l = 0; l < 6; ++l)
    sum += p(0, l) * slopes[l](3, 4) + p(3, l) * slopes[l](4, 0) + p(4, l) * slopes[l](0, 3);
  EXPECT_LE(abs(sum - y / (d * d)), Quad(1e-32));
}

TEST(NonholonomicBracket, RankCasimirsAndJacobi) {
  const auto at = [](const auto& system) {
    const auto model = make_model(descriptor, system);
    return nonholonomic_point(*model, Quad(0), state<Quad>(static_cast<std::size_t>(model->dimension()), 2));
  };
  const auto curved = at(Curved{1, 1}), sleigh = at(Sleigh{}), integrable = at(Integrable{});
  EXPECT_EQ(curved.rank, 4U);  // 2 (4 - 2)
  EXPECT_EQ(sleigh.rank, 4U);
  for (const auto* point : {&curved, &sleigh, &integrable}) {
    EXPECT_LE(point->casimirs, 1e-30);
    EXPECT_LE(point->one_forms, 1e-30);
  }
  EXPECT_GT(abs(curved.jacobiator.value), Quad(1e-3));
  EXPECT_GT(abs(sleigh.jacobiator.value), Quad(1e-3));
  EXPECT_LE(abs(integrable.jacobiator.value), Quad(1e-30));  // a holonomic constraint in disguise
  // Control: another function is no Casimir.
  const auto model = make_model(descriptor, Sleigh{});
  const NonholonomicBracket bracket(*model);
  const auto z = state<Quad>(6, 2);
  EXPECT_GT(casimir_residual<Quad>(bracket, Quad(0), In<Quad>(z),
                                   {Quad(0), Quad(0), Quad(1), Quad(0), Quad(0), Quad(0)})
                .relative(),
            1e-3);
}

// The sleigh's Hamiltonian bracket: of the speed u = p_x cos + p_y sin and of omega = p_theta / J it is
// r omega / (J + r^2), linear, so that the two move by the Hamiltonian equations u' = r omega^2,
// omega' = -r u omega / (J + r^2) of the energy (u^2 + (J + r^2) omega^2)/2.
TEST(NonholonomicBracket, ReducedBracketOfTheSleigh) {
  const auto model = make_model(descriptor, Sleigh{});
  const NonholonomicBracket bracket(*model);
  const auto z = bracket.projected(Quad(0), state<Quad>(6, 4));
  const Quad c = cos(z[2]), s = sin(z[2]), j(2), r = Quad(3) / Quad(4), omega = z[5] / j,
             u = z[3] * c + z[4] * s;
  const std::vector<Quad> du{Quad(0), Quad(0), z[4] * c - z[3] * s, c, s, Quad(0)},
      domega{Quad(0), Quad(0), Quad(0), Quad(0), Quad(0), Quad(1) / j};
  const auto tensor = bracket.tensor(Quad(0), z);
  EXPECT_LE(abs(paired(du, tensor, domega) - r * omega / (j + r * r)), Quad(1e-32));
  const auto slopes = values(model->tape(Formula::hamiltonian_gradient), z);
  EXPECT_LE(abs(paired(du, tensor, slopes) - r * omega * omega), Quad(1e-32));
  EXPECT_LE(abs(paired(domega, tensor, slopes) + r * u * omega / (j + r * r)), Quad(1e-32));
}

template <class S>
std::string refusal(const S& system) {
  try {
    (void)NonholonomicBracket(*make_model(descriptor, system));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}
// Two constraints that say the same where x = 0.
struct Dependent : Curved {
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    for (std::size_t k = 0; k < 8; ++k) rows[k] = T(1);
    rows[4] = T(1) + q[0];
  }
};
TEST(NonholonomicBracket, BadInputIsNamed) {
  EXPECT_EQ(
      refusal(NotQuadratic{}),
      "nonholonomic bracket: the Hamiltonian of system sample is not quadratic in the momenta; expected a "
      "kinetic energy with a mass matrix M(q)");
  EXPECT_THROW(NonholonomicBracket(*systems().get("pendulum", "system").make({})), InputError);
  const NonholonomicBracket bracket(*make_model(descriptor, Dependent{}));
  EXPECT_NO_THROW((void)bracket.projectors<double>(0, {1, 2, 3, 4}));
  try {
    (void)bracket.projectors<double>(0, {0, 2, 3, 4});
    FAIL() << "dependent constraints were accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "one-forms: row 2 (psi2) is a combination of row 1 (psi1); expected one-forms that are independent");
  }
}

}  // namespace
