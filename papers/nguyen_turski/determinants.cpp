// Nguyen & Turski, (3.2)-(3.7), (3.18), (3.19): determinants, exact in rationals. The engine's determinants
// come from elimination, its brackets from the solvers of the Dirac bracket.
#include <pfaff/papers/nguyen_turski/rows.hpp>
#include <pfaff/papers/printed/brackets.hpp>

namespace pfaff::nguyen_turski {

namespace {

using List = std::initializer_list<std::size_t>;

// det of the first `count` and some more rows and columns, by the engine.
Rational engine_minor(const ExactMatrix& f, std::size_t count, List rows, List columns) {
  const auto i = printed::counted(0, count, rows), j = printed::counted(0, count, columns);
  ExactMatrix m(i.size(), j.size());
  for (std::size_t a = 0; a < i.size(); ++a)
    for (std::size_t b = 0; b < j.size(); ++b) m(a, b) = f(i[a], j[b]);
  return determinant(m);
}

// alpha and beta are the first three rows and columns; x, z (u), v and y, t (s), .. the others.
void tanner(Rows& rows) {
  ExactSamples samples(3);
  const ExactMatrix f = samples.any(6, 6);
  const printed::Table<Rational> table = table_of(f);
  const auto m = [&](List i, List j) {
    return printed::bordered(table, printed::counted(0, 3, i), printed::counted(0, 3, j));
  };
  const auto ours = [&](List i, List j) { return engine_minor(f, 3, {}, {}) * engine_minor(f, 3, i, j); };
  rows.reproduced("(3.2)", "Tanner's identity",
                  quads({m({3}, {3}) * m({4}, {5}) - m({3}, {5}) * m({4}, {3})}),
                  quads({ours({3, 4}, {3, 5})}));
  rows.reproduced("(3.3)", "Tanner's identity",
                  quads({m({3}, {3}) * m({4, 5}, {4, 5}) - m({3}, {4}) * m({4, 5}, {3, 5}) +
                         m({3}, {5}) * m({4, 5}, {3, 4})}),
                  quads({ours({3, 4, 5}, {3, 4, 5})}));
}

void formulas(Rows& rows) {
  ExactSamples samples(4);
  constexpr std::size_t count = 3;
  const ExactMatrix g = samples.any(count + 2, count + 2);
  const printed::Table<Rational> table = table_of(g);
  rows.reproduced("(3.5)", "Dirac bracket of a general bracket", quads(printed::dirac_brackets(table, count)),
                  quads(engine_brackets(g, count, Symmetry::none)));
  // The constraints' brackets with everything, which the engine's bracket has as well.
  const auto base = tensor_bracket([&](const auto&, auto, auto entries) {
    for (std::size_t k = 0; k < entries.size(); ++k) entries[k] = g.entries()[k];
  });
  const ExactMatrix all =
      bracket_matrix<Rational>(dirac(base, FirstCoordinates{count}, DenseDirac{}, Symmetry::none),
                               Rational(0), std::vector<Rational>(count + 2));
  Numbers left = quads(all.block(0, 0, count, count + 2)), right = quads(all.block(0, 0, count + 2, count));
  left.insert(left.end(), right.begin(), right.end());
  rows.reproduced("(3.5)", "constraints are Casimirs, both sides", zeros(left.size()), left);
  rows.reproduced("(3.6), (3.7), Proposition 3", "bordered determinants",
                  quads(printed::determinant_formula(table, count)),
                  quads(engine_brackets(g, count, Symmetry::none, BorderedDirac{})));
}

void squares(Rows& rows) {
  ExactSamples samples(5);
  constexpr std::size_t count = 4;
  const ExactMatrix g = samples.skew(count + 2);
  const printed::Table<Rational> table = table_of(g);
  const auto m = [&](List i, List j) {
    return printed::bordered(table, printed::counted(0, count, i), printed::counted(0, count, j));
  };
  const Rational bracket = engine_brackets(g, count, Symmetry::skew, PfaffianDirac{})(0, 1);
  rows.reproduced("(3.18), Proposition 5", "square of the skew Dirac bracket",
                  quads({m({4, 5}, {4, 5}) / m({}, {})}), quads({bracket * bracket}));
  const Rational mixed = engine_minor(g, count, {4}, {5});
  rows.reproduced("(3.19)", "determinants", quads({m({}, {}) * m({4, 5}, {4, 5})}), quads({mixed * mixed}));
}

}  // namespace

void determinant_rows(Rows& rows) {
  tanner(rows);
  formulas(rows);
  squares(rows);
}

}  // namespace pfaff::nguyen_turski
