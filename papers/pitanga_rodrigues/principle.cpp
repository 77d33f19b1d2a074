// Pitanga & Rodrigues 4.1, (18) to (26): d'Alembert's principle by projectors, for a system of four positions
// with masses that differ, a potential, and two constraints that depend on the positions and on time.
#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/integrators/runge_kutta/gauss_coefficients.hpp>
#include <pfaff/papers/pitanga_rodrigues/engine_point.hpp>
#include <pfaff/papers/pitanga_rodrigues/rows.hpp>
#include <pfaff/papers/printed/polynomial.hpp>
#include <pfaff/papers/printed/projectors.hpp>

namespace pfaff::pitanga_rodrigues {

namespace {

using printed::Polynomial;
constexpr std::size_t coordinate_count = 4, m = 2;

// The inputs of both sides.
Rational mass(std::size_t k) { return Rational(static_cast<int>(k) + 2) / Rational(static_cast<int>(k) + 1); }
template <class T>
T potential_energy(const std::vector<T>& z) {
  return z[0] * z[0] * z[1] + z[2] * z[3] + z[3] * z[3] * z[3] - z[1] * z[2];
}
template <class T>
std::vector<T> constraint_rows(const std::vector<T>& z) {
  return {z[1], T(1), T(0) - z[3], T(2), z[2] * z[0], T(0), T(1), z[1] - T(3)};
}
template <class T>
std::vector<T> offsets(const T& t) {
  return {t * t, T(1) - t};
}

struct PrincipleSample {
  static constexpr int dimension = 2 * static_cast<int>(coordinate_count),
                       velocity_constraint_count = static_cast<int>(m);
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    T sum(0);
    for (std::size_t k = 0; k < coordinate_count; ++k)
      sum = sum + p[k] * p[k] * T(static_cast<int>(k) + 1) / T(static_cast<int>(k) + 2) / T(2);
    return sum;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return potential_energy(std::vector<T>(q.begin(), q.end()));
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    const std::vector<T> a = constraint_rows(std::vector<T>(q.begin(), q.end()));
    for (std::size_t k = 0; k < a.size(); ++k) rows[k] = a[k];
  }
  template <class T>
  void velocity_offsets(const T& t, In<T> /*q*/, Out<T> b) const {
    const std::vector<T> values = offsets(t);
    for (std::size_t k = 0; k < values.size(); ++k) b[k] = values[k];
  }
};

std::shared_ptr<const Model> sample_model() {
  return make_model(SystemDescriptor{.name = "example", .title = "", .reference = ""}, PrincipleSample{});
}
// V as a polynomial of the positions.
Polynomial potential_polynomial() {
  std::vector<Polynomial> z;
  for (std::size_t k = 0; k < coordinate_count; ++k) z.push_back(Polynomial::variable(k));
  return potential_energy(z);
}

// Along a curve z(t) with a variation dz(t) that vanishes at both ends, polynomials of t: the integral of E
// dz as printed, against the change of the action by the engine's Hamiltonian, L_v = p and L_z = -H_q.
void stationarity(Rows& rows) {
  const Polynomial t = Polynomial::variable(0), v = potential_polynomial();
  std::vector<Polynomial> z, dz;
  for (std::size_t k = 0; k < coordinate_count; ++k) {
    const int i = static_cast<int>(k);
    z.push_back(Polynomial(Rational(1 - i) / Rational(3)) + Polynomial(Rational(i + 1)) * t -
                Polynomial(Rational(2) / Rational(i + 1)) * t * t);
    dz.push_back(t * (Polynomial(Rational(1)) - t) * (Polynomial(Rational(1)) + Polynomial(Rational(i)) * t));
  }
  Polynomial integrand;
  for (std::size_t k = 0; k < coordinate_count; ++k)
    integrand = integrand + (Polynomial(mass(k)) * z[k].slope(0).slope(0) + v.slope(k).at(z)) * dz[k];
  const std::vector<Rational> end{Rational(1)};

  const auto gradient = sample_model()->tape(Formula::hamiltonian_gradient);
  Replay<Quad> replay(gradient);
  const GaussCoefficients gauss = gauss_coefficients(8);  // exact for degree 15; the integrand has 7
  Quad change(0);
  for (std::size_t node = 0; node < gauss.nodes.size(); ++node) {
    const Numbers at{gauss.nodes[node]};
    Numbers state(2 * coordinate_count), slopes(2 * coordinate_count);
    for (std::size_t k = 0; k < coordinate_count; ++k) {
      state[k] = z[k].at(at);
      state[coordinate_count + k] = static_cast<Quad>(mass(k)) * z[k].slope(0).at(at);
    }
    replay(Quad(0), state.data(), slopes.data());
    for (std::size_t k = 0; k < coordinate_count; ++k)
      change += gauss.weights[node] *
                (state[coordinate_count + k] * dz[k].slope(0).at(at) - slopes[k] * dz[k].at(at));
  }
  rows.reproduced("(19), (21)", "the integral of E dz is minus the change of the action",
                  quads(std::vector<Rational>{integrand.along_ray(1, 0).at(end)}), {-change});
}

Numbers plus(Numbers a, const Numbers& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] += b[k];
  return a;
}
Numbers values_of(const AlmostProduct<Quad>& structure, const TangentVector<Quad>& displacement) {
  Numbers values;
  for (const auto& w : structure.one_forms()) values.push_back(pairing(w, displacement));
  return values;
}

void projections(Rows& rows) {
  const Quad t = Quad(3) / Quad(10);
  const EnginePoint engine(
      sample_model(), t,
      {Quad(1) / 2, Quad(-2) / 3, Quad(5) / 4, Quad(1), Quad(3), Quad(-1), Quad(2) / 7, Quad(1) / 3});
  const AlmostProduct<Quad> structure = engine.projectors();
  const Numbers eta{Quad(1), Quad(-2) / 3, Quad(1) / 5, Quad(7) / 4};

  const Numbers entries = constraint_rows(engine.q());
  printed::Table<Quad> a{{entries.begin(), entries.begin() + coordinate_count},
                         {entries.begin() + coordinate_count, entries.end()}},
      inverse_metric = printed::unit_table<Quad>(coordinate_count);
  for (std::size_t k = 0; k < coordinate_count; ++k)
    inverse_metric[k][k] = Quad(1) / static_cast<Quad>(mass(k));
  const auto q = printed::constraint_q(a, inverse_metric),
             p = printed::difference(printed::unit_table<Quad>(coordinate_count), q),
             q_star = printed::transposed(q), p_star = printed::transposed(p);

  // At momenta that do not keep the constraint.
  Numbers off = engine.state(), v = engine.velocity();
  for (std::size_t k = 0; k < coordinate_count; ++k) {
    off[coordinate_count + k] += eta[k];
    v[k] += inverse_metric[k][k] * eta[k];
  }
  rows.reproduced("(18)", "A v + B", plus(printed::product(a, v), offsets(t)), engine.constraints(off));
  const TangentVector<Quad> displaced = structure.admissible() * TangentVector<Quad>(eta);
  rows.reproduced("(20), (22)", "A dz of a virtual displacement", printed::product(a, displaced.components()),
                  zeros(m));
  rows.erratum("(23)", "A dz with dz = P^t d eta", printed::product(a, printed::product(p_star, eta)),
               printed::product(a, printed::product(p, eta)), values_of(structure, displaced),
               "(23): Q and P act on vectors, dz = P d eta; covectors need their transposes");
  // E = M z'' + grad V of the engine's motion.
  Numbers force = engine.acceleration();
  const Polynomial potential = potential_polynomial();
  for (std::size_t k = 0; k < coordinate_count; ++k)
    force[k] = static_cast<Quad>(mass(k)) * force[k] + potential.slope(k).at(engine.q());
  const Covector<Quad> e(force);
  rows.erratum("(24)", "P E", printed::product(p, force), printed::product(p_star, force),
               (structure.admissible().transposed() * e).components(), "(24): E is a covector, P^T E = 0");
  rows.erratum("(25)", "E = Q E", printed::product(q, force), printed::product(q_star, force), force,
               "(25): E is a covector, E = Q^T E");
  rows.reproduced("(26)", "Q, on vectors", printed::listed(q), structure.complement().matrix().entries());
}

}  // namespace

void principle_rows(Rows& rows) {
  stationarity(rows);
  projections(rows);
}

}  // namespace pfaff::pitanga_rodrigues
