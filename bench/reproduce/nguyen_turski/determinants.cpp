// Nguyen & Turski, (3.1)-(3.7), (3.18), (3.19): determinants, exact in rationals.
#include <pfaff/bench/reproduce/nguyen_turski/rows.hpp>

namespace pfaff::nguyen_turski {

namespace {

using List = std::initializer_list<std::size_t>;

void tanner(Rows& rows) {
  ExactSamples samples(3);
  const ExactMatrix f = samples.any(6, 6);
  // alpha and beta are the first three rows and columns; x, z (u), v and y, t (s), ... the others.
  const auto m = [&](List i, List j) { return minor_of(f, counted(3, i), counted(3, j)); };
  rows.reproduced("(3.2)", "Tanner's identity", quads({m({}, {}) * m({3, 4}, {3, 5})}),
                  quads({m({3}, {3}) * m({4}, {5}) - m({3}, {5}) * m({4}, {3})}));
  rows.reproduced("(3.3)", "Tanner's identity", quads({m({}, {}) * m({3, 4, 5}, {3, 4, 5})}),
                  quads({m({3}, {3}) * m({4, 5}, {4, 5}) - m({3}, {4}) * m({4, 5}, {3, 5}) +
                         m({3}, {5}) * m({4, 5}, {3, 4})}));
}

void bordered(Rows& rows) {
  ExactSamples samples(4);
  constexpr std::size_t count = 3;
  const ExactMatrix g = samples.any(count + 2, count + 2);
  const ExactMatrix dirac = dirac_brackets(g, count);
  // (3.5) with a constraint for an argument: the first row and column of brackets with f and g.
  const ExactMatrix c = inverse(g.block(0, 0, count, count));
  const ExactMatrix left =
      g.block(0, count, 1, 2) - g.block(0, 0, 1, count) * c * g.block(0, count, count, 2);
  const ExactMatrix right =
      g.block(count, 0, 2, 1) - g.block(count, 0, 2, count) * c * g.block(0, 0, count, 1);
  rows.reproduced("(3.5)", "constraints are Casimirs, both sides", zeros(4),
                  quads({left(0, 0), left(0, 1), right(0, 0), right(1, 0)}));
  const auto w = minor_of(g, counted(count), counted(count));
  Numbers quotients;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j)
      quotients.push_back(
          static_cast<Quad>(minor_of(g, counted(count, {count + i}), counted(count, {count + j})) / w));
  rows.reproduced("(3.6), (3.7)", "Prop. 3: quotient of bordered determinants", quotients, quads(dirac));
}

void squares(Rows& rows) {
  ExactSamples samples(5);
  constexpr std::size_t count = 4;
  const ExactMatrix g = samples.skew(count + 2);
  const Rational bracket = dirac_brackets(g, count)(0, 1);
  const auto m = [&](List i, List j) { return minor_of(g, counted(count, i), counted(count, j)); };
  rows.reproduced("(3.18)", "Prop. 5: square of the skew Dirac bracket",
                  quads({m({4, 5}, {4, 5}) / m({}, {})}), quads({bracket * bracket}));
  rows.reproduced("(3.19)", "Prop. 5: determinants", quads({m({}, {}) * m({4, 5}, {4, 5})}),
                  quads({m({4}, {5}) * m({4}, {5})}));
}

}  // namespace

void determinant_rows(Rows& rows) {
  tanner(rows);
  bordered(rows);
  squares(rows);
}

}  // namespace pfaff::nguyen_turski
