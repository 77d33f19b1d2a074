// The lattice of Fermi, Pasta, Ulam and Tsingou: closed forms at the start, the same lattice as text, the
// linear lattice, whose modes are oscillators, and the return of the energy to the lowest mode.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/runs/block_values.hpp>
#include <pfaff/runs/integrate.hpp>
#include <pfaff/systems/text/text_system.hpp>

#include "../formula_values.hpp"
#include "samples.hpp"
#include "taylor_flow.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

constexpr double round_off = 1e-31;  // of quad, for sums of some tens of terms of the order of one

std::shared_ptr<const Model> lattice(const Assignments& set = {}) {
  return systems().get("fermi-pasta-ulam-tsingou", "system").make(set);
}
const Quad pi = (3.14159265358979323846264338327950288_r).quad();

TEST(FermiPastaUlamTsingou, StartsWithTheEnergyOfTheLowestMode) {
  for (const int n : {3, 8, 32}) {
    const auto model = lattice({{"n", std::to_string(n)}, {"beta", "0.3"}});
    const Quad s = sin(pi / Quad(2 * (n + 1))), square = s * s;
    const Quad linear = Quad(n + 1) * square;
    const Numbers found = evaluated(model, Formula::invariants, initial_state(*model), 1 + std::min(n, 4));
    EXPECT_LT(static_cast<double>(abs(found[0] - linear - Quad(n + 1) * Quad(0.45) * square * square)),
              1e-16);  // 0.45 is a double; what is left is its rounding
    EXPECT_LT(distance({found[1]}, {linear}), round_off);
    for (int k = 2; k <= std::min(n, 4); ++k)
      EXPECT_LT(static_cast<double>(found[static_cast<std::size_t>(k)]), round_off);
  }
}

// With t = pi/(n + 1) and s = sin(t/2) the lengthenings are 2 s cos((i - 1/2) t), and their powers are sums
// of cosines of multiples.
TEST(FermiPastaUlamTsingou, ForcesAtTheStartAreSinesOfMultiples) {
  const int n = 32;
  const auto forces_of = [&](Quad alpha, Quad beta) {
    const Quad t = pi / Quad(n + 1), s = sin(t / Quad(2));
    Numbers f;
    for (int i = 1; i <= n; ++i) {
      const Quad x = Quad(i) * t;
      f.push_back(Quad(-4) * s * s *
                  (sin(x) + alpha * sin(t) * sin(Quad(2) * x) +
                   beta * s * (Quad(3) * s * sin(x) + sin(Quad(1.5) * t) * sin(Quad(3) * x))));
    }
    return f;
  };
  const auto model = lattice({{"beta", "0.5"}});
  Numbers z = initial_state(*model);
  z.resize(n);
  const Numbers f = evaluated(model, Formula::force, z, n);
  EXPECT_LT(distance(f, forces_of(Quad(0.25), Quad(0.5))), round_off);
  EXPECT_GT(distance(f, forces_of(Quad(0.25), Quad(0.25))), 1e-6);  // control
  EXPECT_GT(distance(f, forces_of(Quad(0.125), Quad(0.5))), 1e-4);
}

TEST(FermiPastaUlamTsingou, IsItsTextWrittenInCpp) {
  const Assignments set{{"n", "7"}, {"alpha", "0.6"}, {"beta", "0.4"}};
  const auto path = std::filesystem::path(PFAFF_GOLDEN) / "../../examples/models/lattice.toml";
  const auto text = system_named(path.string()).make(set), ours = lattice(set);
  EXPECT_EQ(distance(initial_state(*ours), initial_state(*text)), 0);
  Samples samples(11);
  for (int sample = 0; sample < 20; ++sample) {
    const Numbers z = samples.state(*ours, 1);
    EXPECT_LT(distance(evaluated(ours, Formula::field, z, 14), evaluated(text, Formula::field, z, 14)),
              1e-30);
    EXPECT_LT(
        distance({evaluated(ours, Formula::invariants, z, 5)[0]}, evaluated(text, Formula::invariants, z, 1)),
        1e-30);
    EXPECT_GT(distance(evaluated(lattice({{"n", "7"}}), Formula::field, z, 14),
                       evaluated(text, Formula::field, z, 14)),
              1e-6);  // control: other springs
  }
}

TEST(FermiPastaUlamTsingou, ModesOfTheLinearLatticeAreOscillators) {
  const auto linear = lattice({{"n", "4"}, {"alpha", "0"}});
  Samples samples(12);
  for (int sample = 0; sample < 10; ++sample) {
    const Numbers e = evaluated(linear, Formula::invariants, samples.state(*linear, 1), 5);
    EXPECT_LT(distance({e[1] + e[2] + e[3] + e[4]}, {e[0]}), round_off);
    const Numbers bent = evaluated(lattice({{"n", "4"}}), Formula::invariants, samples.state(*linear, 1), 5);
    EXPECT_GT(distance({bent[1] + bent[2] + bent[3] + bent[4]}, {bent[0]}), 1e-6);  // control
  }
  const Quad half = pi / Quad(10), frequency = Quad(2) * sin(half), time(1.5);
  const Numbers z = taylor_flow(linear->tape(Formula::field), Quad(0), initial_state(*linear), time);
  Numbers expected(8);
  for (std::size_t i = 0; i < 4; ++i) {
    const Quad shape = sin(Quad(static_cast<double>(i + 1)) * Quad(2) * half);
    expected[i] = shape * cos(frequency * time);
    expected[4 + i] = -frequency * shape * sin(frequency * time);
  }
  EXPECT_LT(distance(z, expected), 1e-28);
}

class Motion {
 public:
  explicit Motion(const char* h)
      : run_(integrate("fermi-pasta-ulam-tsingou", {}, "kahan-li-verlet", {{"order", "8"}}, {.step = h})),
        invariants_(run_.model(), Formula::invariants, 5, 1) {}
  [[nodiscard]] std::vector<double> harmonic_energies() {
    const std::span<const double> found = invariants_.at(run_.time(), run_.state());
    return {found.begin() + 1, found.end()};
  }
  void steps(std::int64_t count) { run_.steps(count).expect_reached(); }

 private:
  Integration<double> run_;
  BlockValues<double> invariants_;
};

// The golden values are of a program of its own in Python: forces from differences of the positions, Verlet
// steps composed three at a time to order 8, h = 1/16; with h = 1/8 they differ by 1e-12.
TEST(FermiPastaUlamTsingou, HarmonicEnergiesAreThoseOfAnotherProgram) {
  Motion motion("0.125");
  motion.steps(8000);
  const std::vector<double> found = motion.harmonic_energies();
  const std::vector<double> golden{0.05404491154641182, 0.01026979361577754, 0.004323846731360385,
                                   0.002659537756128374};
  for (std::size_t k = 0; k < golden.size(); ++k) EXPECT_NEAR(found[k], golden[k], 1e-11) << k;
  motion.steps(8);  // control: one unit of time later they are others
  EXPECT_GT(std::abs(motion.harmonic_energies()[0] - golden[0]), 1e-6);
}

// What the lattice is known for: the energy leaves the lowest mode nearly altogether, and after 155 periods
// of that mode nearly all of it is back (fermi-pasta-ulam1955, figure 1). The numbers are those of the same
// program in Python.
TEST(FermiPastaUlamTsingou, EnergyComesBackToTheLowestMode) {
  Motion motion("0.5");
  const double start = motion.harmonic_energies()[0];
  double least = 1, back = 0, at = 0;
  for (double t = 0; t <= 12000; t += 10) {
    const double part = motion.harmonic_energies()[0] / start;
    if (t > 9000 && part > back) back = part, at = t;
    if (t < 9000) least = std::min(least, part);
    motion.steps(20);
  }
  EXPECT_NEAR(least, 0.0857, 0.0005);
  EXPECT_NEAR(back, 0.9807, 0.0005);
  EXPECT_NEAR(at, 10130, 10);
}
}  // namespace
