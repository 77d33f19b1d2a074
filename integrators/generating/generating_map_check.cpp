#include <pfaff/integrators/generating/generating_map_check.hpp>

#include <algorithm>

#include <pfaff/integrators/generating/lagrangian_transformation.hpp>

namespace pfaff {

namespace {

// Pairs around the initial state: offsets of a few hundredths, no two alike, at times that are not 0.
std::vector<StatePair<Quad>> pairs_near(const std::vector<Real>& initial) {
  std::vector<StatePair<Quad>> pairs;
  for (int p = 0; p < 3; ++p) {
    const auto moved = [&](int seed) {
      std::vector<Quad> z;
      for (const Real& x : initial) {
        seed = (seed * 37 + 11) % 101;
        const Quad offset = Quad(seed - 50) / Quad(1000);
        z.push_back(x.quad() * (Quad(1) + offset) + offset);
      }
      return z;
    };
    pairs.push_back({Quad(2 + 3 * p) / Quad(10), Quad(1 + 3 * p) / Quad(10), moved(2 * p), moved(2 * p + 1)});
  }
  return pairs;
}

}  // namespace

GeneratingMapCheck check_generating_map(const Model& model) {
  const auto alpha = model.tape(Formula::alpha);
  const auto pairs = pairs_near(model.initial());
  GeneratingMapCheck check;
  if (model.initial().empty()) {
    check.message = "alpha: the system has no initial state to check it at";
    return check;
  }
  const LagrangianCheck lagrangian = check_lagrangian(alpha, model.tape(Formula::structure), pairs);
  check.message = lagrangian.message;
  check.residual = lagrangian.residual;
  if (!lagrangian.holds) return check;

  LagrangianTransformation<Quad> transformation(alpha);
  const std::size_t n = transformation.size();
  Quad worst(0), size(0);
  for (const auto& [t, t0, new_z, old_z] : pairs) {
    const auto blocks = transformation.blocks(t0, t0, old_z, old_z);
    const Matrix<Quad> diagonal = blocks.c + blocks.d;
    Quad largest_determinant(1);  // of a matrix with rows of this size
    for (std::size_t i = 0; i < n; ++i) {
      Quad row(0);
      for (std::size_t j = 0; j < n; ++j) row = row + abs(diagonal(i, j));
      largest_determinant = largest_determinant * row;
    }
    if (!(abs(determinant(diagonal)) > Quad(1e-20) * largest_determinant)) {
      check.message =
          "alpha: dw/dz' + dw/dz (C + D) is singular for equal states; expected w to tell states apart, e.g. "
          "their mean";
      return check;
    }
    const auto there = transformation(t, t0, new_z, old_z), back = transformation(t0, t, old_z, new_z);
    for (std::size_t k = 0; k < n; ++k) {
      worst = std::max({worst, abs(there[k] + back[k]), abs(there[n + k] - back[n + k])});
      size = std::max({size, abs(there[k]), abs(there[n + k])});
    }
  }
  check.holds = true;
  check.symmetric = worst <= Quad(1e-30) * size;  // sums of a few numbers of this size
  return check;
}

}  // namespace pfaff
