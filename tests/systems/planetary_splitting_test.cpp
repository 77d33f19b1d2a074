// The splitting of planets into Kepler orbits and their interaction, against the two energies written with
// Jacobi's coordinates as they are defined, each from sums over all bodies before it.
#include <gtest/gtest.h>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/systems/canonical/planetary_splitting.hpp>

#include "../formula_values.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::initial_state;

constexpr std::size_t n = 6, half = 18;

std::shared_ptr<const Model> planets() { return systems().get("outer-solar-system", "system").make({}); }

// The masses and the constant from the model's parameters.
template <class T>
std::vector<T> masses(const Model& model) {
  std::vector<T> list;
  for (const char* name : {"sun", "jupiter", "saturn", "uranus", "neptune", "pluto"})
    for (const auto& [key, value] : model.parameters())
      if (key == name) list.push_back(T(*Real::parse(value)));
  return list;
}
const Real constant = 2.95912208286e-4_r;

// r_i = q_i - (m_0 q_0 + ... + m_(i-1) q_(i-1))/M_(i-1), and velocities likewise.
template <class T>
std::array<T, 3> jacobi_coordinates(const std::vector<T>& m, const std::vector<T>& z, std::size_t i,
                                    bool velocity) {
  std::array<T, 3> result;
  for (std::size_t x = 0; x < 3; ++x) {
    T sum(0), mass(0);
    for (std::size_t j = 0; j < i; ++j) {
      sum = sum + (velocity ? z[half + x * n + j] : T(m[j] * z[x * n + j]));
      mass = mass + m[j];
    }
    result[x] = (velocity ? T(z[half + x * n + i] / m[i]) : z[x * n + i]) - sum / mass;
  }
  return result;
}
template <class T>
T square(const std::array<T, 3>& v) {
  return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

template <class T>
T kepler_energy(const std::vector<T>& m, const std::vector<T>& z) {
  T sum(0), inner = m[0];
  std::array<T, 3> total{z[half], z[half + n], z[half + 2 * n]};
  for (std::size_t i = 1; i < n; ++i) {
    sum = sum + m[i] * inner / (inner + m[i]) * square(jacobi_coordinates(m, z, i, true)) / 2;
    sum = sum - T(constant) * m[i] * inner / sqrt(square(jacobi_coordinates(m, z, i, false)));
    inner = inner + m[i];
    for (std::size_t x = 0; x < 3; ++x) total[x] = total[x] + z[half + x * n + i];
  }
  return sum + square(total) / (2 * inner);
}
template <class T>
T interaction_energy(const std::vector<T>& m, const std::vector<T>& z) {
  T sum(0), inner = m[0];
  for (std::size_t i = 1; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      std::array<T, 3> way{z[i] - z[j], z[n + i] - z[n + j], z[2 * n + i] - z[2 * n + j]};
      sum = sum - T(constant) * m[i] * m[j] / sqrt(square(way));
    }
    sum = sum + T(constant) * m[i] * inner / sqrt(square(jacobi_coordinates(m, z, i, false)));
    inner = inner + m[i];
  }
  return sum;
}

TEST(PlanetarySplitting, TheEnergiesAddUp) {
  const auto model = planets();
  const auto z = initial_state(*model);
  const auto m = masses<Quad>(*model);
  std::vector<Quad> values(model->invariants().size());
  Problem<Quad>(model).invariants(Quad(0), z, values);
  const Quad a = kepler_energy(m, z), b = interaction_energy(m, z);
  EXPECT_LT(abs(a + b - values[0]), Quad(1e-36));  // energies of 3e-8
  EXPECT_LT(abs(b), Quad(2e-3) * abs(a));          // and the interaction is small
}

// The flow of the first part is that of A where it moves along the Hamiltonian field of A and keeps A; here
// for a long flow, over many periods of Jupiter. The group and the sum with the second part are verified of
// every system.
TEST(PlanetarySplitting, KeplerOrbitsKeepTheirEnergyAndAllMomenta) {
  const auto model = planets();
  const auto start = initial_state(*model);
  const auto m = masses<Quad>(*model);
  const auto flows = model->exact_flows<Quad>();
  for (const int days : {10, -700, 100000}) {
    auto z = start;
    std::vector<Quad> change(36), before(8), after(8);
    ASSERT_EQ(flows->change(0, Quad(days), z, change), Status::converged);
    for (std::size_t k = 0; k < z.size(); ++k) z[k] += change[k];
    EXPECT_LT(abs(kepler_energy(m, z) - kepler_energy(m, start)), Quad(1e-38)) << days;
    ASSERT_EQ(model->invariants().size(), 7U);
    Problem<Quad>(model).invariants(Quad(0), start, before);
    Problem<Quad>(model).invariants(Quad(0), z, after);
    for (std::size_t k = 1; k < 7; ++k) EXPECT_LT(abs(after[k] - before[k]), Quad(1e-35)) << days << " " << k;
    EXPECT_GT(abs(after[0] - before[0]), Quad(1e-14)) << days;  // the energy of the system is not A
  }
}

// The Kepler flow's field is J grad A, from dual numbers of A as it is defined above; the kick is -grad B.
TEST(PlanetarySplitting, FlowsBeginAlongTheGradientsOfTheirEnergies) {
  using D = Dual<Quad, 4>;
  const auto model = planets();
  auto start = initial_state(*model);
  for (std::size_t k = 0; k < start.size(); ++k)
    start[k] *= Quad(1) + Quad(static_cast<int>(k % 5)) / Quad(40);
  const auto m = masses<D>(*model);
  const auto flows = model->exact_flows<D>();
  std::vector<D> z(start.begin(), start.end()), change(36);
  for (std::size_t part = 0; part < 2; ++part) {
    ASSERT_EQ(flows->change(part, D::variable(Quad(0), 0), z, change), Status::converged);
    for (std::size_t k = 0; k < 36; ++k) {
      std::vector<D> moved = z;
      moved[k] = D::variable(start[k], 0);
      const Quad slope = (part == 0 ? kepler_energy(m, moved) : interaction_energy(m, moved)).derivative[0];
      const Quad found = k < half ? -change[half + k].derivative[0] : change[k - half].derivative[0];
      // The definition of B subtracts pulls that agree to three digits, and the velocity of the Sun is what
      // is left of those of the planets, 1e-2, by their masses.
      EXPECT_LT(abs(found - slope), Quad(1e-29) * abs(slope) + Quad(k < half ? 1e-40 : 1e-36))
          << part << " " << k;
    }
  }
}

// In double the kicks are as good as their own size: nothing is lost in the difference of the Sun's pull and
// that of Kepler's problem, which agree to three digits and for Pluto to more.
TEST(PlanetarySplitting, KicksLoseNoDigits) {
  const auto model = planets();
  const auto exact = initial_state(*model);
  std::vector<double> z, change(36);
  std::vector<Quad> same, exact_change(36);
  for (const Quad& x : exact) {
    z.push_back(static_cast<double>(x));
    same.emplace_back(z.back());
  }
  ASSERT_EQ(model->exact_flows<double>()->change(1, 100.0, z, change), Status::converged);
  ASSERT_EQ(model->exact_flows<Quad>()->change(1, Quad(100), same, exact_change), Status::converged);
  for (std::size_t i = 1; i < n; ++i) {  // each planet's kick as a vector
    double off = 0, size = 0;
    for (std::size_t x = 0; x < 3; ++x) {
      const std::size_t k = half + x * n + i;
      off = std::max(off, std::abs(change[k] - static_cast<double>(exact_change[k])));
      size = std::max(size, std::abs(change[k]));
    }
    // Far out the pulls of the planets and those of their centre of mass cancel to a tenth, which is what the
    // kick is; 1e-14 are ten roundings of each.
    EXPECT_LT(off, 1e-14 * size) << i;
  }
  // The pull of the Sun itself has a hundred times as large a rounding error, which the difference of two
  // would keep.
  double pull = 0, kick = 0;
  std::vector<double> force(half);
  Problem<double>(model).force(0, std::span<const double>(z.data(), half), force);
  for (std::size_t x = 0; x < 3; ++x) {
    pull = std::max(pull, std::abs(100 * force[x * n + 4]));
    kick = std::max(kick, std::abs(change[half + x * n + 4]));
  }
  EXPECT_GT(pull, 100 * kick);
}

// Two planets, 1030 and 141 turns, by the two-body problems of Jacobi's coordinates solved with 60 digits
// (mpmath). With a period of one number, and with the uniform motion added and taken off, it is 8,000 units.
template <class T>
double planets_in_units() {
  constexpr std::size_t bodies = 3, axes = 2;
  const auto mass = [](std::size_t i) { return T(std::array<double, 3>{1, 0.3, 0.001}[i]); };
  const double small = 0x1p-11;
  const std::array<double, 12> start{0.125,  0.875,   -3.5, -0.25, 0.25,          0.5,
                                     0.0625, -0.0625, 0,    0.25,  -0.25 + small, -small};
  const std::array<const char*, 12> expected{
      "0.221274587799433353290158529217517829",    "0.538878106610870427315719686744023905",
      "1.06198021730551468845762338831674344",     "-0.435087387123170491473906909091760024",
      "0.875593288200903305292548168583024833",    "-2.09059933710049311444913352408804152",
      "-0.123264115541527585198083542784567793",   "0.122496533483847667452529708713235242",
      "0.000767582057679917745553834071332551146", "-0.0155213880162725084665440096893595138",
      "0.0150631964406046279552325393345847562",   "0.000458191575667880511311470354774757624"};
  std::array<T, 12> z, change;
  for (std::size_t k = 0; k < z.size(); ++k) z[k] = T(start[k]);
  EXPECT_EQ(planetary::kepler_part<T>(mass, T(1), bodies, axes, T(4000.5), In<T>(z), Out<T>(change)),
            Status::converged);
  double worst = 0;
  for (std::size_t k = 0; k < z.size(); ++k) {
    // Of positions of some ones, and of momenta in proportion to the masses.
    const double size = k < 6 ? 1 : std::array<double, 3>{0.3, 0.3, 0.001}[k % 3];
    const Quad end = Quad(z[k]) + Quad(change[k]);
    worst = std::max(
        worst,
        static_cast<double>(abs(end - Real::parse(expected[k])->quad()) / Quad(unit_roundoff<T>())) / size);
  }
  return worst;
}
TEST(PlanetarySplitting, ManyTurnsLoseNoDigits) {
  EXPECT_LT(planets_in_units<double>(), 100);
  EXPECT_LT(planets_in_units<Quad>(), 100);
}

}  // namespace
