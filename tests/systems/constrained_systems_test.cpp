// Systems with constraints against closed forms of their motion and their brackets.
#include <gtest/gtest.h>

#include <pfaff/core/linear/matrix.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/runs/support/constraints.hpp>

#include "../formula_values.hpp"
#include "../formulations/rods.hpp"
#include "motion.hpp"
#include "samples.hpp"
#include "taylor_flow.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;
using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;

void expect_near(const Numbers& a, const Numbers& b, double tolerance = taylor_tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k)
    EXPECT_LE(static_cast<double>(abs(a[k] - b[k])),
              tolerance * std::max(1.0, abs(static_cast<double>(b[k]))))
        << k;
}

TEST(ConstrainedSystems, StartOnTheirConstraintsForAllParameters) {
  for (const char* name : {"spherical-pendulum", "sphere-particle", "torus-particle", "polar-double-pendulum",
                           "shaken-pendulum", "guiding-centre"}) {
    const SystemPlugin& plugin = systems().get(name, "system");
    Samples samples(44);
    for (int k = 0; k < 10; ++k) {
      const auto model = plugin.make(samples.parameters(plugin));
      ConstraintResiduals<Quad> residuals(*model);
      Numbers z = initial_state(*model), worst;
      residuals(Quad(0), z, worst);
      for (const Quad& x : worst) EXPECT_LE(static_cast<double>(x), 1e-31) << name;
      z[0] += ratio(1, 1000000);  // the control
      residuals(Quad(0), z, worst);
      EXPECT_GT(static_cast<double>(worst[0]), 1e-8) << name;
    }
  }
}

// At the angle with cosine 4/5 and sine 3/5 from the vertical: omega^2 = g/(l cos).
TEST(ConstrainedSystems, SphericalPendulumTurnsAsAConicalOne) {
  const auto motion =
      motion_of(model_named("spherical-pendulum", {{"mass", "1.5"}, {"length", "2"}, {"gravity", "9"}}));
  const Quad omega = sqrt(Quad(9) / (Quad(2) * ratio(4, 5))), radius = Quad(2) * ratio(3, 5),
             height = -ratio(8, 5);
  const auto at = [&](Quad t) {
    const Quad c = cos(omega * t), s = sin(omega * t), p = ratio(3, 2) * omega * radius;
    return Numbers{radius * c, radius * s, height, -p * s, p * c, Quad(0)};
  };
  expect_near(taylor_flow(motion, at(Quad(0)), ratio(17, 10)), at(ratio(17, 10)));
  Numbers other = at(Quad(0));  // the control: any other speed nods
  other[4] = other[4] * ratio(11, 10);
  EXPECT_GT(distance({taylor_flow(motion, other, ratio(17, 10))[2]}, {height}), 1e-3);
}

TEST(ConstrainedSystems, SphericalPendulumSwingsInAPlaneAsThePendulum) {
  const auto motion = motion_of(model_named("spherical-pendulum", {{"length", "1"}, {"gravity", "9"}}));
  const auto plane = model_named("pendulum", {{"omega", "3"}});
  const Numbers start{ratio(7, 5), ratio(-3, 2)};
  const auto lifted = [](const Numbers& swing) {
    const Quad s = sin(swing[0]), c = cos(swing[0]);
    return Numbers{s, Quad(0), -c, swing[1] * c, Quad(0), swing[1] * s};
  };
  for (const Quad t : {ratio(1, 2), ratio(3)}) {
    Numbers from = start;
    from.push_back(Quad(0));
    expect_near(taylor_flow(motion, lifted(start), t),
                lifted(values(plane->tape(Formula::exact_solution), t, from)));
  }
}

TEST(ConstrainedSystems, TorusHasItsEquatorsAndMeridiansAsGeodesics) {
  const auto motion = motion_of(model_named("torus-particle", {{"mass", "2"}}));  // R = 2, r = 1
  const Quad speed = ratio(3, 4);
  for (const Quad radius : {Quad(3), Quad(1)}) {
    const auto at = [&](Quad t) {
      const Quad angle = speed * t / radius, c = cos(angle), s = sin(angle), p = Quad(2) * speed;
      return Numbers{radius * c, radius * s, Quad(0), -p * s, p * c, Quad(0)};
    };
    expect_near(taylor_flow(motion, at(Quad(0)), ratio(5, 2)), at(ratio(5, 2)));
  }
  const auto meridian = [&](Quad t) {
    const Quad c = cos(speed * t), s = sin(speed * t), p = Quad(2) * speed;
    return Numbers{Quad(2) + c, Quad(0), s, -p * s, Quad(0), p * c};
  };
  expect_near(taylor_flow(motion, meridian(Quad(0)), ratio(5, 2)), meridian(ratio(5, 2)));
  const auto parallel = [&](Quad t) {  // the control: the parallel on top is no geodesic
    const Quad angle = speed * t / Quad(2), c = cos(angle), s = sin(angle), p = Quad(2) * speed;
    return Numbers{Quad(2) * c, Quad(2) * s, Quad(1), -p * s, p * c, Quad(0)};
  };
  EXPECT_GT(distance(taylor_flow(motion, parallel(Quad(0)), ratio(5, 2)), parallel(ratio(5, 2))), 1e-2);
}

// {q_i, p_j}_D = delta_ij - q_i q_j/|q|^2, {p_i, p_j}_D = -(q_i p_j - q_j p_i)/|q|^2, off the sphere too.
TEST(ConstrainedSystems, DiracBracketsOfTheSphereAreTheKnownOnes) {
  const auto model = model_named("sphere-particle", {{"mass", "1.5"}});
  Samples samples(45);
  for (int k = 0; k < 10; ++k) {
    const Numbers z = samples.state(*model, 0.3);
    const Matrix<Quad> rows(2, values(model->tape(Formula::constraint_gradients), Quad(0), z));
    const Matrix<Quad> pi(6, values(model->tape(Formula::poisson_tensor), Quad(0), z));
    const Matrix<Quad> x = pi * rows.transposed();
    const Matrix<Quad> d = pi - x * (inverse(rows * x) * (rows * pi));
    const Quad square = z[0] * z[0] + z[1] * z[1] + z[2] * z[2];
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const Quad delta(i == j ? 1 : 0);
        EXPECT_LE(abs(d(i, j)), Quad(1e-31));
        EXPECT_LE(abs(d(i, 3 + j) - (delta - z[i] * z[j] / square)), Quad(1e-31));
        EXPECT_LE(abs(d(3 + i, 3 + j) + (z[i] * z[3 + j] - z[j] * z[3 + i]) / square), Quad(1e-31));
      }
  }
}

// {x, y}_D = -1/b.
TEST(ConstrainedSystems, GuidingCentreHasThePlaneAsItsPhaseSpace) {
  const auto model = model_named("guiding-centre");
  Samples samples(46);
  for (int k = 0; k < 10; ++k) {
    const Numbers z = samples.state(*model, 0.3);
    const Matrix<Quad> rows(2, values(model->tape(Formula::constraint_gradients), Quad(0), z));
    const Matrix<Quad> pi(4, values(model->tape(Formula::poisson_tensor), Quad(0), z));
    const Matrix<Quad> x = pi * rows.transposed(), w = rows * x;
    const Quad field = Quad(1) + (z[0] * z[0] + z[1] * z[1]) / Quad(2);
    EXPECT_LE(abs(w(0, 1) - field), Quad(1e-31));
    const Matrix<Quad> d = pi - x * (inverse(w) * (rows * pi));
    EXPECT_LE(abs(d(0, 1) + Quad(1) / field), Quad(1e-31));
  }
}

// A particle of mass m, in units where b0 and k are divided by m, drifts as the guiding centre does, up to a
// multiple of m.
TEST(ConstrainedSystems, GuidingCentreIsTheLimitOfASmallMass) {
  const auto drift = model_named("guiding-centre", {{"b0", "1"}, {"b2", "0"}, {"k", "0.2"}});
  const Quad x(1), y = ratio(1, 2), rate = ratio(1, 5), time(1);
  const Numbers end =
      values(drift->tape(Formula::exact_solution), time, {x, y, -y / Quad(2), x / Quad(2), Quad(0)});
  const auto error = [&](const char* b0, const char* k) {
    const auto particle = model_named("magnetic-planar", {{"b0", b0}, {"b2", "0"}, {"k", k}});
    const Numbers z = taylor_flow(particle, {x, y, -rate * y, rate * x}, time);
    return distance({z[0], z[1]}, {end[0], end[1]});
  };
  const double coarse = error("10", "2"), fine = error("100", "20");
  EXPECT_LT(coarse, 0.1);
  EXPECT_NEAR(coarse / fine, 10, 1);
}

// From polar coordinates to Cartesian ones, bob by bob, positions then momenta.
Tape cartesian() {
  return record(8, 8, [](const Recorded&, Arguments z, Results out) {
    const Recorded s1 = sin(z[1]), c1 = cos(z[1]), s2 = sin(z[3]), c2 = cos(z[3]);
    const Recorded both_x = z[4] * s1 + z[5] / z[0] * c1, both_y = z[5] / z[0] * s1 - z[4] * c1;
    out[0] = z[0] * s1;
    out[1] = -(z[0] * c1);
    out[2] = out[0] + z[2] * s2;
    out[3] = out[1] - z[2] * c2;
    out[6] = z[6] * s2 + z[7] / z[2] * c2;
    out[7] = z[7] / z[2] * s2 - z[6] * c2;
    out[4] = both_x - out[6];
    out[5] = both_y - out[7];
  });
}

// r_k - l_k and (r_k^2 - l_k^2)/2 have the same level sets, so that Dirac's brackets are the same everywhere.
TEST(ConstrainedSystems, PolarDoublePendulumMovesAsTwoRodsInCartesianCoordinates) {
  const auto polar = motion_of(model_named("polar-double-pendulum"));
  const pfaff::testing::Rods rods{{1, 0.5_r}, {1, 0.8_r}, {}, 9.81_r};
  const auto model = pfaff::testing::model_of(rods);
  const auto map = std::make_shared<const Tape>(cartesian());
  const auto carried =
      std::make_shared<const Tape>(record(8, 8, [&](const Recorded& t, Arguments z, Results out) {
        const auto rate = evaluate(*polar->tape(Formula::field), t, z);
        const auto moved = directional_derivative(*map, t, Recorded(1), z, rate);
        std::copy(moved.begin(), moved.end(), out.begin());
      }));
  Samples samples(47);
  for (int k = 0; k < 10; ++k) {
    const Numbers z = samples.state(*polar, 0.2), image = values(map, Quad(0), z);
    const Numbers moved = values(carried, Quad(0), z);
    expect_near(moved, values(motion_of(model)->tape(Formula::field), Quad(0), image));
    EXPECT_GT(
        distance(moved, values(motion(model, "simplified-dirac")->tape(Formula::field), Quad(0), image)),
        1e-6);  // the control, as the state is off the surface
  }
}

TEST(ConstrainedSystems, PolarDoublePendulumKeepsAngularMomentumWithoutGravity) {
  const auto model = model_named("polar-double-pendulum", {{"gravity", "0"}});
  ASSERT_EQ(model->invariants().size(), 2U);
  const auto invariants = model->tape(Formula::invariants);
  const Numbers start = initial_state(*model);
  expect_near(values(invariants, Quad(0), taylor_flow(motion_of(model), start, Quad(1))),
              values(invariants, Quad(0), start));
  EXPECT_EQ(model_named("polar-double-pendulum")->invariants().size(), 1U);
}

// th'' = -(g - a w^2 cos w t)/l sin th, with q = s + l (sin th, -cos th).
TEST(ConstrainedSystems, ShakenPendulumIsAnAngleInAGravityThatVaries) {
  const Quad mass = ratio(3, 2), length(2), gravity(9), a = ratio(1, 4), w(5);
  const auto motion = motion_of(model_named(
      "shaken-pendulum",
      {{"mass", "1.5"}, {"length", "2"}, {"gravity", "9"}, {"amplitude", "0.25"}, {"frequency", "5"}}));
  const auto angle =
      std::make_shared<const Tape>(record(2, 2, [&](const Recorded& t, Arguments z, Results out) {
        const Real l = 2, g = 9;
        out[0] = z[1];
        out[1] = -((g - Real::fraction(25, 4) * cos(5 * t)) / l * sin(z[0]));
      }));
  const auto lifted = [&](const Numbers& swing, Quad t) {
    const Quad s = sin(swing[0]), c = cos(swing[0]), v = length * swing[1];
    return Numbers{length * s, a * cos(w * t) - length * c, mass * v * c,
                   mass * (v * s - a * w * sin(w * t))};
  };
  const Numbers start{ratio(3, 5), ratio(2, 5)};
  const Quad time = ratio(13, 10);
  expect_near(taylor_flow(motion, lifted(start, Quad(0)), time),
              lifted(taylor_flow(angle, Quad(0), start, time), time));
  const auto still =
      motion_of(model_named("shaken-pendulum", {{"mass", "1.5"}, {"length", "2"}, {"gravity", "9"}}));
  EXPECT_GT(distance(taylor_flow(still, lifted(start, Quad(0)), time),
                     taylor_flow(motion, lifted(start, Quad(0)), time)),
            1e-2);
}

// phi'' + 2 alpha phi' + beta^2 phi = 0 with alpha = beta = 2: phi = (phi_0 + (phi~_0 + alpha phi_0) t)
// e^-2t.
TEST(ConstrainedSystems, BaumgarteBringsAStateBackAtItsRate) {
  const auto model = model_named("spherical-pendulum");
  const auto damped = motion(model, "lmm", {{"baumgarte-alpha", "2"}, {"baumgarte-beta", "2"}});
  Numbers start = initial_state(*model);
  start[0] += ratio(1, 50);
  start[4] -= ratio(1, 30);
  const auto phi = model->tape(Formula::constraints);
  const Numbers before = values(phi, Quad(0), start);
  const Quad time = ratio(3, 2), decay = exp(Quad(-2) * time), slope = before[1] + Quad(2) * before[0];
  const Numbers after = values(phi, Quad(0), taylor_flow(damped, start, time));
  expect_near(after, {(before[0] + slope * time) * decay, (before[1] - Quad(2) * slope * time) * decay});
  EXPECT_GT(abs(before[1]), Quad(1e-3));
}

}  // namespace
