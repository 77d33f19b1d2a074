#include <pfaff/integrators/generating/lagrangian_transformation.hpp>

#include <cmath>

#include <pfaff/core/numbers/formatted.hpp>

namespace pfaff {

namespace {

std::string shown(double x) { return formatted("%.3g", x); }

// max |entries of |A|^T |S| |A||: the size of what is summed, and so the unit of its rounding errors.
template <class T>
T size_of_terms(const Matrix<T>& s, const Matrix<T>& a) {
  const auto magnitudes = [](Matrix<T> m) {
    for (std::size_t i = 0; i < m.rows(); ++i)
      for (std::size_t j = 0; j < m.columns(); ++j) m(i, j) = abs(m(i, j));
    return m;
  };
  return largest(pulled_back(magnitudes(s), magnitudes(a)));
}

// The block of (34) that an entry is in, and what it must be.
std::string block_of(std::size_t i, std::size_t j, std::size_t n) {
  if (i < n && j < n) return "(new, new): A^T C - C^T A must be K(z', t)";
  if (i >= n && j >= n) return "(old, old): B^T D - D^T B must be -K(z, t0)";
  return "(new, old): A^T D - C^T B must be 0";
}

}  // namespace

template <class T>
LagrangianCheck check_lagrangian(const std::shared_ptr<const Tape>& alpha,
                                 const std::shared_ptr<const Tape>& structure,
                                 const std::vector<StatePair<T>>& points, double tolerance) {
  LagrangianTransformation<T> transformation(alpha);
  const std::size_t n = transformation.size();
  // Each entry sums 2n products of three numbers that are themselves a few operations old.
  if (tolerance == 0) tolerance = 64 * static_cast<double>(n) * static_cast<double>(unit_roundoff<T>());
  Replay<T> structure_at(structure);
  LagrangianCheck check;
  double scaled_residual = 0, first_factor = 0, worst = -1;
  std::string where;
  bool one_factor = true;
  for (const StatePair<T>& point : points) {
    std::vector<T> k1(n * n), k0(n * n);
    structure_at(point.t, point.new_z.data(), k1.data());
    structure_at(point.t0, point.old_z.data(), k0.data());
    const Matrix<T> expected = pair_structure(Matrix<T>(n, k1), Matrix<T>(n, k0));
    const Matrix<T> jacobian = transformation.blocks(point.t, point.t0, point.new_z, point.old_z).jacobian();
    const Matrix<T> j = canonical_structure<T>(n), found = pulled_back(j, jacobian);
    const T scale = size_of_terms(j, jacobian);
    const std::vector<T> values = transformation(point.t, point.t0, point.new_z, point.old_z);
    if (!isfinite(largest(Matrix<T>(1, values))) || !isfinite(scale) || !isfinite(largest(expected))) {
      check.residual = std::numeric_limits<double>::infinity();
      check.message =
          "alpha: its value, its Jacobian or K is not finite at t = " + shown(static_cast<double>(point.t)) +
          "; expected finite numbers wherever steps are taken";
      return check;
    }
    // The factor that fits best: <found, expected> / <expected, expected>.
    T product(0), square(0);
    for (std::size_t e = 0; e < found.entries().size(); ++e) {
      product = product + found.entries()[e] * expected.entries()[e];
      square = square + expected.entries()[e] * expected.entries()[e];
    }
    if (!(square > T(0)) || !(scale > T(0))) {
      check.residual = std::numeric_limits<double>::infinity();
      check.message = !(square > T(0)) ? "alpha: K is zero; expected a regular structure"
                                       : "alpha: its Jacobian is zero; expected a diffeomorphism";
      return check;
    }
    const T factor = product / square;
    for (std::size_t a = 0; a < 2 * n; ++a)
      for (std::size_t b = 0; b < 2 * n; ++b) {
        const auto residual = static_cast<double>(abs(found(a, b) - expected(a, b)) / scale);
        if (residual > worst) {
          worst = residual;
          where = block_of(a, b, n) + ", off by " + shown(residual) + " (relative) in entry (" +
                  std::to_string(a) + ", " + std::to_string(b) + ")";
        }
      }
    scaled_residual =
        std::max(scaled_residual, static_cast<double>(largest(found - factor * expected) / scale));
    const auto number = static_cast<double>(factor);
    if (&point == &points.front()) first_factor = number;
    one_factor = one_factor && std::abs(number - first_factor) <= 1e-9 * std::abs(first_factor);
  }
  check.residual = worst;
  if (worst >= 0 && worst <= tolerance) {
    check.holds = true;
    return check;
  }
  if (worst >= 0 && scaled_residual <= tolerance && one_factor && std::abs(first_factor) > 1e-9) {
    check.factor = first_factor;
    check.message = "alpha: alpha_*^T J alpha_* is " + shown(first_factor) +
                    " times diag(K, -K0), which is Lagrangian but needs the factor 1; " +
                    (std::abs(first_factor + 1) < 1e-9 ? std::string("change the sign of w_hat")
                                                       : "divide w_hat by " + shown(first_factor));
    return check;
  }
  check.message = worst < 0 ? "alpha: no point to check it at"
                            : "alpha: alpha_*^T J alpha_* is not diag(K, -K0): block " + where;
  return check;
}

template LagrangianCheck check_lagrangian(const std::shared_ptr<const Tape>&,
                                          const std::shared_ptr<const Tape>&,
                                          const std::vector<StatePair<double>>&, double);
template LagrangianCheck check_lagrangian(const std::shared_ptr<const Tape>&,
                                          const std::shared_ptr<const Tape>&,
                                          const std::vector<StatePair<Quad>>&, double);

}  // namespace pfaff
