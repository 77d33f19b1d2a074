// The heavy top, and rigid bodies that relax or lose energy, against closed forms.
#include <gtest/gtest.h>

#include <pfaff/core/system.hpp>

#include "../formula_values.hpp"
#include "taylor_flow.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

Quad artanh(Quad x) { return log((Quad(1) + x) / (Quad(1) - x)) / Quad(2); }

TEST(HeavyTop, WithoutGravityIsTheFreeRigidBody) {
  const Assignments moments{{"i1", "2"}, {"i2", "1.5"}, {"i3", "0.7"}};
  const auto body = model_named("free-rigid-body", moments);
  Assignments set = moments;
  set.emplace_back("gravity", "0");
  set.emplace_back("c1", "0.3");
  const Numbers start{ratio(2, 5), ratio(-1, 5), ratio(1), ratio(3, 5), Quad(0), ratio(4, 5)};
  Numbers from(start.begin(), start.begin() + 3);
  from.push_back(Quad(0));
  Numbers turned = taylor_flow(model_named("heavy-top", set), start, ratio(5, 2));
  turned.resize(3);  // the momenta, without the direction of gravity
  EXPECT_LE(distance(turned, values(body->tape(Formula::exact_solution), ratio(5, 2), from)),
            taylor_tolerance);
}

// Omega = P Gamma + s e_3 with Pi_3 = I_1 P cos th + g c_3/P: Gamma and Pi turn about the axis at the rate
// -s.
TEST(HeavyTop, PrecessesRegularly) {
  const auto top = model_named("heavy-top");  // I = (2, 2, 1), g c_3 = 1
  const Quad precession = ratio(2, 5), sine = ratio(3, 5), cosine = ratio(4, 5), i1(2), i3(1);
  const Quad axial = i1 * precession * cosine + Quad(1) / precession, spin = axial / i3 - precession * cosine;
  const auto at = [&](Quad t) {
    const Quad c = cos(spin * t), s = sin(spin * t);
    return Numbers{
        i1 * precession * sine * c, -(i1 * precession * sine * s), axial, sine * c, -(sine * s), cosine};
  };
  EXPECT_LE(distance(taylor_flow(top, at(Quad(0)), ratio(7, 2)), at(ratio(7, 2))), taylor_tolerance);
  Numbers other = at(Quad(0));  // the control: with another spin it nods
  other[2] += ratio(1, 10);
  EXPECT_GT(distance({taylor_flow(top, other, ratio(7, 2))[5]}, {cosine}), 1e-3);
}

TEST(HeavyTop, KeepsTheAxialMomentumOnlyWhereItIsSymmetric) {
  EXPECT_EQ(model_named("heavy-top")->invariants().size(), 4U);
  EXPECT_EQ(model_named("heavy-top", {{"i2", "3"}})->invariants().size(), 3U);
  EXPECT_EQ(model_named("heavy-top", {{"c2", "0.1"}})->invariants().size(), 3U);
}

struct Symmetric {
  Quad i = Quad(2), j = Quad(1), alpha = ratio(1, 5);
  Numbers start{ratio(9, 10), ratio(1, 5), ratio(3, 5)};
  [[nodiscard]] Quad d() const { return Quad(1) / i - Quad(1) / j; }
  [[nodiscard]] Quad square() const { return start[0] * start[0] + start[1] * start[1]; }
  // The state with this z_3, the others of length `across`, turned by `phase`.
  [[nodiscard]] Numbers state(Quad z3, Quad across, Quad phase) const {
    const Quad scale = across / sqrt(square()), c = cos(phase) * scale, s = sin(phase) * scale;
    return {start[0] * c - start[1] * s, start[1] * c + start[0] * s, z3};
  }
};
const Assignments moments{{"i1", "2"}, {"i2", "2"}, {"i3", "1"}};

// z_3^2 = 2 E J/(1 + c e^{-4 E alpha d t}); z_1 + i z_2 turns at the rate d z_3.
TEST(RelaxingRigidBody, FollowsItsClosedFormWhereItIsSymmetric) {
  const Symmetric body;
  const Quad twice = body.square() / body.i + body.start[2] * body.start[2] / body.j;  // 2 E
  const Quad top = twice * body.j, c = top / (body.start[2] * body.start[2]) - Quad(1);
  for (const Quad t : {ratio(1), ratio(6)}) {
    const Quad z3 = sqrt(top / (Quad(1) + c * exp(Quad(-2) * twice * body.alpha * body.d() * t)));
    const Quad across = sqrt(body.i * (twice - z3 * z3 / body.j)), root = sqrt(top);
    const Quad phase = (artanh(z3 / root) - artanh(body.start[2] / root)) * sqrt(body.j / twice) / body.alpha;
    EXPECT_LE(distance(taylor_flow(model_named("relaxing-rigid-body", moments), body.start, t),
                       body.state(z3, across, phase)),
              taylor_tolerance);
  }
}

// z_3^2 = C^2/(1 + c e^{-2 alpha d C^2 t}); z_1 + i z_2 turns at the rate d z_3.
TEST(DampedRigidBody, FollowsItsClosedFormWhereItIsSymmetric) {
  const Symmetric body;
  const Quad casimir = body.square() + body.start[2] * body.start[2];
  const Quad c = casimir / (body.start[2] * body.start[2]) - Quad(1), root = sqrt(casimir);
  for (const Quad t : {ratio(1), ratio(6)}) {
    const Quad z3 = sqrt(casimir / (Quad(1) + c * exp(Quad(-2) * body.alpha * body.d() * casimir * t)));
    const Quad phase = (artanh(z3 / root) - artanh(body.start[2] / root)) / (body.alpha * root);
    EXPECT_LE(distance(taylor_flow(model_named("damped-rigid-body", moments), body.start, t),
                       body.state(z3, sqrt(casimir - z3 * z3), phase)),
              taylor_tolerance);
  }
}

TEST(RigidBodies, EndUpTurningAboutTheAxisOfTheLargestMoment) {
  for (const char* name : {"relaxing-rigid-body", "damped-rigid-body"}) {
    const auto model = model_named(name, {{"alpha", "2"}});  // I = (2, 1, 2/3)
    const Numbers start{ratio(1, 5), ratio(1, 2), ratio(9, 10)}, end = taylor_flow(model, start, Quad(60));
    const Quad size = sqrt(end[0] * end[0] + end[1] * end[1] + end[2] * end[2]);
    EXPECT_GT(abs(end[0]) / size, Quad(1) - Quad(1e-6)) << name;
    const auto undamped = model_named(name, {{"alpha", "0"}});
    const Numbers still = taylor_flow(undamped, start, Quad(20));
    EXPECT_LT(abs(still[0]) / size, Quad(1) - Quad(1e-3)) << name << ": the control";
  }
}

// What one conserves the other loses: energy at constant entropy, or the other way round.
TEST(RigidBodies, RelaxOrLoseEnergy) {
  const Numbers start{ratio(9, 10), ratio(1, 5), ratio(3, 5)};
  for (const char* name : {"relaxing-rigid-body", "damped-rigid-body"}) {
    const auto model = model_named(name);
    const auto list = model->tape(Formula::invariants);
    Numbers before = values(list, Quad(0), start);
    Numbers z = start;
    for (int k = 0; k < 5; ++k) {
      z = taylor_flow(model, z, Quad(1));
      const Numbers after = values(list, Quad(0), z);
      for (std::size_t i = 0; i < 2; ++i) {
        const Quad change = after[i] - before[i];
        switch (model->invariants()[i].behaviour) {
          case Behaviour::increasing:
            EXPECT_GT(change, Quad(1e-4));
            break;
          case Behaviour::decreasing:
            EXPECT_LT(change, Quad(-1e-4));
            break;
          default:
            EXPECT_LE(static_cast<double>(abs(change)), taylor_tolerance);
        }
      }
      before = after;
    }
  }
}

}  // namespace
