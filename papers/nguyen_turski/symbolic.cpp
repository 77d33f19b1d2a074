// Nguyen & Turski, the numbers of section 4 about symbolic equations: how many brackets a step of the
// recursion needs, how the size of the equations grows, and what (4.7) saves against (4.2). Sizes are counts
// of operations, which no machine changes; one row compares times.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <numbers>
#include <set>

#include <pfaff/brackets/dirac/recursive_solvers.hpp>
#include <pfaff/core/linear/tridiagonal_inverse.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/recorder.hpp>
#include <pfaff/derive/derivation/derivation.hpp>
#include <pfaff/papers/nguyen_turski/rows.hpp>

namespace pfaff::nguyen_turski {

namespace {

// The literal recursion on numbers, whose memory holds each bracket once. Those of the last level but one are
// counted for `count` pairs of constraints on n positions and momenta.
std::size_t brackets_of_a_step(std::size_t n, std::size_t pairs) {
  const std::size_t dimension = 2 * n, count = 2 * pairs;
  const std::vector<double> zeros(dimension * count, 0.0);
  std::vector<double> gram(count * count, 0.0), result(dimension), brackets(count, 0.0);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j)
      gram[i * count + j] = i == j ? 0 : (i < j ? 1.0 : -1.0) / static_cast<double>(1 + i + j);
  const std::vector<double> covector(dimension, 1.0);
  const DiracData<double> data{dimension, count,    Symmetry::skew, zeros,    zeros,
                               gram,      covector, covector,       brackets, {}};
  const RecursiveLiteralDirac solver{};
  RecursiveLiteralDirac::Work<double> work(solver, dimension, count);
  (void)solver(data, result, work);
  std::size_t found = 0;
  for (const auto& [key, value] : work.known)
    if (key / ((count + dimension) * (count + 1)) == pairs - 1) ++found;
  return found;
}

std::shared_ptr<const Model> chain(int rods) {
  return systems()
      .get("chain-molecule", "system")
      .make({{"beads", std::to_string(rods + 1)},
             {"epsilon", "0"},
             {"charge", "0"},
             {"gravity", "9.81"},
             {"seed", "0"}});
}
double size_of(const char* method, int rods) {
  return static_cast<double>(operations(derive(*chain(rods), method).tape));
}
// The slope of log(size) over log(K) from K to 2 K.
double exponent(const char* method, int rods) {
  return std::log2(size_of(method, 2 * rods) / size_of(method, rods));
}

// The terms of |S(1..K)| when everything is multiplied out, by which formulas grow that share nothing.
double expanded_terms(int rods) {
  const auto rows = static_cast<std::size_t>(rods);
  const Tape tape = record(2 * rods - 1, 1, [&](const Recorded&, In<Recorded> z, Out<Recorded> out) {
    Tridiagonal<Recorded> s;
    s.diagonal.assign(z.begin(), z.begin() + rods);
    s.couplings.assign(z.begin() + rods, z.end());
    out[0] = leading_minors(s)[rows];
  });
  // A term more than there are sums, in the expression without sharing.
  std::vector<double> terms(tape.code.size(), 1);
  for (std::size_t k = 0; k < tape.code.size(); ++k) {
    const Instruction& i = tape.code[k];
    const auto of = [&](int slot) { return terms[static_cast<std::size_t>(slot)]; };
    if (i.operation == Operation::add || i.operation == Operation::subtract) terms[k] = of(i.a) + of(i.b);
    if (i.operation == Operation::multiply) terms[k] = of(i.a) * of(i.b);
  }
  return terms[static_cast<std::size_t>(tape.outputs[0])];
}

void brackets(Rows& rows) {
  for (const std::size_t n : {3U, 6U})
    rows.reproduced("6n + 3 brackets", "needed by the last step, n = " + std::to_string(n),
                    {Quad(static_cast<int>(6 * n + 3))}, {Quad(static_cast<int>(brackets_of_a_step(n, 3)))});
}

void growth(Rows& rows) {
  const double rate = std::log(expanded_terms(40) / expanded_terms(39));
  rows.qualitative("fits of computing times", "what nothing shared costs",
                   {"e^(0.49 K)", "e^(" + shown(rate) + " K)"},
                   {at_most(std::abs(rate - std::log(std::numbers::phi)), 1e-6)},
                   "the terms of |S| are Fibonacci numbers and grow by the golden ratio for each rod");
  struct Engine {
    const char* method;
    int rods;
    double bound;
  };
  for (const Engine& engine : {Engine{"ldl", 16, 1.02}, Engine{"minors", 16, 2}, Engine{"recursion", 8, 2.2},
                               Engine{"recursion-literal", 6, 2.2}, Engine{"bivector", 4, 3.2}}) {
    const double power = exponent(engine.method, engine.rods);
    rows.qualitative("fits of computing times", std::string("operations by ") + engine.method,
                     {std::string(engine.method).starts_with("recursion") ? "e^(1.06 K)" : "e^(0.49 K)",
                      "K^" + shown(power)},
                     {at_most(power, engine.bound)}, "with equal expressions shared the growth is a power");
  }
}

// The processor time that (4.2) takes to derive over that of (4.7): the quickest of a few of each, in turns.
double time_ratio(int rods) {
  const auto model = chain(rods);
  const auto seconds = [&](const char* method) {
    const std::clock_t begin = std::clock();
    (void)derive(*model, method);
    return static_cast<double>(std::clock() - begin);
  };
  double full = std::numeric_limits<double>::infinity(), short_form = full;
  for (int k = 0; k < 5; ++k) {
    full = std::min(full, seconds("ldl"));
    short_form = std::min(short_form, seconds("simplified"));
  }
  return full / short_form;
}

void cost(Rows& rows) {
  const double ratio = size_of("ldl", 24) / size_of("simplified", 24);
  rows.qualitative("6-7 times quicker", "operations of (4.2) to those of (4.7)", {"6-7", shown(ratio)},
                   {at_least(ratio, 1.4), at_most(ratio, 2.5)},
                   "(4.7) is cheaper by the second solve; not by so much where expressions are shared");
  const double times = time_ratio(24);
  rows.qualitative(
      "6-7 times quicker", "time to derive (4.2) to that of (4.7)", {"6-7", shown(times)},
      {at_most(times, 6)},
      "measured anew each time, so that only the printed factor is judged; gradients and factors, "
      "which both need, take the larger part");
  const auto humanoid = systems().get("humanoid", "system").make({});
  const auto size = static_cast<double>(operations(derive(*humanoid, "ldl", FrictionForm::none).tape));
  rows.qualitative("9 minutes for a pair", "operations of all 39 pairs", {"9 minutes each", shown(size)},
                   {at_most(size, 2500)}, "the tree of rods is eliminated leaf first, in linear size");
}

}  // namespace

void symbolic_rows(Rows& rows) {
  brackets(rows);
  growth(rows);
  cost(rows);
}

}  // namespace pfaff::nguyen_turski
