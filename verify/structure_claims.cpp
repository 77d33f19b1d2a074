// Claims about structure, measured on the Jacobian M of a step: the model's own structure, the conformal one,
// and volume.
#include <pfaff/core/linear/matrix.hpp>
#include <pfaff/verify/claim_checks.hpp>

namespace pfaff {

template <class T>
double own_structure_residual(MeasuredStep<T>& step) {
  return static_cast<double>(
      KeptStructure<T>(step.model())(step.jacobian(), step.t(), step.h(), step.start(), step.scales()));
}

template <class T>
double conformal_residual(MeasuredStep<T>& step) {
  if (step.jacobian().status != Status::converged) return no_step;
  const std::size_t n = step.start().size();
  const T rest = exp(-(T(step.model()->damping()) * step.h()));
  std::vector<T> before(n * n), after(n * n);
  for (std::size_t k = 0; k < n / 2; ++k) {
    const std::size_t above = k * n + n / 2 + k, below = (n / 2 + k) * n + k;
    after[above] = T(-1);
    after[below] = T(1);
    before[above] = -rest;
    before[below] = rest;
  }
  return static_cast<double>(congruence_residual(in_units<T>(step.jacobian().jacobian, step.scales(), -1, 1),
                                                 in_units<T>(after, step.scales(), 1, 1),
                                                 in_units<T>(before, step.scales(), 1, 1)));
}

template <class T>
double volume_residual(MeasuredStep<T>& step) {
  if (step.jacobian().status != Status::converged) return no_step;
  return static_cast<double>(
      abs(determinant(
              Matrix<T>(step.start().size(), in_units<T>(step.jacobian().jacobian, step.scales(), -1, 1))) -
          T(1)));
}

template double own_structure_residual(MeasuredStep<double>&);
template double own_structure_residual(MeasuredStep<Quad>&);
template double conformal_residual(MeasuredStep<double>&);
template double conformal_residual(MeasuredStep<Quad>&);
template double volume_residual(MeasuredStep<double>&);
template double volume_residual(MeasuredStep<Quad>&);

}  // namespace pfaff
