// Equations whose text is put to the test: random tapes with names that no language likes.
#pragma once

#include <random>

#include <pfaff/core/emit/equations.hpp>

#include "random_formula.hpp"

namespace pfaff::testing {

/// A formula of arithmetic, branches and linear systems alone: rational where its arguments are. Its numbers
/// grow slowly enough to be computed exactly.
struct RationalFormula {
  unsigned seed;
  int inputs, outputs, operations;

  void operator()(const Recorded& t, In<Recorded> z, Out<Recorded> out) const {
    std::mt19937 random(seed);
    std::vector<Recorded> x(z.begin(), z.end());
    x.push_back(t);
    const std::size_t atoms = x.size();
    const auto any = [&] { return x[random() % x.size()]; };
    const auto atom = [&] { return x[random() % atoms]; };
    for (int k = 0; k < operations; ++k) {
      const Recorded a = any(), b = any(), c = atom(), d = atom();
      switch (random() % 8) {
        case 0:
          x.push_back(a - (b - c));
          break;
        case 1:
          x.push_back(a * (c / (d * d + 3)));
          break;
        case 2:
          x.push_back(-(a + c) + 0.3_r * b);
          break;
        case 3:
          x.push_back((a + d) / (c * c + Real::fraction(1, 7)) / 3);
          break;
        case 4:
          x.push_back(select(a - b, -c, d * d));
          break;
        case 5:
          x.push_back(-(c * -d) * (a - 2));
          break;
        case 6: {
          const std::vector<Recorded> matrix{c + 5, d, Recorded(1), d * c - 4}, right{a, c};
          for (const Recorded& s : solve(matrix, right)) x.push_back(s);
          break;
        }
        default: {  // the first pivot is zero
          const std::vector<Recorded> matrix{Recorded(0), c + 3, Recorded(2), d - 5,      Recorded(1),
                                             c,           c * d, Recorded(1), Recorded(4)};
          const std::vector<Recorded> right{Recorded(0), a, d};
          for (const Recorded& s : solve(matrix, right)) x.push_back(s);
          break;
        }
      }
    }
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = x[x.size() - 1 - k] - any();
  }
};

/// A tape with names: four coordinates and two parameters, one result for each coordinate and one more.
inline Equations named(Tape tape, const std::string& system) {
  Equations equations;
  equations.system = system;
  equations.method = "random";
  equations.tape = std::move(tape);
  equations.coordinates = {{"q_1", "m"}, {"q1", "kg m^2/s"}, {"lambda", ""}, {"E", "1"}};
  equations.parameters = {{"end", "m/s^2"}, {"results", "kg"}};
  equations.parameter_values = {Real(1), Real(2)};
  equations.further_outputs = {"multiplier_1"};
  return equations;
}
inline Equations random_equations(unsigned seed, int operations, bool special = false) {
  return named(RandomFormula{seed, 6, 5, operations, special}.tape(), "random-" + std::to_string(seed));
}
inline Equations rational_equations(unsigned seed, int operations) {
  return named(record(6, 5, RationalFormula{seed, 6, 5, operations}), "rational-" + std::to_string(seed));
}

}  // namespace pfaff::testing
