// Bead-rod systems: forces against derivatives of the energy, pairs found by cells against all pairs,
// right-hand sides of every graph against the same formulas made from tapes, structure of S, memory, and
// random starts.
#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/facets/taped_constraints.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/systems/bead_rod/cell_list.hpp>
#include <pfaff/systems/bead_rod/potentials.hpp>

#include "../formula_values.hpp"
#include "bead_rod_files.hpp"

namespace {
using namespace pfaff;
using nlohmann::json;
using pfaff::testing::bead_rod;
using pfaff::testing::evaluated;
using pfaff::testing::initial_state;

class Random {
 public:
  explicit Random(unsigned seed) : random_(seed) {}
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

 private:
  std::mt19937_64 random_;
};

std::string decimal(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9f", x);
  return text;
}

/// Beads at random places and velocities of a box, not on the constraint surface, with all potentials.
json random_model(int axes, std::size_t beads, const json& rods, unsigned seed, const json& potentials) {
  Random random(seed);
  json model{{"dimension", axes}, {"rods", rods}, {"potentials", potentials}};
  const auto vector = [&](double size) {
    json v = json::array();
    for (int x = 0; x < axes; ++x) v.push_back(decimal(random(-size, size)));
    return v;
  };
  for (std::size_t i = 0; i < beads; ++i) {
    model["masses"].push_back(decimal(random(0.5, 2)));
    model["charges"].push_back(decimal(random(-1, 1)));
    model["positions"].push_back(vector(1.5));
    model["velocities"].push_back(vector(1));
  }
  for (const auto& rod : rods)
    for (const auto& end : rod)
      if (end.is_string()) model["anchors"][end.get<std::string>()] = vector(1);
  model["gravity"] = vector(9);
  for (std::size_t k = 0; k < rods.size(); ++k) model["lengths"].push_back(decimal(random(0.5, 2)));
  return model;
}

json every_potential(int axes) {
  json center = json::array(), field = json::array();
  for (int x = 0; x < axes; ++x) {
    center.push_back(decimal(0.1 * x));
    field.push_back(decimal(0.7 - 0.4 * x));
  }
  return {
      {{"kind", "lennard-jones"}, {"epsilon", "0.3"}, {"sigma", "0.6"}, {"cutoff", "1.4"}, {"exclude", 1}},
      {{"kind", "lennard-jones"}, {"epsilon", "0.01"}, {"sigma", "0.5"}},
      {{"kind", "coulomb"}, {"strength", "0.8"}, {"exclude", 2}},
      {{"kind", "coulomb"}, {"strength", "0.3"}, {"cutoff", "1.1"}},
      {{"kind", "spring"}, {"stiffness", 3}, {"length", "0.7"}, {"beads", {{0, 3}, {1, 4}}}},
      {{"kind", "harmonic-angle"}, {"stiffness", 2}, {"angle", "1.91"}, {"beads", {{0, 1, 2}, {2, 4, 3}}}},
      {{"kind", "field"}, {"strength", field}},
      {{"kind", "trap"}, {"stiffness", "0.4"}, {"center", center}}};
}

template <class T>
std::vector<T> field_at(const std::shared_ptr<const Model>& model, const std::vector<T>& z) {
  return evaluated(model, Formula::field, z, z.size());
}

// -dV/dq by hand equals the derivative of the energy, which duals and the tape know without being told.
TEST(BeadRod, ForcesAreTheEnergysSlopes) {
  for (const int axes : {2, 3}) {
    const json rods{{0, 1}, {1, 2}, {2, 3}, {3, 4}};
    const auto model = bead_rod("forces", random_model(axes, 5, rods, 11, every_potential(axes)));
    const auto z = initial_state<Quad>(*model);
    const std::size_t n = z.size() / 2;
    const auto constraints = model->holonomic_constraints<Quad>();
    std::vector<Quad> f(n);
    constraints->force(Quad(0), std::span(z).first(n), std::span(z).subspan(n), f);
    const auto energy = make_evaluator<StepDual<Quad>>(model, Formula::potential);
    const auto taped = make_evaluator<Quad>(model, Formula::force);
    std::vector<Quad> from_tape(n);
    taped.call(taped.context, Quad(0), z.data(), from_tape.data());
    for (std::size_t k = 0; k < n; ++k) {
      std::vector<StepDual<Quad>> q(z.begin(), z.begin() + static_cast<std::ptrdiff_t>(n));
      q[k] = StepDual<Quad>::variable(z[k], 0);
      StepDual<Quad> v;
      energy.call(energy.context, StepDual<Quad>(0), q.data(), &v);
      // Energies of pairs close by are up to 1e4; their slopes keep 1e-28 of the largest force.
      const Quad tolerance = Quad(1e-27) * (Quad(1) + abs(f[k]));
      EXPECT_LE(abs(f[k] + v.derivative[0]), tolerance) << axes << ' ' << k;
      EXPECT_LE(abs(f[k] - from_tape[k]), tolerance) << axes << ' ' << k;
    }
  }
}

// The shift makes the energy continuous at the cut-off; without it it would jump.
TEST(BeadRod, EnergiesVanishContinuouslyAtTheCutoff) {
  for (const char* kind : {"lennard-jones", "coulomb"}) {
    const auto energy_at = [&](const char* distance) {
      json model{{"dimension", 2},
                 {"masses", {1, 1}},
                 {"charges", {1, 1}},
                 {"positions", {{0, 0}, {distance, 0}}},
                 {"potentials", {{{"kind", kind}, {"cutoff", 2}}}}};
      for (const char* key : {"epsilon", "sigma"})
        if (std::string(kind) == "lennard-jones") model["potentials"][0][key] = 1;
      if (std::string(kind) == "coulomb") model["potentials"][0]["strength"] = 1;
      const auto made = bead_rod("cutoff", model);
      const auto evaluator = make_evaluator<Quad>(made, Formula::potential);
      Quad v;
      const auto z = initial_state<Quad>(*made);
      evaluator.call(evaluator.context, Quad(0), z.data(), &v);
      return v;
    };
    EXPECT_LE(abs(energy_at("1.9999999999")), Quad(1e-9)) << kind;
    EXPECT_EQ(energy_at("2.0000000001"), Quad(0)) << kind;
    EXPECT_GE(abs(energy_at("1.9")), Quad(5e-3)) << kind;
  }
}

template <int D>
void expect_all_close_pairs(std::size_t points, double extent, double width) {
  Random random(static_cast<unsigned>(points));
  std::vector<double> x(points * D);
  for (double& c : x) c = random(-extent, extent);
  const auto position = [&](std::size_t i, std::size_t d) { return x[i * D + d]; };
  std::set<std::pair<std::size_t, std::size_t>> expected, found;
  for (std::size_t i = 0; i < points; ++i)
    for (std::size_t j = i + 1; j < points; ++j) {
      double square = 0;
      for (std::size_t d = 0; d < D; ++d) square += std::pow(position(i, d) - position(j, d), 2);
      if (square <= width * width) expected.emplace(i, j);
    }
  CellList<D> cells(points);
  ASSERT_TRUE(cells.fill(width, position));
  std::size_t visits = 0;
  cells.each_pair([&](std::size_t i, std::size_t j) {
    ++visits;
    EXPECT_TRUE(found.emplace(i, j).second) << "twice: " << i << ' ' << j;
  });
  EXPECT_TRUE(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
  EXPECT_FALSE(expected.empty());
  // No more than the pairs of adjacent cells: far fewer than all.
  EXPECT_LT(visits, points * (points - 1) / 4);
}

TEST(BeadRod, CellsFindAllClosePairsOnce) {
  expect_all_close_pairs<2>(400, 10, 0.8);
  expect_all_close_pairs<3>(600, 5, 0.9);
  expect_all_close_pairs<3>(300, 500, 40);
  CellList<2> cells(1);
  EXPECT_FALSE(cells.fill(1, [](std::size_t, std::size_t) { return std::nan(""); }));
  EXPECT_FALSE(cells.fill(1e-3, [](std::size_t, std::size_t) { return 1e300; }));
}

// Two beads that meet: the status of whoever evaluates there, never a number.
TEST(BeadRod, PairsAtDistanceZeroAreNotFinite) {
  for (const char* cutoff : {"0.5", ""}) {
    json model{{"dimension", 2},
               {"masses", {1, 1, 1}},
               {"positions", {{0, 0}, {1, 0}, {1, 1}}},
               {"rods", {{0, 1}, {1, 2}}},
               {"potentials", {{{"kind", "lennard-jones"}, {"epsilon", 1}, {"sigma", 1}, {"exclude", 1}}}}};
    if (*cutoff != 0) model["potentials"][0]["cutoff"] = cutoff;
    const auto constraints = bead_rod("meeting", model)->holonomic_constraints<double>();
    const std::vector<double> apart{0, 0, 1, 0, 1, 1}, meeting{0, 0, 1, 0, 0, 0}, rest(6);
    EXPECT_EQ(constraints->place(0, apart, rest), Status::converged);
    EXPECT_EQ(constraints->place(0, meeting, rest), Status::non_finite);
    std::vector<double> q_rate(6), p_rate(6);
    auto* const rates = constraints->rates(Reactions::hamiltonian);
    ASSERT_NE(rates, nullptr);
    EXPECT_EQ((*rates)(0, meeting, rest, q_rate, p_rate), Status::non_finite);
  }
}

struct Shape {
  const char* name;
  std::size_t beads;
  json rods;
  MatrixStructure structure;
};

std::vector<Shape> shapes() {
  json long_chain = json::array(), big_ring = json::array();
  for (std::size_t k = 0; k < 20; ++k) long_chain.push_back({k, k + 1});
  for (std::size_t k = 0; k < 9; ++k) big_ring.push_back({k, (k + 1) % 9});
  std::vector<Shape> list{{"a long chain", 21, long_chain, MatrixStructure::tridiagonal},
                          {"a ring", 9, big_ring, MatrixStructure::cyclic}};
  const auto add = [&](const char* name, std::size_t beads, const char* rods, MatrixStructure structure) {
    list.push_back({name, beads, json::parse(rods), structure});
  };
  add("one rod", 2, R"([[0, 1]])", MatrixStructure::diagonal);
  add("one rod on an anchor", 1, R"([["a", 0]])", MatrixStructure::diagonal);
  add("two rods", 3, R"([[2, 0], [0, 1]])", MatrixStructure::tridiagonal);
  add("three rods, the anchor last", 3, R"([[0, 1], [1, 2], [2, "a"]])", MatrixStructure::tridiagonal);
  add("between two anchors", 3, R"([["a", 1], [1, 0], [0, 2], [2, "b"]])", MatrixStructure::tridiagonal);
  add("four bars", 2, R"([["a", 0], [0, 1], [1, "b"]])", MatrixStructure::tridiagonal);
  add("out of order", 6, R"([[3, 1], [0, 5], [5, 3], [4, 0]])", MatrixStructure::tridiagonal);
  add("two chains and a bead", 9, R"([[0, 1], [4, 5], [5, 6], [6, 7], [1, 2]])",
      MatrixStructure::tridiagonal);
  add("two anchored at one point", 4, R"([["a", 0], [0, 1], ["a", 2], [2, 3]])",
      MatrixStructure::tridiagonal);
  add("a star", 5, R"([[0, 1], [0, 2], [0, 3], [3, 4]])", MatrixStructure::tree);
  add("a tree on an anchor", 6, R"([["a", 0], [0, 1], [1, 2], [1, 3], [3, 4], [3, 5]])",
      MatrixStructure::tree);
  add("a triangle", 3, R"([[0, 1], [1, 2], [2, 0]])", MatrixStructure::cyclic);
  add("a ring of four", 4, R"([[0, 2], [2, 1], [3, 1], [0, 3]])", MatrixStructure::cyclic);
  add("a ring of six", 6, R"([[0, 1], [1, 2], [2, 3], [3, 4], [4, 5], [5, 0]])", MatrixStructure::cyclic);
  add("two rings and a chain", 10,
      R"([[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 6], [6, 3], [7, 8], [8, 9]])", MatrixStructure::sparse);
  add("a ring on an anchor", 4, R"([["a", 0], [0, 1], [1, 2], [2, 3], [3, 0]])", MatrixStructure::sparse);
  add("a braced square", 4, R"([[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]])", MatrixStructure::dense);
  return list;
}

// Batched loops, in doubles and in quad, against the same formulation over constraints made from tapes; and
// the structure of S is the graph's.
TEST(BeadRod, EveryGraphMovesAsItsTapesSay) {
  for (const int axes : {2, 3})
    for (const Shape& shape : shapes()) {
      const std::string name = std::string(shape.name) + " in " + std::to_string(axes) + "-d";
      const auto model = bead_rod("shape", random_model(axes, shape.beads, shape.rods, 5, json::array()));
      EXPECT_EQ(model->holonomic_constraints<double>()->pattern().structure(), shape.structure) << name;
      ModelSource source = model->source();
      source.holonomic = nullptr;  // from the tapes
      const auto taped = std::make_shared<const Model>(std::move(source));
      const auto z = initial_state<Quad>(*model);
      std::vector<double> rounded;
      for (const Quad x : z) rounded.push_back(static_cast<double>(x));
      for (const char* formulation : {"dirac", "simplified-dirac", "lmm"}) {
        const auto& f = formulations().get(formulation, "formulation");
        const auto expected = field_at<Quad>(f.apply(taped, {}), z);
        const auto in_quad = field_at<Quad>(f.apply(model, {}), z);
        const auto in_double = field_at<double>(f.apply(model, {}), rounded);
        Quad size(1);
        for (const Quad x : expected) size = std::max(size, abs(x));
        for (std::size_t k = 0; k < z.size(); ++k) {
          // Matrices of condition up to 1e3, and numbers that were rounded when they were read.
          EXPECT_LE(abs(in_quad[k] - expected[k]), Quad(1e-29) * size)
              << name << ' ' << formulation << ' ' << k;
          EXPECT_LE(abs(Quad(in_double[k]) - expected[k]), Quad(1e-11) * size)
              << name << ' ' << formulation << ' ' << k;
        }
      }
    }
}

// Random starts of the members obey both levels of the constraints; in quad to its round-off.
TEST(BeadRod, MembersStartConsistently) {
  const auto expect_consistent = [](const std::string& name, const Assignments& parameters) {
    const auto model = systems().get(name, "system").make(parameters);
    const auto constraints = model->holonomic_constraints<Quad>();
    const auto z = initial_state<Quad>(*model);
    const std::size_t n = z.size() / 2;
    Quad kinetic(0);
    for (std::size_t k = n; k < z.size(); ++k) kinetic = kinetic + z[k] * z[k];
    EXPECT_GT(kinetic, Quad(1e-3)) << name;
    ASSERT_EQ(constraints->place(Quad(0), std::span(z).first(n), std::span(z).subspan(n)), Status::converged);
    for (const Quad x : constraints->residuals()) EXPECT_LE(abs(x), Quad(1e-30)) << name;
    for (const Quad x : constraints->hidden()) EXPECT_LE(abs(x), Quad(1e-30)) << name;
  };
  for (const char* dimension : {"2", "3"}) {
    expect_consistent("n-pendulum", {{"bobs", "7"}, {"dimension", dimension}, {"seed", "3"}});
    expect_consistent("chain-molecule", {{"beads", "10"}, {"dimension", dimension}, {"seed", "3"}});
    expect_consistent("ring", {{"beads", "9"}, {"dimension", dimension}, {"seed", "3"}});
  }
  expect_consistent("humanoid", {{"seed", "3"}});
  expect_consistent("four-bar", {{"seed", "3"}});
  const auto seeded = [](const char* seed) {
    return systems().get("n-pendulum", "system").make({{"seed", seed}})->initial();
  };
  EXPECT_EQ(seeded("5"), seeded("5"));
  EXPECT_NE(seeded("5")[9], seeded("6")[9]);
}

TEST(BeadRod, HumanoidWeighsWhatItShould) {
  const auto model = systems().get("humanoid", "system").make({{"mass", "80"}});
  EXPECT_EQ(model->dimension(), 78);
  EXPECT_EQ(model->holonomic_constraints<double>()->count(), 12U);
  EXPECT_EQ(model->holonomic_constraints<double>()->pattern().structure(), MatrixStructure::tree);
  // All the beads' weight: at rest in the air the centre of mass falls freely.
  const auto f = field_at<Quad>(formulations().get("dirac", "formulation").apply(model, {}),
                                initial_state<Quad>(*model));
  Quad weight(0);
  for (std::size_t k = 41; k < 78; k += 3) weight = weight - f[k];
  EXPECT_LE(abs(weight - Quad(80) * Real(9.81_r).quad()), Quad(1e-29));
}

// A pendulum of 1e5 bobs: linear memory and time, exact at its start.
TEST(BeadRod, AHundredThousandRods) {
  const auto raw = systems().get("n-pendulum", "system").make({{"bobs", "100000"}, {"seed", "0"}});
  EXPECT_EQ(raw->dimension(), 400000);
  const auto model = formulations().get("dirac", "formulation").apply(raw, {});
  const auto rate = field_at<double>(model, initial_state<double>(*model));
  // A straight horizontal chain at rest: every bob falls freely.
  for (std::size_t k = 0; k < 200000; k += 2) {
    ASSERT_EQ(rate[200000 + k], 0) << k;
    ASSERT_NEAR(rate[200000 + k + 1], -9.81, 1e-12) << k;
  }
}

}  // namespace
