// The field and the structure that are derived from the action form of a system, against both written out by
// hand, and conserved quantities along its solutions.
#include <gtest/gtest.h>

#include <functional>

#include "../formula_values.hpp"
#include "samples.hpp"
#include "taylor_flow.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

/// A system with the parameters P, in the order of its list, and what it should be.
struct Expected {
  const char* system;
  Assignments parameters;
  std::function<Numbers(const Numbers& parameters, Quad t, const Numbers& z)> field;
  /// K_ij for i < j, row by row.
  std::function<Numbers(const Numbers& parameters, Quad t, const Numbers& z)> structure;
};

// The entries above the diagonal of [[0, -D], [D, 0]] with D = diag(d).
Numbers canonical(const Numbers& d) {
  const std::size_t n = d.size();
  Numbers entries;
  for (std::size_t i = 0; i < 2 * n; ++i)
    for (std::size_t j = i + 1; j < 2 * n; ++j) entries.push_back(j == i + n ? -d[i] : Quad(0));
  return entries;
}

// r'' + nu r' + site force + springs, parameters count, nu, kappa; accelerations by the springs' full matrix.
Numbers chain_field(const Numbers& p, const Numbers& z, Quad (*force)(Quad)) {
  const std::size_t n = z.size() / 2;
  Numbers rate(z.begin() + static_cast<std::ptrdiff_t>(n), z.end());
  for (std::size_t i = 0; i < n; ++i) {
    Quad sum = force(z[i]) - p[1] * z[n + i];
    for (std::size_t j = 0; j < n; ++j)
      if (i == j + 1 || j == i + 1) sum += p[2] * (z[j] - z[i]);
    rate.push_back(sum);
  }
  return rate;
}
Numbers chain_structure(const Numbers& p, Quad t, const Numbers& z) {
  return canonical(Numbers(z.size() / 2, exp(p[1] * t)));
}

std::vector<Expected> written_out() {
  return {
      {"lotka-volterra",
       {{"alpha", "0.7"}, {"beta", "1.3"}, {"gamma", "2.1"}, {"delta", "0.9"}},
       [](const Numbers& p, Quad, const Numbers& z) {
         return Numbers{z[0] * (p[0] - p[1] * z[1]), z[1] * (p[3] * z[0] - p[2])};
       },
       [](const Numbers&, Quad, const Numbers& z) { return Numbers{Quad(1) / (z[0] * z[1])}; }},
      {"driven-duffing",
       {{"nu", "0.3"}, {"a", "-1.2"}, {"b", "0.8"}, {"f", "0.5"}, {"omega", "1.4"}},
       [](const Numbers& p, Quad t, const Numbers& z) {
         return Numbers{z[1], p[3] * cos(p[4] * t) - p[0] * z[1] - p[1] * z[0] - p[2] * z[0] * z[0] * z[0]};
       },
       [](const Numbers& p, Quad t, const Numbers&) { return canonical({exp(p[0] * t)}); }},
      {"damped-relativistic-oscillator",
       {{"nu", "0.2"}, {"k", "0.7"}},
       // (c v)' = c^3 v', c = (1 - v^2)^{-1/2}.
       [](const Numbers& p, Quad, const Numbers& z) {
         const Quad c = Quad(1) / sqrt((Quad(1) - z[1]) * (Quad(1) + z[1]));
         const Quad force = -p[0] * c * z[1] - z[0] - p[1] * z[0] * z[0] * z[0];
         return Numbers{z[1], force / (c * c * c)};
       },
       [](const Numbers& p, Quad t, const Numbers& z) {
         const Quad c = Quad(1) / sqrt((Quad(1) - z[1]) * (Quad(1) + z[1]));
         return canonical({exp(p[0] * t) * c * c * c});
       }},
      {"hojman-urrutia",
       {},
       [](const Numbers&, Quad, const Numbers& z) {
         return Numbers{z[2], z[3], -z[3], -z[1]};
       },
       [](const Numbers&, Quad, const Numbers&) {
         return Numbers{Quad(-1), Quad(-1), Quad(0), Quad(0), Quad(0), Quad(-1)};
       }},
      {"magnetic-planar",
       {{"b0", "0.8"}, {"b2", "-0.6"}, {"k", "0.3"}},
       [](const Numbers& p, Quad, const Numbers& z) {
         const Quad b = p[0] + p[1] * (z[0] * z[0] + z[1] * z[1]);
         return Numbers{z[2], z[3], b * z[3] - p[2] * z[0], -b * z[2] - p[2] * z[1]};
       },
       [](const Numbers& p, Quad, const Numbers& z) {
         const Quad b = p[0] + p[1] * (z[0] * z[0] + z[1] * z[1]);
         return Numbers{b, Quad(-1), Quad(0), Quad(0), Quad(-1), Quad(0)};
       }},
      {"damped-bead-in-bowl",
       {{"nu", "0.3"}, {"c", "0.7"}, {"g", "2"}},
       // M v' = -nu M v - c^2 |v|^2 q - g c q, solved with the 2 x 2 matrix M by Cramer's rule.
       [](const Numbers& p, Quad, const Numbers& z) {
         const Quad s = p[1] * p[1], a = Quad(1) + s * z[0] * z[0], b = s * z[0] * z[1],
                    d = Quad(1) + s * z[1] * z[1];
         const Quad pull = s * (z[2] * z[2] + z[3] * z[3]) + p[2] * p[1];
         const Quad f = -p[0] * (a * z[2] + b * z[3]) - pull * z[0];
         const Quad h = -p[0] * (b * z[2] + d * z[3]) - pull * z[1];
         const Quad determinant = a * d - b * b;
         return Numbers{z[2], z[3], (d * f - b * h) / determinant, (a * h - b * f) / determinant};
       },
       [](const Numbers& p, Quad t, const Numbers& z) {
         const Quad s = p[1] * p[1], e = exp(p[0] * t), m12 = -e * s * z[0] * z[1];
         return Numbers{e * s * (z[1] * z[2] - z[0] * z[3]),
                        -e * (Quad(1) + s * z[0] * z[0]),
                        m12,
                        m12,
                        -e * (Quad(1) + s * z[1] * z[1]),
                        Quad(0)};
       }},
      {"point-vortices",
       {{"count", "5"}, {"gamma1", "1.5"}, {"gamma2", "-0.7"}, {"gamma3", "0.4"}, {"gamma4", "2"}},
       [](const Numbers& p, Quad, const Numbers& z) {
         Numbers rate(10, Quad(0));
         for (std::size_t i = 0; i < 5; ++i)
           for (std::size_t j = 0; j < 5; ++j) {
             if (i == j) continue;
             const Quad x = z[i] - z[j], y = z[5 + i] - z[5 + j], square = x * x + y * y;
             rate[i] -= p[1 + j % 4] * y / square;
             rate[5 + i] += p[1 + j % 4] * x / square;
           }
         return rate;
       },
       [](const Numbers& p, Quad, const Numbers&) {
         return canonical({p[1], p[2], p[3], p[4], p[1]});
       }},
      {"dense-time-structure",
       {{"c", "0.35"}, {"omega", "1.7"}, {"lambda", "0.4"}},
       nullptr,
       [](const Numbers& p, Quad t, const Numbers&) {
         const Quad cosine = cos(p[1] * t), sine = sin(p[1] * t), two(2);
         return Numbers{p[0] * (two + cosine), -(two + sine),   p[0] * (two + sine),
                        p[0] * (two - cosine), -(two + cosine), p[0] * (two - sine)};
       }},
      {"magnetic-induction",
       {{"b0", "1.3"}, {"epsilon", "0.4"}, {"omega", "1.7"}, {"k", "0.6"}, {"lambda", "0.3"}},
       // Lorentz's force, the induced field -b' (-y, x)/2 in full.
       [](const Numbers& p, Quad t, const Numbers& z) {
         const Quad b = p[0] * (Quad(1) + p[1] * cos(p[2] * t)), slope = -p[0] * p[1] * p[2] * sin(p[2] * t);
         const Quad pull = p[3] + p[4] * (z[0] * z[0] + z[1] * z[1]);
         return Numbers{z[2], z[3], b * z[3] - pull * z[0] + slope * z[1] / Quad(2),
                        -(b * z[2]) - pull * z[1] - slope * z[0] / Quad(2)};
       },
       [](const Numbers& p, Quad t, const Numbers&) {
         const Quad b = p[0] * (Quad(1) + p[1] * cos(p[2] * t));
         return Numbers{b, Quad(-1), Quad(0), Quad(0), Quad(-1), Quad(0)};
       }},
      {"coupled-damped-oscillators",
       {{"count", "4"}, {"nu", "0.2"}, {"kappa", "0.6"}},
       [](const Numbers& p, Quad, const Numbers& z) { return chain_field(p, z, [](Quad r) { return -r; }); },
       chain_structure},
      {"coupled-damped-pendula",
       {{"count", "4"}, {"nu", "0.2"}, {"kappa", "0.6"}},
       [](const Numbers& p, Quad, const Numbers& z) {
         return chain_field(p, z, [](Quad r) { return -sin(r); });
       },
       chain_structure}};
}

// A few dozen roundings of 1e-34 each.
constexpr double written_out_bound = 1e-31;

TEST(EquationsOfMotion, AreWhatTheActionFormGives) {
  for (const Expected& expected : written_out()) {
    SCOPED_TRACE(expected.system);
    const auto model = systems().get(expected.system, "system").make(expected.parameters);
    Numbers parameters, wrong;
    for (const auto& [name, value] : expected.parameters) {
      parameters.push_back(Real::parse(value)->quad());
      wrong.push_back(parameters.back() + (name == "count" ? Quad(0) : Quad(1e-9)));
    }
    const std::size_t n = static_cast<std::size_t>(model->dimension());
    Samples samples(61);
    bool field_control = false, structure_control = false, varies = false;
    for (int point = 0; point < 20; ++point) {
      const Numbers z = samples.state(*model, 0.3);
      const Quad t = samples.quad(0.1, 3);
      Numbers k;
      const Numbers full = values(model->tape(Formula::structure), t, z);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n; ++j) k.push_back(full[i * n + j]);
      EXPECT_LE(relative_distance(k, expected.structure(parameters, t, z)), written_out_bound);
      structure_control |= relative_distance(k, expected.structure(wrong, t, z)) > 1e-12;
      varies |= relative_distance(expected.structure(parameters, t + Quad(1), samples.state(*model, 0.3)),
                                  expected.structure(parameters, t, z)) > 1e-3;
      if (expected.field == nullptr) continue;
      const auto derived = model->derived(Formula::field);
      ASSERT_NE(derived, nullptr);
      EXPECT_LE(relative_distance(values(derived, t, z), expected.field(parameters, t, z)),
                written_out_bound);
      field_control |= relative_distance(values(derived, t, z), expected.field(wrong, t, z)) > 1e-12;
    }
    // Controls: with every parameter off by 1e-9 they differ, where parameters enter.
    const bool constant = model->tape(Formula::structure)->autonomous() && !varies;
    EXPECT_EQ(field_control, expected.field != nullptr && !parameters.empty());
    EXPECT_EQ(structure_control,
              expected.system != std::string("lotka-volterra") && !(constant && parameters.empty()));
  }
}

TEST(EquationsOfMotion, ADenseStructureStaysRegular) {
  // The Pfaffian for the largest c, over a period; K has no zero off the diagonal, and no chart is known.
  const auto model = systems().get("dense-time-structure", "system").make({{"c", "0.45"}});
  for (int step = 0; step < 1000; ++step) {
    const Numbers k = values(model->tape(Formula::structure), Quad(step * 0.0062832), Numbers(4, Quad(0)));
    EXPECT_LT(k[1] * k[11] - k[2] * k[7] + k[3] * k[6], Quad(-0.1)) << step;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) EXPECT_TRUE(i == j || abs(k[4 * i + j]) > Quad(0.4));
  }
}

TEST(EquationsOfMotion, ConservedQuantitiesStayAlongSolutions) {
  int found = 0;
  for (const Expected& expected : written_out()) {
    const auto model = systems().get(expected.system, "system").make(expected.parameters);
    Numbers start;
    for (const Real& x : model->initial()) start.push_back(x.quad());
    const Quad t0(0.7), elapsed(3);
    const Numbers end = taylor_flow(model->tape(Formula::field), t0, start, elapsed);
    const auto invariants = model->tape(Formula::invariants);
    const Numbers before = values(invariants, t0, start), after = values(invariants, t0 + elapsed, end);
    for (std::size_t k = 0; k < before.size(); ++k) {
      SCOPED_TRACE(std::string(expected.system) + " " + model->invariants()[k].name);
      const Quad change = after[k] - before[k];
      if (model->invariants()[k].behaviour == Behaviour::conserved) {
        ++found;
        EXPECT_LE(abs(change), Quad(1e-29) * (Quad(1) + abs(before[k])));  // the flow: 1e-32 a unit of |X| t
      } else if (model->invariants()[k].behaviour == Behaviour::decreasing) {
        EXPECT_LT(change, Quad(-1e-3));
      } else {
        EXPECT_GT(abs(change), Quad(1e-3));
      }
    }
  }
  EXPECT_EQ(found, 1 + 4 + 2 + 1 + 4 + 1 + 1);
}

TEST(EquationsOfMotion, OutsideItsChartLotkaVolterraIsNotANumber) {
  const auto model = systems().get("lotka-volterra", "system").make({});
  for (const Numbers& z : {Numbers{Quad(-1), Quad(1)}, Numbers{Quad(1), Quad(-1)}, Numbers{Quad(0), Quad(1)}})
    for (const Formula formula : {Formula::chart, Formula::birkhoffian, Formula::one_form}) {
      bool finite = true;
      for (const Quad x : values(model->tape(formula), Quad(0), z)) finite = finite && isfinite(x);
      EXPECT_FALSE(finite);
    }
}

TEST(EquationsOfMotion, AVortexWithoutStrengthIsRefused) {
  const SystemPlugin& plugin = systems().get("point-vortices", "system");
  EXPECT_THROW(static_cast<void>(plugin.make({{"gamma3", "0"}})), InputError);
  EXPECT_NO_THROW(static_cast<void>(plugin.make({{"gamma3", "0"}, {"count", "2"}})));
}

TEST(EquationsOfMotion, OfChainsAndTheirEnergiesCostLinearlyInTheLength) {
  for (const char* name : {"coupled-damped-pendula", "coupled-damped-oscillators"}) {
    const auto size = [&](const char* count, Formula formula) {
      return systems().get(name, "system").make({{"count", count}})->tape(formula)->code.size();
    };
    for (const Formula formula :
         {Formula::field, Formula::birkhoffian, Formula::chart, Formula::chart_hamiltonian}) {
      const std::size_t once = size("64", formula), twice = size("128", formula);
      EXPECT_LE(once, 20U * 64U) << name;
      EXPECT_LE(twice, 2 * once + 2) << name;
      EXPECT_GE(twice, 3 * once / 2) << name;
    }
  }
}

}  // namespace
