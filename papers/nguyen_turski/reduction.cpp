// Nguyen & Turski, (1.1), (1.2) and section 2: the brackets, and reductions of tensors.
#include <pfaff/brackets/conformance/polynomial_brackets.hpp>
#include <pfaff/brackets/reduction/almost_dirac.hpp>
#include <pfaff/brackets/reduction/dirac_subspace.hpp>
#include <pfaff/brackets/reduction/splitting.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/papers/nguyen_turski/rows.hpp>
#include <pfaff/papers/printed/brackets.hpp>

namespace pfaff::nguyen_turski {

namespace {

// The tensor of a registered bracket of constant structure.
Matrix<Quad> registered_tensor(const std::string& name, const Assignments& set) {
  const BracketInstance bracket = pfaff::brackets().get(name, "bracket").make(set);
  const auto n = static_cast<std::size_t>(bracket.dimension);
  Replay<Quad> sharp(bracket.sharp);
  Matrix<Quad> tensor(n, n);
  for (std::size_t j = 0; j < n; ++j) {
    Numbers arguments(2 * n), column(n);
    arguments[n + j] = Quad(1);
    sharp(Quad(0), arguments.data(), column.data());
    for (std::size_t i = 0; i < n; ++i) tensor(i, j) = column[i];
  }
  return tensor;
}

void definitions(Rows& rows) {
  ExactSamples samples(1);
  const Matrix<Quad> j = registered_tensor("canonical", {{"degrees", "3"}});
  const Numbers f = quads(samples.any(1, 6)), g = quads(samples.any(1, 6)), image = j * g;
  Quad ours(0);
  for (std::size_t k = 0; k < f.size(); ++k) ours += f[k] * image[k];
  rows.reproduced("(1.1)", "canonical bracket of two covectors", {printed::canonical_bracket(f, g)}, {ours});
  const ExactMatrix gram = samples.skew(6);
  rows.reproduced("(1.2)", "Dirac bracket, 4 constraints", quads(printed::dirac_brackets(table_of(gram), 4)),
                  quads(engine_brackets(gram, 4, Symmetry::skew)));
  const auto odd = classify(samples.skew(5), Symmetry::skew);
  rows.qualitative("(1.2)", "rank of a skew W is even", {"even", std::to_string(odd.rank()) + " of 5"},
                   {at_most(static_cast<double>(odd.rank() % 2), 0), at_most(odd.regular() ? 1 : 0, 0)},
                   "five constraints are not all second class");
}

void linear(Rows& rows) {
  ExactSamples samples(2);
  constexpr std::size_t n = 6, k = 2;
  const ExactMatrix a = samples.any(k, n), f = kernel_columns(a), p = samples.skew(n);
  const ExactMatrix normals = a.transposed(), along = p * a.transposed();
  const Splitting<Rational> other(f, normals), dirac(f, along);
  rows.reproduced("(2.1), Definition 1", "K_F = K(p* ., p* .) along normals",
                  quads(printed::reduced_tensor(table_of(p), table_of(f), table_of(normals))),
                  quads(other.reduced(p)));
  const ExactMatrix square = p * p.transposed(), reduced = other.reduced(square);
  const ExactMatrix alpha = samples.any(1, n);
  const auto least = static_cast<double>((alpha * reduced * alpha.transposed())(0, 0));
  rows.qualitative(
      "(2.1)", "sign of K_F", {"K_F(a, a) >= 0", shown(least)},
      {at_least(least, 0), at_most(static_cast<double>(largest(reduced - reduced.transposed())), 0)},
      "symmetry and sign are inherited");
  rows.reproduced("Proposition 1", "P = P_F + P_V for V = P(F^0)", quads(p),
                  quads(dirac.reduced(p) + Splitting<Rational>(along, f).reduced(p)));
  rows.reproduced("Proposition 1", "P_F is the Dirac bracket (1.2)",
                  quads(printed::dirac_tensor(table_of(p), table_of(a))), quads(dirac.reduced(p)));
  rows.reproduced("after Proposition 1", "Dirac projection: p(P F^0)", zeros(n * k),
                  quads(dirac.dirac_projection_defect(p)));
  const auto subspace = dirac_subspace(p, a);
  const auto defect = static_cast<double>(largest(other.dirac_projection_defect(p)));
  rows.claim("Proposition 1, Proposition 2", "P(F^0) is in V",
             {"p(P F^0) = 0 for every V", "largest " + shown(defect) + " for the normals"},
             {at_least(defect, clearly), is_true(subspace.meets_in_zero()),
              at_most(static_cast<double>(largest(dirac.dirac_projection_defect(p))), 0)},
             "Proposition 1, Proposition 2: V must be chosen so");
  const ExactMatrix complement = ExactMatrix::identity(n) - dirac.projection();
  const auto dimension = [](const ExactMatrix& m) {
    return static_cast<double>(independent_rows(m, 0).independent.size());
  };
  const double of_f = dimension(complement * f), of_e = dimension(complement);
  rows.claim("after Proposition 1", "V_p = (Id - p) F",
             {"dimension " + shown(of_f), "dimension " + shown(of_e)},
             {at_least(of_e - of_f, 1), at_most(std::abs(of_e - double{k}), 0)},
             "after Proposition 1: V_p = (Id - p) E");
}

// (2.2) at a point of two polynomial constraints, along their normals and along P(TN^0).
void submanifolds(Rows& rows) {
  ExactSamples samples(14);
  constexpr std::size_t n = 6;
  const PolynomialConstraints constraints(2, n, samples.random());
  const PolynomialBracket skew(Symmetry::skew, n, samples.random());
  const auto z = samples.point(n);
  std::vector<Rational> gradients(2 * n);
  constraints.gradients<Rational>(Rational(0), z, gradients);
  const ExactMatrix a(2, gradients), p = bracket_matrix<Rational>(skew, Rational(0), z),
                                     f = kernel_columns(a);
  const AlmostDiracReduction<PolynomialBracket, PolynomialConstraints, NormalComplement> normal{
      skew, constraints, {}};
  rows.reproduced("(2.2)", "reduction along normals",
                  quads(printed::reduced_tensor(table_of(p), table_of(f), table_of(a.transposed()))),
                  quads(bracket_matrix<Rational>(normal, Rational(0), z)));
  const AlmostDiracReduction<PolynomialBracket, PolynomialConstraints, DiracComplement<PolynomialBracket>>
      dirac{skew, constraints, {skew}};
  rows.reproduced("(2.2)", "reduction along P(TN^0)",
                  quads(printed::reduced_tensor(table_of(p), table_of(f), table_of(p * a.transposed()))),
                  quads(bracket_matrix<Rational>(dirac, Rational(0), z)));
  const auto subspace = dirac_subspace(p, a);
  ExactMatrix lagrangian(2, n), j(n, n);
  lagrangian(0, 0) = lagrangian(1, 1) = 1;
  for (std::size_t k = 0; k < n / 2; ++k) {
    j(k, n / 2 + k) = 1;
    j(n / 2 + k, k) = -1;
  }
  const auto not_dirac = dirac_subspace(j, lagrangian);
  rows.qualitative("Definition 2", "Dirac submanifold", {"TN and P(TN^0) meet in 0", describe(subspace)},
                   {at_least(subspace.angle, 1e-3), is_true(subspace.splits()),
                    is_true(!not_dirac.meets_in_zero()), at_most(not_dirac.angle, 0)},
                   "holds where W is regular; q1 = q2 = 0 has angle 0");
}

}  // namespace

void reduction_rows(Rows& rows) {
  definitions(rows);
  linear(rows);
  submanifolds(rows);
}

}  // namespace pfaff::nguyen_turski
