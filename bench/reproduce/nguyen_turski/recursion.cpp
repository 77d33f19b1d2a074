// Nguyen & Turski, (3.8)-(3.17): the recursions, what breaks them and what mends them. Exact in rationals.
#include <pfaff/bench/reproduce/nguyen_turski/rows.hpp>
#include <pfaff/brackets/dirac/elimination.hpp>

namespace pfaff::nguyen_turski {

namespace {

ExactMatrix matrix(const std::vector<std::vector<Rational>>& rows) {
  ExactMatrix m(rows.size(), rows.front().size());
  for (std::size_t i = 0; i < m.rows(); ++i)
    for (std::size_t j = 0; j < m.columns(); ++j) m(i, j) = rows[i][j];
  return m;
}
std::vector<std::string> numbered(const std::string& letter, std::size_t n) {
  std::vector<std::string> names;
  for (std::size_t k = 1; k <= n; ++k) names.push_back(letter + std::to_string(k));
  return names;
}
std::string outcome(const ExactMatrix& w, Symmetry symmetry, const std::vector<std::size_t>& order,
                    const std::vector<std::string>& names) {
  return describe(plain_recursion(w, symmetry, order), symmetry, order, names);
}

/// The entries of the elements after `count`, as the library's recursion leaves them after `steps` steps.
Numbers recursive(const ExactMatrix& g, Symmetry symmetry, std::size_t steps, std::size_t count) {
  Elimination<Rational> recursion(g, symmetry, ExactMatrix(0, 0), counted(g.rows()));
  for (std::size_t k = 0; k < steps; ++k) {
    Pivot<Rational> pivot{{k}, {k}, {}};
    if (symmetry == Symmetry::skew) pivot.rows = pivot.columns = {2 * k, 2 * k + 1};
    recursion.eliminate(pivot);
  }
  Numbers left;
  for (std::size_t i = count; i < g.rows(); ++i)
    for (std::size_t j = count; j < g.rows(); ++j) left.push_back(static_cast<Quad>(recursion(i, j)));
  return left;
}

void general(Rows& rows) {
  ExactSamples samples(6);
  for (const auto& [symmetry, kind] :
       {std::pair{Symmetry::symmetric, "symmetric"}, {Symmetry::none, "general"}}) {
    const ExactMatrix g = symmetry == Symmetry::symmetric ? samples.symmetric(5) : samples.any(5, 5);
    for (std::size_t m = 1; m <= 3; ++m)
      rows.reproduced("(3.8)-(3.10)",
                      std::string("Theorem 1, ") + kind + " bracket, level " + std::to_string(m),
                      quads(dirac_brackets(g, m)), recursive(g, symmetry, m, m));
  }
  const ExactMatrix g = samples.any(5, 5);  // alpha: 2 constraints, then phi_3, f, g
  const auto m = [&](std::initializer_list<std::size_t> i, std::initializer_list<std::size_t> j) {
    return minor_of(g, counted(2, i), counted(2, j));
  };
  const Rational whole = m({2, 3}, {2, 4}) / m({2}, {2});
  rows.reproduced("(3.11)-(3.14)", "the step of the proof",
                  quads({m({3}, {4}) / m({}, {}) - m({3}, {2}) * m({2}, {4}) / (m({}, {}) * m({2}, {2}))}),
                  quads({whole}));
  // The condition: leading minors. A vanishing minor that does not lead is harmless, ...
  const ExactMatrix works = matrix({{1, 2}, {2, 0}});
  const bool harmless = plain_recursion(works, Symmetry::symmetric, counted(2)).works;
  // ... one that leads is not.
  const ExactMatrix breaks = matrix({{1, 1, 0}, {1, 1, 1}, {0, 1, 0}});
  const bool broken = !plain_recursion(breaks, Symmetry::symmetric, counted(3)).works;
  rows.claim("Theorem 1", "when the recursion works", "all main minors of W must not vanish",
             outcome(works, Symmetry::symmetric, counted(2), numbered("phi", 2)), harmless ? 1 : 0, broken,
             "Theorem 1: the leading principal minors only");
}

void break_downs(Rows& rows) {
  const Rational a = Rational(7) / Rational(3);
  const ExactMatrix w = matrix({{0, a}, {a, 0}});
  const auto names = numbered("x", 2);
  const auto plain = plain_recursion(w, Symmetry::symmetric, counted(2));
  const auto pivoted = classify(w, Symmetry::symmetric);
  rows.qualitative("Example 3.1", "the recursion is inapplicable", "<phi1, phi1> = 0 = <phi2, phi2>",
                   outcome(w, Symmetry::symmetric, counted(2), names), 0, 0,
                   !plain.works && pivoted.regular() && pivoted.pivots.size() == 1,
                   "breaks down in either order; one pivot of two constraints takes them together");
  const ExactMatrix u = matrix({{1, 1}, {1, -1}});
  const auto combined = plain_recursion(u * w * u.transposed(), Symmetry::symmetric, counted(2));
  rows.reproduced("Example 3.1", "pivots of x1 + x2, x1 - x2", quads({Rational(2) * a, Rational(-2) * a}),
                  quads(combined.pivots));
  ExactSamples samples(7);
  ExactMatrix g = samples.symmetric(4);
  g(0, 0) = g(1, 1) = 0;
  g(0, 1) = g(1, 0) = a;
  ExactMatrix change = ExactMatrix::identity(4);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) change(i, j) = u(i, j);
  ExactMatrix printed(2, 2);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j)
      printed(i, j) = g(2 + i, 2 + j) - (g(2 + i, 0) * g(1, 2 + j) + g(2 + i, 1) * g(0, 2 + j)) / a;
  rows.reproduced("Example 3.1", "the bracket in x1, x2", quads(printed),
                  recursive(change * g * change.transposed(), Symmetry::symmetric, 2, 2));
  const ExactMatrix minor = matrix({{1, 1, 0}, {1, 1, 1}, {0, 1, 0}});
  rows.qualitative(
      "(3.8)", "break-down at a second leading minor", "-",
      outcome(minor, Symmetry::symmetric, counted(3), numbered("phi", 3)), 0, 0,
      plain_recursion(minor, Symmetry::symmetric, counted(3)).at == std::vector<std::size_t>{1} &&
          classify(minor, Symmetry::symmetric).regular(),
      "W is regular; pivots find an order or a pair");
}

void skew(Rows& rows) {
  ExactSamples samples(8);
  const ExactMatrix g = samples.skew(8);
  for (std::size_t m = 1; m <= 3; ++m)
    rows.reproduced("(3.15), (3.16)", "Theorem 2, level " + std::to_string(m),
                    quads(dirac_brackets(g, 2 * m)), recursive(g, Symmetry::skew, m, 2 * m));
  const auto m = [&](std::initializer_list<std::size_t> i, std::initializer_list<std::size_t> j) {
    return minor_of(g, counted(2, i), counted(2, j));
  };
  rows.reproduced("(3.17)", "Dirac bracket of four constraints",
                  quads({m({2, 3, 4}, {2, 3, 5}) / m({2, 3}, {2, 3})}), quads({dirac_brackets(g, 4)(0, 1)}));
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
  const std::vector<std::size_t> pairs{0, 3, 1, 4, 2, 5};
  const auto first = plain_recursion(w, Symmetry::skew, counted(6));
  rows.qualitative("(3.15)", "holonomic constraints, all phi first", "-",
                   outcome(w, Symmetry::skew, counted(6), names), 0, 0,
                   !first.works && first.pivots.empty() && classify(w, Symmetry::skew).regular(),
                   "breaks down at once, as {phi1, phi2} = 0, though W is regular");
  std::vector<Rational> ratios;
  for (std::size_t k = 1; k <= 3; ++k)
    ratios.push_back(determinant(s.block(0, 0, k, k)) / determinant(s.block(0, 0, k - 1, k - 1)));
  rows.reproduced("(3.15)", "phi1, phit1, phi2, ...: pivots det S_k / det S_(k-1)", quads(ratios),
                  quads(plain_recursion(w, Symmetry::skew, pairs).pivots));
}

void semimetric(Rows& rows) {
  ExactSamples samples(9);
  const ExactMatrix b = samples.any(6, 7), g = b * b.transposed(), reduced = dirac_brackets(g, 3);
  bool positive = true;
  for (std::size_t k = 1; k <= 3; ++k)
    positive = positive && determinant(reduced.block(0, 0, k, k)) >= Rational(0);
  rows.qualitative("Prop. 4", "the Dirac bracket of a semimetric one is semimetric", "<f, f>_D >= 0",
                   to_string(static_cast<Quad>(reduced(0, 0)), 4), 0, 0,
                   positive && plain_recursion(g, Symmetry::symmetric, counted(3)).works,
                   "leading minors of <f_i, f_j>_D are not negative, and the recursion does not break down");
  const Rational discriminant = g(0, 3) * g(0, 3) - g(3, 3) * g(0, 0);
  rows.claim("Prop. 4", "discriminant", ">= 0", to_string(static_cast<Quad>(discriminant), 4),
             std::abs(static_cast<double>(discriminant)), discriminant < Rational(0),
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
