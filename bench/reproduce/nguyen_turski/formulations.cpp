// Nguyen & Turski, section 4 and appendices A and B: constrained motion in Dirac's formulation and with
// Lagrange multipliers, beside the definition (1.2) written out with dense matrices in quad.
#include <cmath>

#include <pfaff/bench/reproduce/nguyen_turski/constrained_point.hpp>
#include <pfaff/bench/reproduce/nguyen_turski/rows.hpp>
#include <pfaff/core/facets/problem.hpp>

namespace pfaff::nguyen_turski {

namespace {
Numbers entries(const Matrix<Quad>& m) { return {m.entries().begin(), m.entries().end()}; }

// The tables' entries: diagonals c, couplings b of S or S^D, couplings a of A.
Matrix<Quad> tridiagonal(const Numbers& c, const Numbers& b, int sign) {
  Matrix<Quad> m(c.size(), c.size());
  for (std::size_t k = 0; k < c.size(); ++k) m(k, k) = c[k];
  for (std::size_t k = 0; k + 1 < c.size(); ++k) {
    m(k, k + 1) = b[k];
    m(k + 1, k) = Quad(sign) * b[k];
  }
  return m;
}
// Rods of a chain r_i - r_{i+1}; of a pendulum after r_1 itself.
Numbers rods(const Numbers& r, std::size_t d, bool pendulum) {
  Numbers rod;
  if (pendulum) rod.assign(r.begin(), r.begin() + static_cast<std::ptrdiff_t>(d));
  for (std::size_t k = 0; k + d < r.size(); ++k) rod.push_back(r[k] - r[k + d]);
  return rod;
}
Quad dot(const Numbers& a, std::size_t i, const Numbers& b, std::size_t j, std::size_t d) {
  Quad sum(0);
  for (std::size_t x = 0; x < d; ++x) sum += a[i * d + x] * b[j * d + x];
  return sum;
}

// With the factor 4 of the usual form taken out.
Quad lennard_jones_at_half() {
  const auto model = systems()
                         .get("chain-molecule", "system")
                         .make({{"beads", "3"}, {"dimension", "2"}, {"epsilon", "1/4"}, {"charge", "0"}});
  const Numbers z{0, 0, Quad(1) / 4, 1, Quad(1) / 2, 0, 0, 0, 0, 0, 0, 0};
  Numbers values(model->invariants().size());
  Problem<Quad>(model).invariants(Quad(0), z, values);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (model->invariants()[i].name == "energy") return values[i];
  return Quad(0);
}

void metric_potential_rows(Rows& rows, const ConstrainedPoint& chain) {
  // Central differences of step 1e-8: 1e-16 of third derivatives that are a few tens.
  const Quad step(1e-8);
  const Numbers gradient = chain.half_log_gradient();
  Numbers differences;
  for (std::size_t k = 0; k < gradient.size(); ++k)
    differences.push_back((chain.half_log_determinant(k, step) - chain.half_log_determinant(k, -step)) /
                          (2 * step));
  const double apart = distance(gradient, differences);
  rows.qualitative("metric potential", "gradient", "no formula", shown(gradient), apart, 1e-13,
                   apart <= 1e-13, "tr(S^-1 dS) / 2 and differences of log|S| / 2");
}

void motion_rows(Rows& rows, const ConstrainedPoint& off) {
  const std::size_t k = off.count();
  // (4.1): the inverse of W by blocks.
  const Matrix<Quad> s = off.s(), a = off.a(), s_inverse = inverse(s);
  Matrix<Quad> c(2 * k, 2 * k);
  const Matrix<Quad> corner = s_inverse.transposed() * a * s_inverse;
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t j = 0; j < k; ++j) {
      c(i, j) = corner(i, j);
      c(i, k + j) = -s_inverse(j, i);
      c(k + i, j) = s_inverse(i, j);
    }
  rows.reproduced("(4.1)", "inverse of W by blocks", entries(c), entries(inverse(off.w())));
  rows.reproduced("(4.2)", "4-pendulum off its constraints: Dirac's equations", off.rates("dirac"),
                  off.rates_by_definition());
  const Numbers multipliers = off.rates("lmm"), simplified = off.rates("simplified-dirac");
  rows.reproduced("(4.7), (A.5)", "without friction one field, everywhere", simplified, multipliers);
  rows.reproduced("(A.1)-(A.5)", "multipliers from the second derivatives", multipliers,
                  off.rates_with_multipliers());
  const ConstrainedPoint on("n-pendulum", {{"bobs", "4"}, {"seed", "3"}}, Quad(0));
  const double apart = distance(off.rates("dirac"), simplified);
  rows.claim("(4.7)", "equivalent to (4.2)", "equivalent", "only where phi~ = 0", apart,
             distance(on.rates("dirac"), on.rates("simplified-dirac")) <= at_round_off,
             "(4.7): only where phi~ = 0");
}

void table_rows(Rows& rows, const ConstrainedPoint& p, bool pendulum, const std::string& equation) {
  const std::size_t d = p.axes(), k = p.count();
  const Numbers rod = rods(p.q(), d, pendulum), speed = rods(p.velocity(), d, pendulum);
  const auto mass = [&](std::size_t bead) { return p.mass(bead); };
  Numbers c, b, a, c_friction, b_friction;
  for (std::size_t i = 0; i < k; ++i) {
    // Rod i joins beads before and after; a pendulum's first has none before.
    const bool anchored = pendulum && i == 0;
    const std::size_t after = pendulum ? i : i + 1, before = after - 1;
    const Quad length = dot(rod, i, rod, i, d);
    c.push_back(((anchored ? Quad(0) : 1 / mass(before)) + 1 / mass(after)) * length);
    c_friction.push_back(((anchored ? Quad(0) : p.friction(before) / (mass(before) * mass(before))) +
                          p.friction(after) / (mass(after) * mass(after))) *
                         length);
    if (i + 1 == k) continue;
    const Quad sign(anchored ? -1 : 1);
    b.push_back(-sign * dot(rod, i, rod, i + 1, d) / mass(after));
    b_friction.push_back(b.back() * p.friction(after) / mass(after));
    a.push_back(sign * (dot(rod, i, speed, i + 1, d) - dot(speed, i, rod, i + 1, d)) / mass(after));
  }
  rows.reproduced(equation, "S, tridiagonal", entries(tridiagonal(c, b, 1)), entries(p.s()));
  rows.reproduced(equation, "A, skew tridiagonal", entries(tridiagonal(Numbers(k), a, -1)), entries(p.a()));
  rows.reproduced(equation, "S^D, tridiagonal", entries(tridiagonal(c_friction, b_friction, 1)),
                  entries(p.s_friction()));
}

void errata_rows(Rows& rows, const ConstrainedPoint& chain) {
  // phi depends on positions alone and friction acts on momenta: the printed bracket is 0 for all chains.
  double entry = 0;
  for (const Quad& x : entries(chain.s_friction())) entry = std::max(entry, std::abs(static_cast<double>(x)));
  rows.claim("table 1", "headers", "<phi~_i, phi_j> = 0", "<phi~_i, phi~_j>", entry,
             chain.friction(0) > Quad(0), "table 1: a tilde is lost, it is <phi~_i, phi~_j>");
  // Components of beads 1 ... N must follow one another.
  const std::size_t d = chain.axes();
  const auto follow = [&](auto first) {
    std::size_t overlap = 0;
    for (std::size_t i = 1; i < chain.count(); ++i) overlap += first(i) + d != first(i + 1);
    return first(1) == 1 ? overlap : overlap + 1;
  };
  const std::size_t printed = follow([&](std::size_t i) { return i * (d - 1) + 1; });
  const std::size_t corrected = follow([&](std::size_t i) { return d * (i - 1) + 1; });
  rows.claim("before table 1", "friction", "i(d-1)+1 to i(d-1)+d", "d(i-1)+1 to di",
             static_cast<double>(printed), corrected == 0,
             "before table 1: bead i has the components d(i-1)+1 to di");
  // Three beads with no pair but the first and the last, half of sigma apart, at rest: energy is potential.
  rows.erratum("section 4, potential", "at sigma / 2", {Quad(64 - 4096)}, {Quad(4096 - 64)},
               {lennard_jones_at_half()}, "section 4, potential: the signs are the other way");
  const double cross = std::log(0.028 / 0.00046) / (1.06 - 0.49);
  rows.claim("discussion", "crossing of the fits", "12", to_string(Quad(cross), 3), std::abs(12 - cross),
             std::abs(0.028 * std::exp(0.49 * cross) - 0.00046 * std::exp(1.06 * cross)) < 1e-12,
             "discussion: the quoted fits cross at K = 7.2");
}

void humanoid_rows(Rows& rows) {
  const ConstrainedPoint p("humanoid", {{"seed", "1"}}, Quad(0));
  const Matrix<Quad> s = p.s();
  double beyond = 0;
  for (std::size_t i = 0; i < p.count(); ++i)
    for (std::size_t j = i + 2; j < p.count(); ++j)
      beyond = std::max(beyond, std::abs(static_cast<double>(s(i, j))));
  rows.claim("section 4, humanoid", "S", "tridiagonal",
             "entries beyond the three diagonals up to " + to_string(Quad(beyond), 3), beyond,
             p.structure() == MatrixStructure::tree,
             "section 4, humanoid: S is not tridiagonal, rods branch");
  const double dirac = p.energy_rate("dirac", "metriplectic"), stokes = p.energy_rate("dirac", "stokes");
  rows.claim("after (4.2)", "friction", "dH/dt " + to_string(Quad(stokes), 5),
             "dH/dt " + to_string(Quad(dirac), 5), std::abs(dirac - stokes), dirac < 0 && stokes < dirac,
             "after (4.2): Stokes drag only for special friction");
}

void pendulum_rows(Rows& rows, const ConstrainedPoint& off) {
  // (B.1): constraints as printed use r_k - r_{k+1} for k = 2 ... N, with r_{N+1} = 0 where there is none.
  const std::size_t d = off.axes(), k = off.count();
  Numbers printed, corrected;
  for (std::size_t i = 0; i < k; ++i) {
    Quad as_printed(-1), as_corrected(-1);  // all rods have length 1
    for (std::size_t x = 0; x < d; ++x) {
      const auto r = [&](std::size_t bead) { return bead < k ? off.q()[bead * d + x] : Quad(0); };
      const Quad u = i == 0 ? r(0) : r(i) - r(i + 1), v = i == 0 ? r(0) : r(i - 1) - r(i);
      as_printed += u * u;
      as_corrected += v * v;
    }
    printed.push_back(as_printed / 2);
    corrected.push_back(as_corrected / 2);
  }
  rows.erratum("(B.1)-(B.3)", "constraints", printed, corrected, off.residuals(),
               "(B.1)-(B.3): r_{k-1} - r_k, not r_k - r_{k+1}");
  Quad kinetic(0), potential(0);
  for (std::size_t i = 0; i < k * d; ++i)
    kinetic += off.velocity()[i] * off.velocity()[i] * off.mass(i / d) / 2;
  for (std::size_t i = 0; i < k; ++i) potential += off.mass(i) * Quad(981) / 100 * off.q()[i * d + d - 1];
  rows.reproduced("(B.4)", "energy of the pendulum", {kinetic + potential}, {off.energy()});
}
}  // namespace

void formulation_rows(Rows& rows) {
  const ConstrainedPoint pendulum("n-pendulum", {{"bobs", "4"}, {"seed", "3"}, {"friction", "0.3"}},
                                  Quad(1) / 16);
  const ConstrainedPoint frictionless("n-pendulum", {{"bobs", "4"}, {"seed", "3"}}, Quad(1) / 16);
  const ConstrainedPoint chain("chain-molecule", {{"beads", "6"}, {"seed", "3"}, {"friction", "0.3"}},
                               Quad(1) / 32);
  motion_rows(rows, frictionless);
  table_rows(rows, chain, false, "(4.3)-(4.5), tables 1 and 2");
  table_rows(rows, pendulum, true, "(B.5)");
  pendulum_rows(rows, frictionless);
  errata_rows(rows, chain);
  humanoid_rows(rows);
  metric_potential_rows(rows, chain);
}

}  // namespace pfaff::nguyen_turski
