// The systems with velocity constraints against reference values of 30 digits: initial states, accelerations,
// the flow over one unit of time, and the circle of a ball on a turntable.
#include <gtest/gtest.h>

#include <functional>

#include <pfaff/core/facets/problem.hpp>

#include "../formula_values.hpp"
#include "bead_rod_files.hpp"
#include "motion.hpp"
#include "multipliers.hpp"
#include "taylor_flow.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

Numbers joined(Numbers a, const Numbers& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}
Numbers part(const Numbers& x, std::size_t first, std::size_t count) {
  const auto begin = x.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

// Initial values have 36 digits of which quad keeps 34; series lose a few units in the last place.
constexpr double digits = 1e-32, series = 1e-30;

struct Golden {
  const char* system;
  const char* name;  // of the golden case
  // Our positions, velocities and accelerations in the coordinates of the golden values.
  std::function<void(Numbers& q, Numbers& v, Numbers& a)> translate = [](Numbers&, Numbers&, Numbers&) {};
};

// From the centre of mass to the contact point, 2/5 behind.
void to_contact_point(Numbers& q, Numbers& v, Numbers& a) {
  const Quad r = (2 * Quad(1)) / Quad(5), s = r * sin(q[2]), c = r * cos(q[2]);
  q[0] -= c, q[1] -= s;
  a[0] += a[2] * s + v[2] * v[2] * c, a[1] += v[2] * v[2] * s - a[2] * c;
  v[0] += v[2] * s, v[1] -= v[2] * c;
}

const std::vector<Golden>& golden_systems() {
  static const std::vector<Golden> list{
      {"contact-oscillator", "contact oscillator"},
      {"knife-edge", "knife edge on an incline"},
      {"snakeboard", "snakeboard"},
      {"sleigh", "Chaplygin sleigh, contact-point coordinates (M(q))", to_contact_point}};
  return list;
}
nlohmann::json golden_case(const std::string& name) {
  const auto file = golden("J");
  for (const auto& entry : file.at("cases"))
    if (entry.at("system") == name) return entry;
  ADD_FAILURE() << "no golden case " << name;
  return {};
}

// q, v and q'' at a state, in the golden coordinates.
std::array<Numbers, 3> observed(const Golden& c, const std::shared_ptr<const Tape>& field, const Numbers& z) {
  const std::size_t half = z.size() / 2;
  const Numbers rates = values(field, Quad(0), z);
  std::array<Numbers, 3> seen{part(z, 0, half), part(rates, 0, half), part(rates, 2 * half, half)};
  c.translate(seen[0], seen[1], seen[2]);
  return seen;
}

TEST(NonholonomicGolden, StartsAcceleratesAndFlows) {
  for (const Golden& c : golden_systems()) {
    SCOPED_TRACE(c.system);
    const auto entry = golden_case(c.name);
    const auto model = model_named(c.system);
    const auto field = std::make_shared<const Tape>(multiplier_field(*model));
    const auto [q, v, a] = observed(c, field, initial_state(*model));
    EXPECT_LE(distance(q, numbers(entry.at("q0"))), digits);
    EXPECT_LE(distance(joined(v, a), numbers(entry.at("rhs (v,a)"))), 10 * digits);
    const Numbers end = taylor_flow(field, Quad(0), initial_state(*model), Quad(1));
    const auto [q1, v1, a1] = observed(c, field, end);
    EXPECT_LE(distance(joined(q1, v1), numbers(entry.at("flow T=1 (q,v)"))), series);
    // Control: the state a millionth of a second earlier is another.
    const auto [q2, v2, a2] =
        observed(c, field, taylor_flow(field, Quad(0), initial_state(*model), Quad(1 - 1e-6)));
    EXPECT_GT(distance(joined(q2, v2), numbers(entry.at("flow T=1 (q,v)"))), 1e-8);
  }
}

TEST(NonholonomicGolden, TheFormulationIsTheMotionByMultipliers) {
  for (const SystemPlugin* plugin : systems().all()) {
    const auto model = plugin->make({});
    if (!model->nonholonomic()) continue;
    // The equations that this compares with are those of constraints of velocities alone.
    if (model->tape(Formula::constraints)->outputs.size() >
        model->tape(Formula::velocity_offsets)->outputs.size())
      continue;
    SCOPED_TRACE(plugin->name());
    const auto field = std::make_shared<const Tape>(multiplier_field(*model));
    const auto motion = motion_of(model);
    Numbers z = initial_state(*model);
    for (std::size_t k = 0; k < z.size(); ++k) z[k] += Quad(static_cast<int>(k % 3) + 1) / Quad(17);
    for (const Numbers& state : {initial_state(*model), z}) {
      const Numbers ours = values(motion->tape(Formula::field), Quad(0), state);
      EXPECT_LE(distance(ours, part(values(field, Quad(0), state), 0, z.size())), 1e-31);
    }
  }
}

TEST(NonholonomicGolden, ClosedFormsEndWhereTheFlowEnds) {
  for (const Golden& c : golden_systems()) {
    const auto model = model_named(c.system);
    if (!model->facets().has(Facet::exact_solution)) continue;
    SCOPED_TRACE(c.system);
    const auto expected = numbers(golden_case(c.name).at("flow T=1 (q,v)"));
    const auto field = std::make_shared<const Tape>(multiplier_field(*model));
    Numbers arguments = initial_state(*model), z(arguments.size());
    arguments.emplace_back(0);
    Problem<Quad>(model).exact_solution(Quad(1), arguments, z);
    const auto [q, v, a] = observed(c, field, z);
    EXPECT_LE(distance(joined(q, v), expected), series);
    std::vector<double> start(arguments.begin(), arguments.end()), end(z.size());
    Problem<double>(model).exact_solution(1.0, start, end);
    const auto [q2, v2, a2] = observed(c, field, Numbers(end.begin(), end.end()));
    EXPECT_LE(distance(joined(q2, v2), expected), 4e-15);  // some twenty roundings
  }
}

TEST(NonholonomicGolden, ABallOnATurntableRunsOnItsCircle) {
  const auto entry = golden_case("rolling homogeneous ball on a turntable, reduced");
  const auto model = model_named("rolling-ball"), motion = motion_of(model);
  const auto field = motion->tape(Formula::field);
  const Numbers start = initial_state(*model);
  const auto seen = [](const Numbers& z) { return Numbers{z[0], z[1], z[6], z[7]}; };  // mass 1
  EXPECT_LE(distance(seen(start), numbers(entry.at("x0 (x,y,vx,vy)"))), digits);
  const Numbers end = taylor_flow(field, Quad(0), start, Quad(3));
  EXPECT_LE(distance(seen(end), numbers(entry.at("exact"))), series);

  // It comes back to its place after the time 2 pi/(k Omega) = 2 pi 7/(2 9/10), the ball turned.
  const Quad period = Quad(70) / Quad(9) * (1.57079632679489661923132169163975144_r).quad() * Quad(2);
  const Numbers round = taylor_flow(field, Quad(0), start, period);
  EXPECT_LE(distance(seen(round), seen(start)), 1e-29);
  EXPECT_GT(distance(round, start), 0.1);

  // The energy is not kept, the moving energy is.
  const auto energy = [&](const Numbers& z) {
    return values(model->tape(Formula::hamiltonian), Quad(0), z)[0];
  };
  const auto moving = [&](const Numbers& z) {
    return values(model->tape(Formula::invariants), Quad(0), z)[0];
  };
  EXPECT_GT(static_cast<double>(abs(energy(end) - energy(start))), 0.05);
  EXPECT_LE(static_cast<double>(abs(moving(end) - moving(start))), 1e-31);
}

// The ball with Euler's angles (phi, theta, psi) for its attitude.
struct BallInAngles {
  static constexpr int dimension = 10, velocity_constraint_count = 2;
  static std::vector<Parameter> parameters() { return {}; }
  Real inertia = 0.4_r, omega = 0.9_r;
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    const T tilt = (z[9] - z[7] * cos(z[3])) / sin(z[3]);
    return (z[5] * z[5] + z[6] * z[6]) / 2 + (z[7] * z[7] + z[8] * z[8] + tilt * tilt) / (2 * inertia);
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    const T s = sin(q[2]), c = cos(q[2]), tilt = sin(q[3]);
    rows[0] = rows[6] = T(1);
    rows[1] = rows[2] = rows[5] = rows[7] = T(0);
    rows[3] = -s;
    rows[4] = tilt * c;
    rows[8] = c;
    rows[9] = tilt * s;
  }
  template <class T>
  void velocity_offsets(const T& /*t*/, In<T> q, Out<T> b) const {
    b[0] = omega * q[1];
    b[1] = -(omega * q[0]);
  }
};

// The path of the contact point depends on how the ball turns and not on what describes it.
TEST(NonholonomicGolden, TheBallRollsAlikeInEulersAngles) {
  const auto ball = model_named("rolling-ball");
  const auto angles =
      make_model(SystemDescriptor{.name = "ball-in-angles", .title = "", .reference = ""}, BallInAngles{});
  const Quad half = Quad(1) / Quad(2), i = Quad(2) / Quad(5), omega = Quad(9) / Quad(10);
  const Quad x = half, y = Quad(-3) / Quad(7), vx = Quad(2) / Quad(3), vy = Quad(1) / Quad(9);
  const Quad wx = omega * x - vy, wy = vx + omega * y, wz = Quad(5) / Quad(11);
  // A quaternion that is not of length 1; p_e = 4 I e'/|e|^2 with e' = w e/2.
  const Numbers e{half, Quad(1), Quad(-2) / Quad(3), Quad(1) / Quad(5)};
  Quad square(0);
  for (const Quad& part_of : e) square += part_of * part_of;
  const Numbers turned{-wx * e[1] - wy * e[2] - wz * e[3], wx * e[0] + wy * e[3] - wz * e[2],
                       -wx * e[3] + wy * e[0] + wz * e[1], wx * e[2] - wy * e[1] + wz * e[0]};
  Numbers z = joined({x, y}, e);
  z.push_back(vx), z.push_back(vy);
  for (const Quad& u : turned) z.push_back(Quad(2) * i * u / square);
  const Quad phi = Quad(1) / Quad(3), theta = Quad(6) / Quad(5), psi = Quad(-2);
  const Quad s = sin(phi), c = cos(phi);
  const Numbers other{x,
                      y,
                      phi,
                      theta,
                      psi,
                      vx,
                      vy,
                      i * wz,
                      i * (wx * c + wy * s),
                      i * (sin(theta) * (wx * s - wy * c) + wz * cos(theta))};
  for (const auto& [model, state] : {std::pair(ball, z), std::pair(angles, other)}) {
    EXPECT_LE(distance(values(model->tape(Formula::constraints), Quad(0), state), {Quad(0), Quad(0)}), 1e-32);
    const Numbers rates = values(std::make_shared<const Tape>(multiplier_field(*model)), Quad(0), state);
    const std::size_t n = state.size();
    const Quad k = omega * Quad(2) / Quad(7);
    EXPECT_LE(distance({rates[n], rates[n + 1]}, {-k * vy, k * vx}), 1e-31) << model->name();
  }
}

}  // namespace
