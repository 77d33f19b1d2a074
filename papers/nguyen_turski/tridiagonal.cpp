// Nguyen & Turski, (4.6) and appendix C: inverses of symmetric tridiagonal matrices, exactly over fractions
// and, where roots are taken, in quad.
#include <pfaff/core/linear/tridiagonal_inverse.hpp>
#include <pfaff/papers/nguyen_turski/rows.hpp>
#include <pfaff/papers/printed/tridiagonal.hpp>

namespace pfaff::nguyen_turski {

namespace {
constexpr std::size_t rows_of_s = 6;

// Positive definite: diagonally dominant. The engine's, and the printed formulas' of the same numbers.
Tridiagonal<Rational> sample() {
  Tridiagonal<Rational> s;
  for (int k = 0; k < static_cast<int>(rows_of_s); ++k) {
    s.diagonal.push_back(Rational(7 + 3 * k) / Rational(2));
    if (k + 1 < static_cast<int>(rows_of_s))
      s.couplings.push_back(Rational(k % 2 == 0 ? 5 : -4) / Rational(3 + k));
  }
  return s;
}

void minors(Rows& rows, const Tridiagonal<Rational>& s, const printed::Tridiagonal<Rational>& printed) {
  rows.reproduced("(C.3)", "leading minors by recursion", quads(printed::leading_determinants(printed)),
                  quads(leading_minors(s)));
  const Numbers ours = quads(inverse_by_minors(s));
  rows.reproduced("(4.6), (C.4)", "inverse by minors", quads(printed::inverse_by_minors(printed)), ours);
  rows.erratum("(C.5)", "inverse by (C.6)", quads(printed::inverse_by_recursion(printed, Rational(0))),
               quads(printed::inverse_by_recursion(printed, Rational(1))), ours,
               "(C.5): d_0 = 0 for the empty block; it is 1");
  rows.reproduced("(C.6)", "inverse, with (C.5) corrected",
                  quads(printed::inverse_by_recursion(printed, Rational(1))), ours);
  const printed::OnePair<Rational> pair = printed::pair_of_inverse(printed);
  const OnePair<Rational> engine = one_pair_inverse(s);
  rows.reproduced("(C.7)", "u", quads(pair.u), quads(engine.left));
  rows.reproduced("(C.8)", "w", quads(pair.w), quads(engine.right));
  rows.reproduced("(C.9)", "inverse as a one-pair matrix", quads(printed::one_pair(pair.u, pair.w)), ours);
}

// The inverse of a one-pair matrix is tridiagonal, which the paper states without a proof.
void one_pairs(Rows& rows) {
  ExactSamples samples(12);
  std::vector<Rational> u, w;
  for (std::size_t k = 0; k < rows_of_s; ++k) {
    u.push_back(samples.number() + Rational(static_cast<int>(3 * k) + 20));
    w.push_back(samples.number() + Rational(static_cast<int>(k * k) + 15));
  }
  printed::Table<Rational> q = printed::one_pair(u, w);
  rows.reproduced("(C.2), Definition 3", "inverse of a one-pair matrix", quads(printed::inverse(q)),
                  quads(tridiagonal_inverse(OnePair<Rational>{u, w}).dense()));
  // A matrix that is no one-pair matrix has no tridiagonal inverse.
  q[0][rows_of_s - 1] = q[rows_of_s - 1][0] = q[0][rows_of_s - 1] + Rational(1);
  const auto entry = std::abs(static_cast<double>(inverse(matrix_of(q))(0, rows_of_s - 1)));
  rows.qualitative("(C.2)", "one pair is needed", {"-", "entry (1, 6) of the inverse " + shown(entry)},
                   {at_least(entry, clearly)}, "control: one entry changed, not tridiagonal");
}

void factors(Rows& rows, const Tridiagonal<Rational>& s, const printed::Tridiagonal<Rational>& exact) {
  const Tridiagonal<Quad> q{quads(s.diagonal), quads(s.couplings)};
  const printed::Tridiagonal<Quad> printed{quads(exact.c), quads(exact.b)};
  const InverseFactor<Quad> engine = inverse_factor(q);
  const printed::Factors<Quad> f = printed::factors(printed);
  const auto first = [](Numbers x,
                        std::size_t from) {  // without the first or the last, which the paper leaves out
    x.erase(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(from));
    x.resize(rows_of_s - 1);
    return x;
  };
  rows.reproduced("(C.14)", "beta_k", f.beta, engine.beta);
  rows.reproduced("(C.15)", "x_k", f.x, first(engine.x, 0));
  rows.reproduced("(C.15)", "y_k", f.y, engine.y);
  rows.reproduced("(C.15)", "z_k", f.z, first(engine.z, 1));
  Numbers ours, ones;
  for (std::size_t k = 0; k + 1 < rows_of_s; ++k) {  // (C.13) with the engine's x, y, z and beta
    const printed::Table<Quad> left{{engine.x[k], Quad(0)}, {engine.y[k], engine.z[k + 1]}},
        middle{{f.a[k], engine.beta[k]}, {engine.beta[k], f.d[k]}};
    const Numbers unit =
        printed::listed(printed::product(left, printed::product(middle, printed::transposed(left))));
    ours.insert(ours.end(), unit.begin(), unit.end());
    for (const int entry : {1, 0, 0, 1}) ones.emplace_back(entry);
  }
  rows.reproduced("(C.13)", "three equations for x_k, y_k, z_k", ones, ours);
  const Numbers upper = engine.dense().entries();
  rows.reproduced("(C.10)", "U as a product", printed::listed(printed::upper_by_product(f)), upper);
  rows.qualitative("(C.12)", "the last number x_K", {"not defined", shown({engine.x.back()})},
                   {at_most(distance(printed::listed(printed::upper_by_formula(f)), upper), at_round_off)},
                   "(C.12): with x_K = 1 it is the product of (C.10)");
  // (C.11): U_1 .. U_k turn S into a matrix with beta_{k+1} beside a 1.
  double apart = 0;
  printed::Table<Quad> u = printed::unit_table<Quad>(rows_of_s);
  for (std::size_t k = 0; k + 2 < rows_of_s; ++k) {
    u = printed::product(u, printed::elementary(f, k));
    const auto turned =
        printed::product(printed::transposed(u), printed::product(printed::dense(printed), u));
    apart = std::max(apart,
                     distance({turned[k + 1][k + 1], turned[k + 1][k + 2]}, {Quad(1), engine.beta[k + 1]}));
  }
  rows.qualitative("(C.11)", "place of beta_{k+1}", {"(k+1, k+1)", "(k+1, k+2)"},
                   {at_most(apart, at_round_off)}, "(C.11): beside an entry 1, at (k+1, k+2), (k+2, k+1)");
  const Numbers inverted = quads(inverse_by_minors(s));
  rows.erratum("(C.16)", "inverse by sums over the factor",
               printed::listed(printed::inverse_by_sums(f, rows_of_s - 1)),
               printed::listed(printed::inverse_by_sums(f, rows_of_s)), engine.inverse().entries(),
               "(C.16): sums end at K - 1; they end at K");
  rows.reproduced("(C.16)", "corrected", printed::listed(printed::inverse_by_sums(f, rows_of_s)), inverted);
  rows.reproduced("(C.17)", "beta by themselves", printed::couplings(printed), normalised_couplings(q));
}
}  // namespace

void tridiagonal_rows(Rows& rows) {
  const Tridiagonal<Rational> s = sample();
  const printed::Tridiagonal<Rational> printed{s.diagonal, s.couplings};
  minors(rows, s, printed);
  one_pairs(rows);
  factors(rows, s, printed);
}

}  // namespace pfaff::nguyen_turski
