// Nguyen & Turski, Propositions 2 and 6, (3.20), (3.21): Jacobi's identity. Exact, off the constraint
// surface.
#include <pfaff/bench/reproduce/nguyen_turski/rows.hpp>
#include <pfaff/brackets/canonical.hpp>
#include <pfaff/brackets/conformance/bracket_function.hpp>
#include <pfaff/brackets/conformance/polynomial_brackets.hpp>
#include <pfaff/brackets/reduction/almost_dirac.hpp>

namespace pfaff::nguyen_turski {

namespace {

template <class B>
using Dirac = AlmostDiracReduction<B, PolynomialConstraints, DiracComplement<B>>;

void propositions(Rows& rows) {
  ExactSamples samples(10);
  constexpr std::size_t n = 6;
  const PolynomialConstraints constraints(2, n, samples.random());
  const auto z = samples.point(n);
  const auto residual = [&](const auto& bracket) {
    return static_cast<Quad>(jacobi_residual<Rational>(bracket, Rational(0), z).residual);
  };
  const Dirac<CanonicalBracket> dirac{{}, constraints, {}};
  const AlmostDiracReduction<CanonicalBracket, PolynomialConstraints, NormalComplement> almost{
      {}, constraints, {}};
  rows.reproduced("Prop. 2", "Jacobi of the reduction along P(TN^0)", zeros(1), {residual(dirac)});
  const Quad left = residual(almost);
  rows.qualitative("after (2.1)", "a reduction may be almost Poisson only", "Jacobi may not hold",
                   "residual " + to_string(left, 4), static_cast<double>(left), 0,
                   static_cast<double>(left) > clearly,
                   "along the normals, on four-dimensional level sets, Jacobi fails");
  // Two nested levels: rank 4 of constraints in seven dimensions with a bracket that depends on the point.
  const NambuCanonicalBracket poisson{Polynomial(3, samples.random())};
  const PolynomialConstraints four(4, 7, samples.random());
  const Dirac<NambuCanonicalBracket> deeper{poisson, four, {poisson}};
  const auto at = samples.point(7);
  rows.reproduced("Prop. 6", "Jacobi of a Dirac bracket off the surface", zeros(1),
                  {static_cast<Quad>(jacobi_residual<Rational>(deeper, Rational(0), at).residual)});
  const PolynomialBracket skew(Symmetry::skew, n, samples.random());
  const Dirac<PolynomialBracket> broken{skew, constraints, {skew}};
  const Quad control = residual(broken);
  rows.qualitative("Prop. 6", "needs the Jacobi identity of the bracket", "Lie or Poisson bracket",
                   "residual " + to_string(control, 4), static_cast<double>(control), 0,
                   static_cast<double>(control) > clearly,
                   "control: of a skew bracket without it, it has none");
}

/// The sums of (3.20) and both sides of (3.21).
struct Expansion {
  std::vector<Rational> sums;
  Rational jacobi, expanded;
};
template <class B>
Expansion expansion(const B& bracket, ExactSamples& samples, std::size_t n) {
  const auto z = samples.point(n);
  auto& random = samples.random();
  const Polynomial f(n, random), g(n, random), h(n, random);
  const PolynomialConstraints phi(2, n, random);
  const Polynomial &p1 = phi.functions[0], &p2 = phi.functions[1];
  const auto function = [&](const auto& a, const auto& b) { return BracketFunction(bracket, a, b); };
  const auto at = [&](const auto& x) { return x.template operator()<Rational>(z); };
  const auto value = [&](const auto& a, const auto& b) { return at(function(a, b)); };
  const auto a1 = function(f, p1), a2 = function(f, p2), b1 = function(g, p1), b2 = function(g, p2),
             c1 = function(h, p1), c2 = function(h, p2), p12 = function(p1, p2);
  const auto fg = function(f, g), fh = function(f, h), hg = function(h, g), gh = function(g, h),
             hf = function(h, f);
  const auto sum = [&](const auto& a, const auto& g1, const auto& f1, const auto& b, const auto& p,
                       const auto& fg1) { return value(a, g1) + value(f1, b) + value(p, fg1); };
  const Rational i1 = sum(a1, g, f, b1, p1, fg), i2 = sum(a2, g, f, b2, p2, fg);
  const Rational j1 = sum(a1, h, f, c1, p1, fh), j2 = sum(a2, h, f, c2, p2, fh);
  const Rational k1 = sum(c1, g, h, b1, p1, hg), k2 = sum(c2, g, h, b2, p2, hg);
  const Rational d = sum(p2, a1, a2, p1, f, p12), e = sum(p2, b1, b2, p1, g, p12),
                 last = sum(p2, c1, c2, p1, h, p12);
  const Rational s = Rational(1) / at(p12);
  const Rational first =
      (at(a2) * k1 - at(a1) * k2) + (at(b2) * j1 - at(b1) * j2) + (at(c1) * i2 - at(c2) * i1);
  const Rational second = (at(a1) * at(b2) - at(a2) * at(b1)) * last +
                          (at(c1) * at(a2) - at(c2) * at(a1)) * e + (at(b1) * at(c2) - at(b2) * at(c1)) * d;
  const Dirac<B> dirac{bracket, phi, {bracket}};
  const auto gh_d = BracketFunction(dirac, g, h), hf_d = BracketFunction(dirac, h, f),
             fg_d = BracketFunction(dirac, f, g);
  return {{i1, i2, j1, j2, k1, k2, d, e, last},
          at(BracketFunction(dirac, f, gh_d)) + at(BracketFunction(dirac, g, hf_d)) +
              at(BracketFunction(dirac, h, fg_d)),
          value(f, gh) + value(g, hf) + value(h, fg) + first * s + second * s * s};
}

void expansions(Rows& rows) {
  ExactSamples samples(11);
  const Expansion canonical = expansion(CanonicalBracket{}, samples, 4);
  rows.reproduced("(3.20)", "the sums of a Poisson bracket", zeros(9), quads(canonical.sums));
  const PolynomialBracket skew(Symmetry::skew, 4, samples.random());
  const Expansion any = expansion(skew, samples, 4);
  rows.reproduced("(3.21)", "an identity for any skew bracket", quads({any.expanded}), quads({any.jacobi}));
  const auto size = std::abs(static_cast<double>(any.jacobi));
  rows.qualitative("(3.21)", "for a bracket without Jacobi's identity", "-",
                   "Jacobi " + to_string(Quad(size), 4), size, 0, size > clearly,
                   "control: both sides of the row above differ from 0");
}

}  // namespace

void jacobi_rows(Rows& rows) {
  propositions(rows);
  expansions(rows);
}

}  // namespace pfaff::nguyen_turski
