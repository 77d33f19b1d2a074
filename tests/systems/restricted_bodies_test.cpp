// Probes without mass: among n bodies, against bodies of next to no mass and the triangle of Lagrange, and in
// the frame that turns with two bodies, against the same motion at rest.
#include <gtest/gtest.h>

#include <filesystem>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/systems/canonical/planetary_flows.hpp>
#include <pfaff/systems/text/text_system.hpp>

#include "../formula_values.hpp"
#include "taylor_flow.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

std::shared_ptr<const Model> turning_frame() {
  return system_named(
             (std::filesystem::path(PFAFF_GOLDEN) / "../../examples/models/restricted-three-body.toml")
                 .string())
      .make({});
}

// Two probes among three bodies of which the first has a hundred times the mass, in any state.
const Assignments three_bodies{{"bodies", "3"}, {"central", "100"}, {"probes", "2"}, {"gravitation", "1.5"}};
Numbers some_start(const Model& model) {
  Numbers z = initial_state(model);
  for (std::size_t k = 0; k < z.size(); ++k) z[k] += ratio(static_cast<std::int64_t>(k % 5), 100);
  return z;
}

// Each flow for one probe against that of a fourth body of the mass 1e-40, which does not pull the others
// within quad; of that body the momentum is 1e-40 times the velocity.
TEST(RestrictedBodies, HaveThePartsOfABodyWhoseMassVanishes) {
  const auto model = model_named("restricted-n-body", three_bodies);
  const Quad tiny(1e-40);
  const PlanetaryBodies four{
      {Real::fraction(100, 102), Real::fraction(1, 102), Real::fraction(1, 102), Real(tiny)},
      Real::fraction(3, 2),
      2};
  const Numbers z = some_start(*model);
  ASSERT_EQ(z.size(), 20U);
  const auto flows = model->exact_flows<Quad>();
  for (const std::size_t part : {planetary::kepler, planetary::interaction})
    for (const int time : {1, 40}) {  // the latter are some turns of every body
      Numbers change(20);
      ASSERT_EQ(flows->change(part, Quad(time), z, change), Status::converged);
      for (std::size_t probe = 0; probe < 2; ++probe) {
        Numbers whole(16), expected(16);
        for (std::size_t row = 0; row < 4; ++row) {  // x, y, p_x, p_y
          for (std::size_t i = 0; i < 3; ++i) whole[4 * row + i] = z[3 * row + i];
          whole[4 * row + 3] = (row < 2 ? Quad(1) : tiny) * z[12 + 2 * row + probe];
        }
        ASSERT_EQ(four.part_flow<Quad>(part, Quad(time), whole, expected), Status::converged);
        for (std::size_t row = 0; row < 4; ++row) {
          for (std::size_t i = 0; i < 3; ++i)
            EXPECT_LT(abs(change[3 * row + i] - expected[4 * row + i]), Quad(1e-30)) << part << row << i;
          EXPECT_LT(abs(change[12 + 2 * row + probe] - expected[4 * row + 3] / (row < 2 ? Quad(1) : tiny)),
                    Quad(1e-29))
              << part << row << probe;
        }
      }
    }
}

// Two bodies on circles and a probe at the third corner of an equilateral triangle, which turns as it is.
TEST(RestrictedBodies, StayInTheTriangleOfLagrange) {
  const auto model = model_named("restricted-n-body", {{"bodies", "2"}, {"central", "50"}});
  Numbers z = initial_state(*model);
  const Quad c = ratio(1, 2), s = sqrt(Quad(3)) / 2;
  // What stands at `at`, x and y of the two bodies, as that of the corner; momenta by the masses.
  const auto corner = [&](const Numbers& of, std::size_t at, const Quad& first, const Quad& second) {
    const Quad x = of[at + 1] / second - of[at] / first, y = of[at + 3] / second - of[at + 2] / first;
    return Numbers{of[at] / first + c * x - s * y, of[at + 2] / first + s * x + c * y};
  };
  const auto probe_in_corner = [&](const Numbers& of) {
    const Numbers place = corner(of, 0, Quad(1), Quad(1)),
                  velocity = corner(of, 4, ratio(50, 51), ratio(1, 51));
    return Numbers{place[0], place[1], velocity[0], velocity[1]};
  };
  const Numbers probe = probe_in_corner(z);
  std::copy(probe.begin(), probe.end(), z.begin() + 8);
  const auto off = [&](const Numbers& start) {
    const Numbers end = taylor_flow(model->tape(Formula::field), Quad(0), start, Quad(2));
    return distance(Numbers(end.begin() + 8, end.end()), probe_in_corner(end));
  };
  EXPECT_LT(off(z), 1e-30);
  z[8] += Quad(1e-6);  // control
  EXPECT_GT(off(z), 1e-7);
}

TEST(RestrictedBodies, MayBeInOnePlace) {
  const auto model = model_named("restricted-n-body", three_bodies);
  Numbers z = some_start(*model), change(20);
  for (const std::size_t at : {12, 14, 16, 18}) z[at + 1] = z[at];
  const auto rate = evaluated(model, Formula::field, z, 20);
  for (const std::size_t at : {12, 14, 16, 18}) EXPECT_EQ(rate[at], rate[at + 1]);
  for (const std::size_t part : {0, 1})
    EXPECT_EQ(model->exact_flows<Quad>()->change(part, Quad(1), z, change), Status::converged);
}

// Forces and energies of which the motion as a whole has none are not offered.
TEST(RestrictedBodies, OfferNoEnergy) {
  EXPECT_EQ(model_named("restricted-n-body")->facets(),
            facets(Facet::vector_field, Facet::exact_flows, Facet::invariants));
  EXPECT_EQ(model_named("restricted-n-body", {{"softening", "0.1"}})->facets(),
            facets(Facet::vector_field, Facet::invariants));
}

// The state (x, y, p_x, p_y) at t = 1 on the orbit of Arenstorf, by mpmath: Gragg's extrapolated midpoint
// rule with 45 digits in the frame at rest, two bodies on circles, and turned back.
const Numbers at_one{Real::parse("0.3132845955561022429872592218313266")->quad(),
                     Real::parse("0.3480089746751416745725656901266595")->quad(),
                     Real::parse("-1.390625485953929996395828421197321")->quad(),
                     Real::parse("0.9866687096526583748706537658862799")->quad()};

TEST(RestrictedThreeBody, MovesAsAtRest) {
  const auto model = turning_frame();
  const Numbers start = initial_state(*model),
                end = taylor_flow(model->tape(Formula::field), Quad(0), start, Quad(1));
  // The start is 0.0064 from the lighter body, which multiplies roundings by some thousands.
  EXPECT_LT(distance(end, at_one), 1e-29);
  // By mpmath from positions and velocities of the turning frame.
  EXPECT_LT(static_cast<double>(abs(evaluated(model, Formula::invariants, start, 1)[0] -
                                    Real::parse("2.856412520209857845681631275548363")->quad())),
            1e-30);
}

// The period as it is printed in hairer-norsett-wanner1993 II.0, to 27 digits.
TEST(RestrictedThreeBody, TheOrbitOfArenstorfCloses) {
  const auto model = turning_frame();
  const Numbers start = initial_state(*model);
  const Quad period = Real::parse("17.0652165601579625588917206249")->quad();
  EXPECT_LT(distance(taylor_flow(model->tape(Formula::field), Quad(0), start, period), start), 1e-24);
}

// A probe of restricted-n-body among the same two bodies, whose frame is at rest.
TEST(RestrictedThreeBody, IsThatOfTwoBodiesAndAProbe) {
  const auto model = model_named("restricted-n-body", {{"bodies", "2"}, {"central", "987722529/12277471"}});
  const Quad mu = Real::parse("0.012277471")->quad(), rest = Quad(1) - mu;
  const Numbers probe = initial_state(*turning_frame());
  const Numbers start{-mu,        rest,      Quad(0),  Quad(0),  Quad(0),  Quad(0),
                      -mu * rest, mu * rest, probe[0], probe[1], probe[2], probe[3]};
  const Numbers end = taylor_flow(model->tape(Formula::field), Quad(0), start, Quad(1));
  const Quad c = cos(Quad(1)), s = sin(Quad(1));
  const Numbers turned{c * end[8] + s * end[9], c * end[9] - s * end[8], c * end[10] + s * end[11],
                       c * end[11] - s * end[10]};
  EXPECT_LT(distance(turned, at_one), 1e-29);
}

}  // namespace
