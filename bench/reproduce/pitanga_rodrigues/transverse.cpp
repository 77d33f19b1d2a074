// Pitanga & Rodrigues, section 3.2: the transverse Poisson structure. Exact in rationals.
#include <pfaff/bench/reproduce/exact.hpp>
#include <pfaff/brackets/reduction/dirac_subspace.hpp>
#include <pfaff/brackets/reduction/transverse.hpp>

namespace pfaff {

namespace {

// Pi_W of rank 6 on seven dimensions, four constraints, two functions.
struct Sample {
  ExactSamples samples{21};
  ExactMatrix p = [this] {
    const ExactMatrix b = samples.any(7, 6);
    return b * samples.skew(6) * b.transposed();
  }();
  ExactMatrix dx = samples.any(4, 7), f = samples.any(1, 7), g = samples.any(1, 7);
  TransverseStructure<Rational> structure{p, dx};
};

void conditions(Rows& rows, const Sample& s) {
  const auto subspace = dirac_subspace(s.p, s.dx);
  const bool regular = determinant(s.structure.lambda()) != Rational(0);
  rows.qualitative("(a), (b)", "TW = TM + sharp(Ann TM)", "equivalent to (a) and (b)", describe(subspace),
                   subspace.angle, 0, subspace.splits() && regular,
                   "(a) and (b) hold by their ranks, and the brackets of the constraints are regular");
  // A constraint that is a Casimir breaks (b), one pair that commutes breaks (a).
  ExactMatrix commuting(4, 7);
  ExactMatrix j(7, 7);
  for (std::size_t k = 0; k < 3; ++k) {
    j(k, 3 + k) = 1;
    j(3 + k, k) = -1;
  }
  commuting(0, 0) = commuting(1, 1) = commuting(2, 3) = commuting(3, 6) = 1;
  const auto broken = dirac_subspace(j, commuting);
  rows.qualitative("(a), (b)", "each can fail", "-", describe(broken), broken.angle, 0,
                   !broken.meets_in_zero() && !broken.transversal(),
                   "control: q2 commutes with the constraints q1, p1, and z7 is a Casimir");
  rows.reproduced("(13)", "p . sharp . p* on TM", quads(dirac_tensor(s.p, s.dx)),
                  quads(s.structure.composed()));
}

void projectors(Rows& rows, const Sample& s) {
  const auto& structure = s.structure;
  const ExactMatrix x = structure.fields(), onto = structure.leaf_projection();
  // (14) with X^a(f) = {x^a, f}: X^a(x^b), rows a.
  const ExactMatrix acting = x * s.dx.transposed();
  rows.erratum("(14)", "{x^a, x^b}", quads(acting.transposed()), quads(acting), quads(structure.lambda()),
               "(14): X^a(x^b), with X^a(f) = {x^a, f} as afterwards");
  // (15): f + u_b x^b. At x^b = 0 the differential of tau(fbar) is df + X^a(f) lambda_ab dx^b.
  const ExactMatrix xf = x * s.f.transposed();
  const ExactMatrix tau = s.f + xf.transposed() * structure.lambda_inverse() * s.dx;
  rows.reproduced("(15)", "X^a of (I - x^b lambda_ba X^a) f", zeros(4), quads(x * tau.transposed()));
  // sigma(x^c) = x^c: its differential X^a(x^c) lambda_ab dx^b, printed, and with lambda_ba.
  const ExactMatrix printed = acting.transposed() * structure.lambda_inverse() * s.dx;
  const ExactMatrix corrected = acting.transposed() * structure.lambda_inverse().transposed() * s.dx;
  rows.erratum("after (15)", "sigma(x^c) = x^c", quads(printed), quads(corrected), quads(s.dx),
               "after (15): sigma(g) = X^a(g) lambda_ba x^b");
  rows.reproduced("before (16)", "p*_TS(dx^b) = dx^b", quads(s.dx),
                  quads((onto * s.dx.transposed()).transposed()));
  rows.reproduced("before (16)", "p*_TS is a projector", quads(onto), quads(onto * onto));
  rows.reproduced("before (16)", "p_TS(X^c) = X^c", quads(x),
                  quads((onto.transposed() * x.transposed()).transposed()));
}

void tensors(Rows& rows, const Sample& s) {
  const auto& structure = s.structure;
  const ExactMatrix x = structure.fields(), onto = structure.leaf_projection();
  const ExactMatrix half = x.transposed() * structure.lambda_inverse() * x;  // 1/2 lambda_ab X^a ^ X^b
  rows.erratum("(16)", "Pi_S against Pi_W(p* ., p* .)", quads(half), quads(-half),
               quads(onto.transposed() * s.p * onto), "(16): Pi_S = -1/2 lambda_ab X^a ^ X^b; (17) is right");
  rows.reproduced(
      "(17)", "{f, g} - {f, x^a} lambda_ab {x^b, g}",
      quads(s.f * s.p * s.g.transposed() -
            (s.f * s.p * s.dx.transposed()) * structure.lambda_inverse() * (s.dx * s.p * s.g.transposed())),
      quads(s.f * structure.transverse() * s.g.transposed()));
  rows.reproduced("(17)", "is nguyen-turski (1.2)", quads(dirac_tensor(s.p, s.dx)),
                  quads(structure.transverse()));
  const ExactMatrix fx = s.f * s.p * s.dx.transposed(), gx = s.g * s.p * s.dx.transposed();
  const ExactMatrix projected =
      fx * structure.lambda_inverse() * structure.lambda() * (gx * structure.lambda_inverse()).transposed();
  rows.reproduced("after (17)", "w_S(p X_f, p X_g) = {f, x^c} lambda_ca {x^a, g}",
                  quads(-(fx * structure.lambda_inverse() * gx.transposed())), quads(projected));
}

}  // namespace

std::vector<ReproducedRow> reproduce_pitanga_rodrigues() {
  Rows rows("transverse");
  const Sample sample;
  conditions(rows, sample);
  projectors(rows, sample);
  tensors(rows, sample);
  return rows.take();
}

}  // namespace pfaff
