// Matchers (Google Mock) with which a bracket's author tests it, in the tree or outside:
//
//   EXPECT_THAT(MyBracket{}, pfaff::IsSkew(pfaff::BracketSamples{.centre = {1, 2, 3}}));
//
// Each evaluates the bracket in quad at random points about a centre, with random polynomials, always the
// same. A residual passes where it is at most `roundings` units of round-off of its terms. A failure says
// where and by how much.
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include <pfaff/brackets/conformance/residuals.hpp>

namespace pfaff {

/// Where and how finely brackets are sampled.
struct BracketSamples {
  std::vector<Quad> centre;  // its size is the dimension
  Quad spread = 1;           // points lie within this of the centre in every coordinate
  int points = 20;
  Quad time = 0;
  unsigned seed = 1;
  /// How many units of round-off of its terms a residual may have. The default suits sums of n^3 products of
  /// numbers that carry a few roundings each. Brackets that solve linear systems need more, by their
  /// condition number.
  double roundings = 1e4;
};

/// The worst residual over the samples, relative to the size of its terms, with the point where it occurs.
struct WorstResidual {
  double relative = 0;
  std::vector<Quad> point;

  void note(double value, const std::vector<Quad>& z) {
    if (value <= relative) return;
    relative = value;
    point = z;
  }
  [[nodiscard]] std::string text() const {
    std::string where;
    for (const Quad x : point) where += (where.empty() ? "" : ", ") + to_string(x, 6);
    return "residual " + to_string(Quad(relative), 3) + " of its terms at (" + where + ")";
  }
  [[nodiscard]] bool round_off(const BracketSamples& samples) const {
    return relative <= samples.roundings * static_cast<double>(unit_roundoff<Quad>());
  }
};

/// The worst of measure(z, f, g, h) over all samples, with new random polynomials f, g and h at each.
template <class Measure>
WorstResidual worst_residual(const BracketSamples& samples, Measure&& measure) {
  std::mt19937 random(samples.seed);
  WorstResidual worst;
  for (const auto& z : sample_points<Quad>(samples.centre, random, samples.points, samples.spread)) {
    const std::size_t n = z.size();
    const Polynomial f(n, random), g(n, random), h(n, random);
    worst.note(measure(z, f, g, h), z);
  }
  return worst;
}

/// {f, g} = -{g, f}.
MATCHER_P(IsSkew, samples, negation ? "is no skew bracket" : "is a skew bracket") {
  const WorstResidual worst =
      worst_residual(samples, [&](const auto& z, const auto& f, const auto& g, const auto&) {
        return antisymmetry_residual<Quad>(arg, samples.time, z, f, g).relative();
      });
  *result_listener << "{f, g} + {g, f}: " << worst.text();
  return worst.round_off(samples);
}
/// <f, g> = <g, f>.
MATCHER_P(IsSymmetric, samples, negation ? "is no symmetric bracket" : "is a symmetric bracket") {
  const WorstResidual worst =
      worst_residual(samples, [&](const auto& z, const auto& f, const auto& g, const auto&) {
        return symmetry_residual<Quad>(arg, samples.time, z, f, g).relative();
      });
  *result_listener << "<f, g> - <g, f>: " << worst.text();
  return worst.round_off(samples);
}
/// {f, g h} = {f, g} h + g {f, h}.
MATCHER_P(ObeysLeibniz, samples, negation ? "breaks Leibniz' rule" : "obeys Leibniz' rule") {
  const WorstResidual worst =
      worst_residual(samples, [&](const auto& z, const auto& f, const auto& g, const auto& h) {
        return leibniz_residual<Quad>(arg, samples.time, z, f, g, h).relative();
      });
  *result_listener << "{f, g h} - {f, g} h - g {f, h}: " << worst.text();
  return worst.round_off(samples);
}
/// Jacobi's identity, for every triple of coordinates (enough for a skew bracket with Leibniz' rule).
MATCHER_P(ObeysJacobi, samples, negation ? "breaks Jacobi's identity" : "obeys Jacobi's identity") {
  const WorstResidual worst =
      worst_residual(samples, [&](const auto& z, const auto&, const auto&, const auto&) {
        return jacobi_residual<Quad>(arg, samples.time, z).relative();
      });
  *result_listener << "{f, {g, h}} + cyclic: " << worst.text();
  return worst.round_off(samples);
}
/// {c, f} = 0 for every f; `gradient` is that of c: a callable of (In<Quad> z, Out<Quad> slope).
MATCHER_P2(HasCasimir, samples, gradient, negation ? "has no such Casimir" : "has the Casimir") {
  const WorstResidual worst =
      worst_residual(samples, [&](const auto& z, const auto&, const auto&, const auto&) {
        std::vector<Quad> slope(z.size());
        gradient(In<Quad>(z), Out<Quad>(slope));
        return casimir_residual<Quad>(arg, samples.time, z, slope).relative();
      });
  *result_listener << "{c, z_i}: " << worst.text();
  return worst.round_off(samples);
}
/// <f, f> >= 0: a semimetric bracket.
MATCHER_P(IsNonNegative, samples, negation ? "has negative squares" : "has no negative squares") {
  const WorstResidual worst =
      worst_residual(samples, [&](const auto& z, const auto& f, const auto& g, const auto& h) {
        const auto slope = [&](const Polynomial& p) { return p.template gradient<Quad>(z); };
        return std::max(0.0, -least_square<Quad>(arg, samples.time, z, {slope(f), slope(g), slope(h)}));
      });
  *result_listener << "<f, f> < 0: " << worst.text();
  return worst.round_off(samples);
}

}  // namespace pfaff
