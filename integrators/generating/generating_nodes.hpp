// The nodes at which a truncated generating function expands the field, and how the levels of its series
// combine.
//
// Variant P expands at t0 and keeps the s stages of a Gauss collocation as lanes. Variant S expands at the
// mid-time, where the stages mirror each other under tau -> -tau: with a~_ij = a_ij - b_j/2 and stage j' the
// mirror image of j, X_j' at degree l is (-1)^l X_j. Lane j stands for both: a~_ij + a~_ij' acts on even
// levels, a~_ij - a~_ij' on odd ones, the centre node counts once, and only even levels reach the generating
// function.
#pragma once

#include <cstddef>
#include <vector>

#include <pfaff/integrators/runge_kutta/gauss_coefficients.hpp>

namespace pfaff {

struct GeneratingNodes {
  bool symmetric;               // variant S
  std::size_t lanes, levels;    // nodes kept, degrees of the field's series
  std::vector<Quad> node;       // of lane i, from the time of expansion in units of the step
  std::vector<Quad> weight;     // psi += tau weight_i X_i at the levels that count
  std::vector<Quad> even, odd;  // lanes x lanes: next stage level = tau (matrix X) - (variant P) P psi's term

  /// For a generating function truncated at degree `order`, with `extra` more degrees from the same nodes.
  GeneratingNodes(int order, bool symmetric_variant, int extra, const GaussCoefficients& g)
      : symmetric(symmetric_variant),
        lanes(static_cast<std::size_t>(symmetric_variant ? (g.stages + 1) / 2 : g.stages)),
        levels(static_cast<std::size_t>((symmetric_variant ? order - 1 : order) + extra)) {
    const auto s = static_cast<std::size_t>(g.stages), first = s - lanes;
    const Quad half = Quad(1) / Quad(2);
    for (std::size_t i = first; i < s; ++i) {
      node.push_back(symmetric ? g.nodes[i] - half : g.nodes[i]);
      const bool centre = s - 1 - i == i;
      weight.push_back(symmetric && !centre ? g.weights[i] + g.weights[s - 1 - i] : g.weights[i]);
      for (std::size_t j = first; j < s; ++j) {
        if (!symmetric) {
          even.push_back(g.matrix[i * s + j]);
          odd.push_back(even.back());
          continue;
        }
        const std::size_t mirror = s - 1 - j;
        const Quad a = g.matrix[i * s + j] - g.weights[j] * half;
        const Quad b = mirror == j ? Quad(0) : g.matrix[i * s + mirror] - g.weights[mirror] * half;
        even.push_back(a + b);
        odd.push_back(a - b);
      }
    }
  }
  /// Does level l of the field reach the generating function?
  [[nodiscard]] bool counts(std::size_t level) const { return !symmetric || level % 2 == 0; }
  /// Field evaluations that one psi amounts to.
  [[nodiscard]] std::size_t evaluations() const { return lanes * levels; }
};

}  // namespace pfaff
