// Nguyen & Turski, (3.8)-(3.17): the recursions, where they break down and which order avoids that. Exact in
// rationals.
#include <pfaff/papers/nguyen_turski/rows.hpp>
#include <pfaff/papers/printed/brackets.hpp>

namespace pfaff::nguyen_turski {

namespace {

using RationalTable = printed::Table<Rational>;
using List = std::initializer_list<std::size_t>;

std::vector<std::string> numbered(const std::string& letter, std::size_t n) {
  std::vector<std::string> names;
  for (std::size_t k = 1; k <= n; ++k) names.push_back(letter + std::to_string(k));
  return names;
}
std::string outcome(const ExactMatrix& w, Symmetry symmetry, const std::vector<std::size_t>& order,
                    const std::vector<std::string>& names) {
  return describe(plain_recursion(w, symmetry, order), symmetry, order, names);
}
// The brackets of the elements after the first `count`.
RationalTable after(const RationalTable& g, std::size_t count) {
  const auto rest = printed::counted(count, g.size());
  return printed::part(g, rest, rest);
}

// Each level of (3.8) beside the engine's Dirac bracket of as many constraints, and the engine's recursion
// beside (3.9): Theorem 1 says that all of these agree.
void general(Rows& rows) {
  ExactSamples samples(6);
  for (const auto& [symmetry, kind] :
       {std::pair{Symmetry::symmetric, "symmetric"}, {Symmetry::none, "general"}}) {
    const ExactMatrix g = symmetry == Symmetry::symmetric ? samples.symmetric(5) : samples.any(5, 5);
    RationalTable level = table_of(g);
    for (std::size_t m = 1; m <= 3; ++m) {
      const std::string which = std::string(kind) + " bracket, level " + std::to_string(m);
      level = printed::symmetric_step(level, m - 1);
      rows.reproduced("(3.8), (3.10), Theorem 1", which, quads(after(level, m)),
                      quads(engine_brackets(g, m, symmetry)));
      rows.reproduced("(3.9), (3.10)", which, quads(printed::dirac_brackets(table_of(g), m)),
                      quads(engine_brackets(g, m, symmetry, RecursiveLiteralDirac{})));
    }
  }
  const ExactMatrix g = samples.any(5, 5);  // alpha: 2 constraints, then phi_3, f, g
  const RationalTable table = table_of(g);
  const auto m = [&](List i, List j) {
    return printed::bordered(table, printed::counted(0, 2, i), printed::counted(0, 2, j));
  };
  const Rational whole = engine_brackets(g, 3, Symmetry::none)(0, 1);
  rows.reproduced("(3.12)", "the step of the proof", quads({m({2, 3}, {2, 4}) / m({2}, {2})}),
                  quads({whole}));
  rows.reproduced("(3.13)", "the step of the proof",
                  quads({m({3}, {4}) / m({}, {}) - m({3}, {2}) * m({2}, {4}) / (m({}, {}) * m({2}, {2}))}),
                  quads({whole}));
  const RationalTable second = printed::dirac_brackets(table, 2);  // of phi_3, f, g
  rows.reproduced("(3.14)", "the step of the proof",
                  quads({second[1][2] - second[1][0] * second[0][2] / second[0][0]}), quads({whole}));
  // The condition is on leading minors. A vanishing minor that does not lead is harmless.
  const ExactMatrix works = matrix_of({{1, 2}, {2, 0}});
  // A vanishing minor that leads breaks the recursion.
  const ExactMatrix breaks = matrix_of({{1, 1, 0}, {1, 1, 1}, {0, 1, 0}});
  rows.claim("Theorem 1", "when the recursion works",
             {"all main minors of W must not vanish",
              outcome(works, Symmetry::symmetric, printed::counted(0, 2), numbered("phi", 2))},
             {is_true(plain_recursion(works, Symmetry::symmetric, printed::counted(0, 2)).works),
              is_true(!plain_recursion(breaks, Symmetry::symmetric, printed::counted(0, 3)).works)},
             "Theorem 1: leading minors only");
}

void break_downs(Rows& rows) {
  const Rational a = Rational(7) / Rational(3);
  const ExactMatrix w = matrix_of({{0, a}, {a, 0}});
  const auto names = numbered("x", 2);
  const auto two = printed::counted(0, 2), three = printed::counted(0, 3);
  const auto pivoted = classify(w, Symmetry::symmetric);
  rows.qualitative("Example 3.1", "inapplicable",
                   {"<phi1, phi1> = 0 = <phi2, phi2>", outcome(w, Symmetry::symmetric, two, names)},
                   {is_true(!plain_recursion(w, Symmetry::symmetric, two).works), is_true(pivoted.regular()),
                    is_true(pivoted.pivots.size() == 1)},
                   "no order works; a pivot of both constraints does");
  const ExactMatrix u = matrix_of({{1, 1}, {1, -1}});
  const auto combined = plain_recursion(u * w * u.transposed(), Symmetry::symmetric, two);
  rows.reproduced("Example 3.1", "pivots of x1 + x2, x1 - x2", quads({Rational(2) * a, Rational(-2) * a}),
                  quads(combined.pivots));
  ExactSamples samples(7);
  ExactMatrix g = samples.symmetric(4);
  g(0, 0) = g(1, 1) = 0;
  g(0, 1) = g(1, 0) = a;
  ExactMatrix change = ExactMatrix::identity(4);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) change(i, j) = u(i, j);
  std::vector<Rational> printed;
  for (std::size_t i = 2; i < 4; ++i)
    for (std::size_t j = 2; j < 4; ++j)
      printed.push_back(g(i, j) - (g(i, 0) * g(1, j) + g(i, 1) * g(0, j)) / a);
  rows.reproduced("Example 3.1", "the bracket, by x1 and x2", quads(printed),
                  quads(engine_brackets(g, 2, Symmetry::symmetric)));
  rows.reproduced("Example 3.1", "the bracket, by recursion in u1 and u2", quads(printed),
                  quads(engine_brackets(change * g * change.transposed(), 2, Symmetry::symmetric,
                                        RecursiveLiteralDirac{})));
  const ExactMatrix minor = matrix_of({{1, 1, 0}, {1, 1, 1}, {0, 1, 0}});
  rows.qualitative(
      "(3.8)", "second leading minor 0",
      {"-", outcome(minor, Symmetry::symmetric, three, numbered("phi", 3))},
      {is_true(plain_recursion(minor, Symmetry::symmetric, three).at == std::vector<std::size_t>{1}),
       is_true(classify(minor, Symmetry::symmetric).regular())},
      "breaks down though W is regular");
}

void skew(Rows& rows) {
  ExactSamples samples(8);
  const ExactMatrix g = samples.skew(8);
  const RationalTable table = table_of(g);
  RationalTable level = table;
  for (std::size_t m = 1; m <= 3; ++m) {
    level = printed::skew_step(level, m - 1);
    rows.reproduced("(3.15), (3.16), Theorem 2", "level " + std::to_string(m), quads(after(level, 2 * m)),
                    quads(engine_brackets(g, 2 * m, Symmetry::skew)));
    rows.reproduced("(3.16)", "by the engine's recursion, level " + std::to_string(m),
                    quads(printed::dirac_brackets(table, 2 * m)),
                    quads(engine_brackets(g, 2 * m, Symmetry::skew, RecursiveLiteralDirac{})));
  }
  const auto m = [&](List i, List j) {
    return printed::bordered(table, printed::counted(0, 2, i), printed::counted(0, 2, j));
  };
  rows.reproduced("(3.17)", "Dirac bracket of four constraints",
                  quads({m({2, 3, 4}, {2, 3, 5}) / m({2, 3}, {2, 3})}),
                  quads({engine_brackets(g, 4, Symmetry::skew)(0, 1)}));
  // Three holonomic constraints: W = [[0, S], [-S^T, A]].
  const ExactMatrix b = samples.any(3, 5), s = b * b.transposed(), a = samples.skew(3);
  ExactMatrix w(6, 6);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      w(i, 3 + j) = s(i, j);
      w(3 + i, j) = -s(j, i);
      w(3 + i, 3 + j) = a(i, j);
    }
  const std::vector<std::string> names{"phi1", "phi2", "phi3", "phit1", "phit2", "phit3"};
  const std::vector<std::size_t> pairs{0, 3, 1, 4, 2, 5}, plain = printed::counted(0, 6);
  const auto first = plain_recursion(w, Symmetry::skew, plain);
  rows.qualitative(
      "(3.15)", "holonomic, all phi first", {"-", outcome(w, Symmetry::skew, plain, names)},
      {is_true(!first.works), is_true(first.pivots.empty()), is_true(classify(w, Symmetry::skew).regular())},
      "breaks down at once, though W is regular");
  std::vector<Rational> ratios;
  const auto leading = [&](std::size_t k) {
    return printed::bordered(table_of(s), printed::counted(0, k), printed::counted(0, k));
  };
  for (std::size_t k = 1; k <= 3; ++k) ratios.push_back(leading(k) / leading(k - 1));
  rows.reproduced("(3.15)", "phi1, phit1, phi2, ..: pivots det S_k / det S_(k-1)", quads(ratios),
                  quads(plain_recursion(w, Symmetry::skew, pairs).pivots));
}

// Proposition 4 and its proof, for one constraint phi and one function f.
void semimetric(Rows& rows) {
  ExactSamples samples(9);
  const ExactMatrix b = samples.any(6, 7), g = b * b.transposed(),
                    reduced = engine_brackets(g, 3, Symmetry::symmetric);
  std::vector<Condition> positive{
      is_true(plain_recursion(g, Symmetry::symmetric, printed::counted(0, 3)).works)};
  for (std::size_t k = 1; k <= 3; ++k)
    positive.push_back(at_least(static_cast<double>(determinant(reduced.block(0, 0, k, k))), 0));
  rows.qualitative("Proposition 4", "semimetric brackets",
                   {"<f, f>_D >= 0", shown(static_cast<double>(reduced(0, 0)))}, positive,
                   "no break-down, and minors of <,>_D are not negative");
  ExactMatrix pair(2, 2);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) pair(i, j) = g(3 * i, 3 * j);
  const auto first = static_cast<double>(engine_brackets(pair, 1, Symmetry::symmetric)(0, 0));
  const auto discriminant = static_cast<double>(g(0, 3) * g(0, 3) - g(3, 3) * g(0, 0));
  rows.claim("Proposition 4", "discriminant", {">= 0", shown(discriminant)},
             {at_most(discriminant, -clearly), at_least(first, 0)},
             "Proposition 4: the discriminant is <= 0 (Cauchy-Schwarz)");
}

}  // namespace

void recursion_rows(Rows& rows) {
  general(rows);
  break_downs(rows);
  semimetric(rows);
  skew(rows);
}

}  // namespace pfaff::nguyen_turski
