// Nguyen & Turski, (1.1), (1.2) and section 2: the brackets, and reductions of constant tensors.
#include <pfaff/bench/reproduce/nguyen_turski/rows.hpp>
#include <pfaff/brackets/canonical.hpp>
#include <pfaff/brackets/conformance/residuals.hpp>
#include <pfaff/brackets/dirac/elimination.hpp>
#include <pfaff/brackets/reduction/dirac_subspace.hpp>
#include <pfaff/brackets/reduction/splitting.hpp>

namespace pfaff::nguyen_turski {

namespace {

void brackets(Rows& rows) {
  ExactSamples samples(1);
  const auto z = samples.point(6);
  const ExactMatrix j = bracket_matrix<Rational>(CanonicalBracket{}, Rational(0), z);
  const ExactMatrix f = samples.any(1, 6), g = samples.any(1, 6);
  Rational printed(0);
  for (std::size_t k = 0; k < 3; ++k) printed += f(0, k) * g(0, 3 + k) - f(0, 3 + k) * g(0, k);
  rows.reproduced("(1.1)", "canonical bracket of two covectors", quads({printed}),
                  quads(f * j * g.transposed()));
  // The sum of (1.2) entry by entry beside the recursion with pivots.
  const ExactMatrix gram = samples.skew(6);
  const ExactMatrix c = inverse(gram.block(0, 0, 4, 4));
  ExactMatrix sum = gram.block(4, 4, 2, 2);
  for (std::size_t a = 0; a < 2; ++a)
    for (std::size_t b = 0; b < 2; ++b)
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t k = 0; k < 4; ++k) sum(a, b) = sum(a, b) - gram(4 + a, i) * c(i, k) * gram(k, 4 + b);
  const auto classes = classify(gram.block(0, 0, 4, 4), Symmetry::skew);
  Elimination<Rational> recursion(gram, Symmetry::skew, ExactMatrix(0, 0), counted(6));
  for (const auto& pivot : classes.pivots) recursion.eliminate(pivot);
  ExactMatrix ours(2, 2);
  for (std::size_t a = 0; a < 2; ++a)
    for (std::size_t b = 0; b < 2; ++b) ours(a, b) = recursion(4 + a, 4 + b);
  rows.reproduced("(1.2)", "Dirac bracket, 4 constraints", quads(sum), quads(ours));
  const ExactMatrix odd = samples.skew(5);
  rows.reproduced("(1.2)", "rank of a skew W is even: det of 5 x 5", zeros(1), quads({determinant(odd)}));
}

void reductions(Rows& rows) {
  ExactSamples samples(2);
  constexpr std::size_t n = 6, k = 2;
  const ExactMatrix a = samples.any(k, n), f = kernel_columns(a), p = samples.skew(n);
  const Splitting<Rational> other(f, a.transposed()), dirac(f, p * a.transposed());
  const ExactMatrix alpha = samples.any(1, n), beta = samples.any(1, n);
  rows.reproduced("(2.1)", "K_F(alpha, beta) = K(p* alpha, p* beta)",
                  quads((alpha * other.projection()) * p * (beta * other.projection()).transposed()),
                  quads(alpha * other.reduced(p) * beta.transposed()));
  const ExactMatrix square = p * p.transposed(), reduced = other.reduced(square);
  const auto least = static_cast<double>((alpha * reduced * alpha.transposed())(0, 0));
  rows.qualitative("(2.1)", "K_F is non-negative where K is", "K_F(a, a) >= 0", to_string(Quad(least), 4), 0,
                   0, least > 0 && largest(reduced - reduced.transposed()) == Rational(0),
                   "symmetry and sign are inherited");
  const ExactMatrix along = ExactMatrix::identity(n) - dirac.projection();
  rows.reproduced("Prop. 1", "P = P_F + P_V for V = P(F^0)", quads(p),
                  quads(dirac.reduced(p) + along * p * along.transposed()));
  rows.reproduced("Prop. 1", "P_F is the Dirac bracket (1.2)", quads(dirac_tensor(p, a)),
                  quads(dirac.reduced(p)));
  rows.reproduced("Def. 1", "Dirac projection: p(P F^0)", zeros(n * k),
                  quads(dirac.dirac_projection_defect(p)));
  const auto subspace = dirac_subspace(p, a);
  const ExactMatrix defect = other.dirac_projection_defect(p);
  rows.claim("Prop. 1", "F and P(F^0) meet in 0, so P(F^0) is in V", "p(P F^0) = 0 for every V",
             "largest " + to_string(static_cast<Quad>(largest(defect)), 4) + " for the normals",
             static_cast<double>(largest(defect)),
             subspace.meets_in_zero() && largest(dirac.dirac_projection_defect(p)) == Rational(0),
             "Section 2, Propositions 1, 2: V has to be chosen to contain P(F^0)");
  const auto dimension = [](const ExactMatrix& m) {
    return static_cast<double>(independent_rows(m, 0).independent.size());
  };
  const double printed = dimension(along * f), corrected = dimension(along);
  rows.claim("after Prop. 1", "V_p = (Id - p) F", "dimension " + to_string(Quad(printed), 2),
             "dimension " + to_string(Quad(corrected), 2), corrected - printed, corrected == double{k},
             "Section 2, Propositions 1, 2: V_p = (Id - p) E");
  ExactMatrix lagrangian(2, n);
  lagrangian(0, 0) = lagrangian(1, 1) = 1;
  const ExactMatrix j = bracket_matrix<Rational>(CanonicalBracket{}, Rational(0), samples.point(n));
  const auto not_dirac = dirac_subspace(j, lagrangian);
  rows.qualitative(
      "Def. 2", "condition of Dirac submanifolds", "TN and P(TN^0) meet in 0", describe(subspace),
      subspace.angle, 0,
      subspace.splits() && subspace.angle > 1e-3 && !not_dirac.meets_in_zero() && not_dirac.angle == 0,
      "holds for constraints with regular W; q1 = q2 = 0 fails it with angle 0");
}

}  // namespace

void reduction_rows(Rows& rows) {
  brackets(rows);
  reductions(rows);
}

}  // namespace pfaff::nguyen_turski
