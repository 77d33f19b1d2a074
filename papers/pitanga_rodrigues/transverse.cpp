// Pitanga & Rodrigues, section 3.2: the transverse Poisson structure. Exact in rationals.
#include <pfaff/brackets/reduction/dirac_subspace.hpp>
#include <pfaff/brackets/reduction/transverse.hpp>
#include <pfaff/papers/pitanga_rodrigues/rows.hpp>
#include <pfaff/papers/printed/brackets.hpp>

namespace pfaff::pitanga_rodrigues {

namespace {

using TransverseTable = printed::Table<Rational>;

// Pi_W of rank 6 on seven dimensions, four constraints, two functions. What is printed is made of the tables
// alone: X^a in rows, lambda^{ab} and lambda_ab.
struct TransverseSample {
  ExactSamples samples{21};
  ExactMatrix p = [this] {
    const ExactMatrix b = samples.any(7, 6);
    return b * samples.skew(6) * b.transposed();
  }();
  ExactMatrix dx = samples.any(4, 7), f = samples.any(1, 7), g = samples.any(1, 7);
  TransverseStructure<Rational> structure{p, dx};

  TransverseTable tensor = table_of(p), gradients = table_of(dx), df = table_of(f), dg = table_of(g);
  TransverseTable fields = printed::product(gradients, tensor);
  TransverseTable lambda = printed::product(fields, printed::transposed(gradients)),
                  lambda_inverse = printed::inverse(lambda);
  /// p*_TS = lambda_ab dx^a (x) X^b on covectors.
  TransverseTable leaf_projection =
      printed::product(printed::transposed(gradients), printed::product(lambda_inverse, fields));
};

void conditions(Rows& rows, const TransverseSample& s) {
  const auto subspace = dirac_subspace(s.p, s.dx);
  const bool regular = determinant(s.structure.lambda()) != Rational(0);
  rows.qualitative("(a), (b)", "TW = TM + sharp(Ann TM)", {"equivalent to (a) and (b)", describe(subspace)},
                   {is_true(subspace.splits()), is_true(regular)},
                   "they hold, and the constraints' brackets are regular");
  // Condition (b) fails for a constraint that is a Casimir, condition (a) for one, here q2, that commutes
  // with all constraints without being a Casimir.
  ExactMatrix commuting(4, 7);
  ExactMatrix j(7, 7);
  for (std::size_t k = 0; k < 3; ++k) {
    j(k, 3 + k) = 1;
    j(3 + k, k) = -1;
  }
  commuting(0, 0) = commuting(1, 1) = commuting(2, 3) = commuting(3, 6) = 1;
  const auto broken = dirac_subspace(j, commuting);
  rows.qualitative("(a), (b)", "each can fail", {"-", describe(broken)},
                   {is_true(!broken.meets_in_zero()), is_true(!broken.transversal())},
                   "control: q1, p1, q2 and a Casimir as constraints");
  const TransverseTable onto = printed::difference(printed::unit_table<Rational>(7), s.leaf_projection);
  rows.reproduced("(13)", "p . sharp . p* on TM",
                  quads(printed::product(printed::transposed(onto), printed::product(s.tensor, onto))),
                  quads(s.structure.transverse()));
  rows.reproduced("(13)", "is the Dirac bracket", quads(printed::dirac_tensor(s.tensor, s.gradients)),
                  quads(s.structure.composed()));
}

void projectors(Rows& rows, const TransverseSample& s) {
  const auto& structure = s.structure;
  const ExactMatrix onto = structure.leaf_projection(), x = structure.fields();
  // (14) with X^a(f) = {x^a, f}: X^a(x^b), rows a.
  rows.erratum("(14)", "{x^a, x^b}", quads(printed::transposed(s.lambda)), quads(s.lambda),
               quads(structure.lambda()), "(14): X^a(x^b), X^a(f) = {x^a, f} as afterwards");
  // (15): f + u_b x^b. At x^b = 0 the differential of tau(fbar) is df less its projection onto the leaf.
  const ExactMatrix tau = s.f - (onto * s.f.transposed()).transposed();
  rows.reproduced("(15)", "X^a of (I - x^b lambda_ba X^a) f", zeros(4), quads(x * tau.transposed()));
  // sigma(x^c) = x^c: its differential X^a(x^c) lambda_ab dx^b, printed, and with lambda_ba.
  const TransverseTable acting = printed::transposed(s.lambda);
  rows.erratum(
      "after (15)", "sigma(x^c) = x^c",
      quads(printed::product(acting, printed::product(s.lambda_inverse, s.gradients))),
      quads(printed::product(acting, printed::product(printed::transposed(s.lambda_inverse), s.gradients))),
      quads((onto * s.dx.transposed()).transposed()), "after (15): sigma(g) = X^a(g) lambda_ba x^b");
  rows.reproduced("before (16)", "p*_TS", quads(s.leaf_projection), quads(onto));
  rows.reproduced("before (16)", "p*_TS(dx^b) = dx^b", quads(s.gradients),
                  quads((onto * s.dx.transposed()).transposed()));
  rows.reproduced("before (16)", "p_TS(X^c) = X^c", quads(s.fields),
                  quads((onto.transposed() * x.transposed()).transposed()));
}

void tensors(Rows& rows, const TransverseSample& s) {
  const auto& structure = s.structure;
  // 1/2 lambda_ab X^a ^ X^b
  const TransverseTable half = printed::product(printed::transposed(s.fields),
                                                printed::product(s.lambda_inverse, s.fields)),
                        minus = printed::difference(printed::zero_table<Rational>(7, 7), half);
  rows.erratum("(16), before (17)", "Pi_S", quads(half), quads(minus), quads(structure.leaf()),
               "(16), before (17): Pi_S = -1/2 lambda_ab X^a ^ X^b");
  const auto bracket = [&](const TransverseTable& a, const TransverseTable& b) {
    return printed::product(a, printed::product(s.tensor, printed::transposed(b)));
  };
  const TransverseTable last = printed::product(
      bracket(s.df, s.gradients), printed::product(s.lambda_inverse, bracket(s.gradients, s.dg)));
  rows.reproduced("(17)", "{f, g} - {f, x^a} lambda_ab {x^b, g}",
                  quads(printed::difference(bracket(s.df, s.dg), last)),
                  quads(s.f * structure.transverse() * s.g.transposed()));
  rows.reproduced("(17)", "is nguyen-turski (1.2)", quads(printed::dirac_tensor(s.tensor, s.gradients)),
                  quads(structure.transverse()));
  rows.reproduced("after (17)", "w_S(p X_f, p X_g) = {f, x^c} lambda_ca {x^a, g}", quads(last),
                  quads(s.f * structure.leaf() * s.g.transposed()));
}

}  // namespace

void transverse_rows(Rows& rows) {
  const TransverseSample sample;
  conditions(rows, sample);
  projectors(rows, sample);
  tensors(rows, sample);
}

}  // namespace pfaff::pitanga_rodrigues
