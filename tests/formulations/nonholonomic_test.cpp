// The motions of velocity constraints: Lagrange and d'Alembert's against published values and closed forms,
// and vakonomic motion beside it.
#include <gtest/gtest.h>

#include <pfaff/bench/runner/json.hpp>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/verify/skated_models.hpp>

#include "../formula_values.hpp"
#include "../golden_numbers.hpp"
#include "../systems/taylor_flow.hpp"
#include "rods.hpp"
#include "velocity_systems.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

template <class T>
void expect_near(const std::vector<T>& found, const std::vector<T>& expected, double tolerance) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k)
    EXPECT_LE(static_cast<double>(abs(found[k] - expected[k])), tolerance) << k;
}
// q'' along a field: the rate of H_p.
template <class T>
std::vector<T> acceleration(const Model& model, const T& t, const std::vector<T>& z,
                            const std::vector<T>& field) {
  const auto slopes = model.tape(Formula::hamiltonian_gradient);
  const auto n = static_cast<std::size_t>(model.dimension());
  Replay<T> rate(std::make_shared<const Tape>(
      record(static_cast<int>(2 * n), static_cast<int>(n / 2),
             [&](const Recorded& s, In<Recorded> x, Out<Recorded> out) {
               const auto along = directional_derivative(
                   *slopes, s, Recorded(1), x.first(n),
                   std::vector<Recorded>(x.begin() + static_cast<std::ptrdiff_t>(n), x.end()));
               std::copy(along.begin() + static_cast<std::ptrdiff_t>(n / 2), along.end(), out.begin());
             })));
  std::vector<T> point = z, out(n / 2);
  point.insert(point.end(), field.begin(), field.end());
  rate(t, point.data(), out.data());
  return out;
}

// Velocities and accelerations of four systems with 36 digits, from a symbolic elimination of the multipliers
// in the velocities.
TEST(Nonholonomic, AgreesWithTheGoldenRightHandSides) {
  const nlohmann::json cases = golden("J")["cases"];
  const std::vector<std::shared_ptr<const Model>> models{
      model_of<ContactOscillator>("contact"), model_of<KnifeEdge>("edge"), model_of<Snakeboard>("board"),
      model_of<ChaplyginSleigh>("sleigh")};
  for (std::size_t k = 0; k < models.size(); ++k) {
    SCOPED_TRACE(cases[k]["system"].get<std::string>());
    std::vector<Quad> z = numbers(cases[k]["q0"]);
    const std::vector<Quad> p = numbers(cases[k]["p0"]), expected = numbers(cases[k]["rhs (v,a)"]);
    z.insert(z.end(), p.begin(), p.end());
    std::vector<Quad> field =
        evaluated(motion(models[k], "nonholonomic"), Formula::field, z, z.size(), Quad(0));
    const std::vector<Quad> turned = acceleration(*models[k], Quad(0), z, field);
    std::copy(turned.begin(), turned.end(), field.begin() + static_cast<std::ptrdiff_t>(p.size()));
    expect_near(field, expected, 1e-31);  // numbers of order one, given with 36 digits
  }
}

// x'' = -y x' y' / (1 + y^2), y'' = 0, z'' = x' y' / (1 + y^2) on the surface z' = y x'.
template <class T>
void contact_particle_moves_as_in_closed_form() {
  const auto moving = motion(model_of<ContactParticle>("contact"), "nonholonomic");
  const std::vector<T> z{T(1) / T(3), T(2) / T(3), T(1), T(5) / T(7), T(-3) / T(2), T(10) / T(21)};
  const T y = z[1], d = T(1) + y * y;
  expect_near(evaluated(moving, Formula::field, z, z.size(), T(0)),
              {z[3], z[4], z[5], -y * z[3] * z[4] / d, T(0), z[3] * z[4] / d}, bound<T>);
}
TEST(Nonholonomic, MovesTheContactParticle) {
  contact_particle_moves_as_in_closed_form<double>();
  contact_particle_moves_as_in_closed_form<Quad>();
}

// Control: without reactions, or with reversed ones, the blade is left and the golden values are missed.
TEST(Nonholonomic, NeedsItsReactions) {
  const auto model = model_of<KnifeEdge>("knife edge");
  const std::vector<Quad> z{Quad(0), Quad(0), Quad(1), cos(Quad(1)), sin(Quad(1)), Quad(1) / Quad(3)};
  const auto held = evaluated(motion(model, "nonholonomic"), Formula::field, z, z.size(), Quad(0)),
             slopes = evaluated(model, Formula::hamiltonian_gradient, z, z.size(), Quad(0));
  const auto turn = [&](Quad share) {  // d/dt of A v with a share of the reactions
    std::vector<Quad> field = held;
    for (std::size_t k = 3; k < 6; ++k) field[k] = -slopes[k - 3] + share * (held[k] + slopes[k - 3]);
    const auto v = acceleration(*model, Quad(0), z, field);
    const Quad turning = (cos(z[2]) * z[3] + sin(z[2]) * z[4]) * slopes[5];
    return static_cast<double>(abs(sin(z[2]) * v[0] - cos(z[2]) * v[1] + turning));
  };
  EXPECT_LE(turn(Quad(1)), 1e-32);
  EXPECT_GT(turn(Quad(0)), 1);
  EXPECT_GT(turn(Quad(-1)), 1);
}

TEST(Nonholonomic, RefusesWhatItDoesNotMove) {
  const auto refusal = [](const char* formulation, const std::shared_ptr<const Model>& model) {
    return formulations().get(formulation, "formulation").refuses(*model);
  };
  const auto particle = model_of<ContactParticle>("contact");
  EXPECT_EQ(refusal("nonholonomic", particle), "");
  EXPECT_EQ(refusal("nonholonomic", model_of<OpenPendulum>("pendulum")),
            "formulation nonholonomic needs velocity-constraints; pendulum offers holonomic, constraints");
  for (const char* other : {"dirac", "simplified-dirac", "lmm", "ggl"})
    EXPECT_EQ(refusal(other, particle), "formulation " + std::string(other) +
                                            " makes no motion of velocity constraints, which contact has; "
                                            "expected nonholonomic or vakonomic");
  EXPECT_EQ(refusal("nonholonomic", motion(particle, "nonholonomic")),
            "formulation nonholonomic needs a system with constraints; contact offers vector-field, "
            "velocity-constraints");
}

// Holonomic constraints as constraints of velocities, disguised by a factor, move as Lagrange's multipliers
// move them, and vakonomic motion is the same whatever its multiplier is.
TEST(Nonholonomic, AgreesWithTheOtherMotionsWhereConstraintsAreIntegrable) {
  const auto disguised = model_of<DisguisedPendulum>("pendulum"), open = model_of<OpenPendulum>("open");
  // On the surface: q of length 1, v = p / 2 at a right angle to it.
  const std::vector<Quad> z{Quad(2) / Quad(7), Quad(3) / Quad(7), Quad(-6) / Quad(7),
                            Quad(3),           Quad(2),           Quad(2)};
  const auto free = motion(disguised, "nonholonomic"), vakonomic = motion(disguised, "vakonomic");
  const auto expected = evaluated(motion(open, "lmm"), Formula::field, z, z.size(), Quad(0));
  expect_near(evaluated(free, Formula::field, z, z.size(), Quad(0)), expected, 1e-32);
  const auto turned = acceleration(*disguised, Quad(0), z, expected);
  for (const int multiplier : {0, 1, -3}) {
    std::vector<Quad> shifted = z;
    for (std::size_t k = 0; k < 3; ++k) shifted[3 + k] += Quad(multiplier) * (Quad(2) + z[0]) * z[k];
    const auto field = evaluated(vakonomic, Formula::field, shifted, shifted.size(), Quad(0));
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LE(static_cast<double>(abs(field[k] - expected[k])), 1e-31) << k;
    expect_near(acceleration(*vakonomic, Quad(0), shifted, field), turned, 1e-30);
  }
}

// H_vak = ((p_x + y p_z)^2/(1 + y^2) + p_y^2)/2, that of the geodesics of the Heisenberg group.
TEST(Vakonomic, HasTheHamiltonianOfGeodesicsOnTheContactParticle) {
  const auto model = motion(model_of<ContactParticle>("contact"), "vakonomic");
  EXPECT_EQ(model->facets(),
            facets(Facet::vector_field, Facet::hamiltonian, Facet::darboux_chart, Facet::invariants));
  EXPECT_FALSE(model->restricted());
  const std::vector<Quad> z{Quad(1) / Quad(3), Quad(2) / Quad(3),  Quad(1),
                            Quad(5) / Quad(7), Quad(-3) / Quad(2), Quad(2)};
  const Quad along = z[3] + z[1] * z[5];
  expect_near(evaluated(model, Formula::hamiltonian, z, 1, Quad(0)),
              {(along * along / (Quad(1) + z[1] * z[1]) + z[4] * z[4]) / Quad(2)}, 1e-32);
  EXPECT_EQ(evaluated(model, Formula::invariants, z, 1, Quad(0)),
            evaluated(model, Formula::hamiltonian, z, 1, Quad(0)));
}

// z' = y x' along a trajectory, which is not the nonholonomic one that starts from the same state.
TEST(Vakonomic, KeepsTheConstraintsOfItsOwnVelocityAndIsAnotherMotion) {
  const auto particle = model_of<ContactParticle>("contact");
  const auto vakonomic = motion(particle, "vakonomic"), rolling = motion(particle, "nonholonomic");
  const std::vector<Quad> start{Quad(0), Quad(1) / Quad(2), Quad(0), Quad(1), Quad(1), Quad(1) / Quad(2)};
  // They leave the start with the same velocity and acceleration, since lambda = 0 there.
  const auto first = evaluated(vakonomic, Formula::field, start, start.size(), Quad(0));
  expect_near(acceleration(*vakonomic, Quad(0), start, first),
              acceleration(*particle, Quad(0), start,
                           evaluated(rolling, Formula::field, start, start.size(), Quad(0))),
              1e-32);
  const auto moved = taylor_flow(vakonomic->tape(Formula::field), Quad(0), start, Quad(1)),
             rolled = taylor_flow(rolling->tape(Formula::field), Quad(0), start, Quad(1));
  const auto velocity = evaluated(vakonomic, Formula::field, moved, moved.size(), Quad(1));
  EXPECT_LE(static_cast<double>(abs(velocity[2] - moved[1] * velocity[0])), 1e-30);
  EXPECT_LE(static_cast<double>(abs(rolled[5] - rolled[1] * rolled[3])), 1e-30);
  EXPECT_GT(static_cast<double>(abs(moved[5] - moved[1] * moved[3])), 0.01) << "p has left p = L_v";
  EXPECT_GT(static_cast<double>(abs(moved[0] - rolled[0])), 0.01);
  // x' sqrt(1 + y^2) is kept by nonholonomic motion, p_x and p_z by vakonomic motion, and not the other way.
  const auto slope = [](const std::vector<Quad>& q, const Quad& x_rate) {
    return Quad(x_rate * sqrt(Quad(1) + q[1] * q[1]));
  };
  EXPECT_LE(static_cast<double>(abs(slope(rolled, rolled[3]) - slope(start, start[3]))), 1e-30);
  EXPECT_GT(static_cast<double>(abs(slope(moved, velocity[0]) - slope(start, start[3]))), 0.01);
  EXPECT_LE(static_cast<double>(abs(moved[3] - start[3]) + abs(moved[5] - start[5])), 1e-30);
  EXPECT_GT(static_cast<double>(abs(rolled[3] - start[3])), 0.01);
}

// sqrt(1 + p^2) is not quadratic: its constrained Hamiltonian has no closed form.
struct Relativistic : ContactParticle {
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return sqrt(1 + p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  }
};
TEST(Vakonomic, RefusesHamiltoniansThatAreNotQuadratic) {
  EXPECT_EQ(
      formulations().get("vakonomic", "formulation").refuses(*model_of<Relativistic>("fast")),
      "formulation vakonomic needs a Hamiltonian that is quadratic in the momenta, of which it knows the "
      "constrained one in closed form; that of fast is not");
  for (const auto& model : skated_models())
    EXPECT_EQ(formulations().get("vakonomic", "formulation").refuses(*model), "");
}

}  // namespace
