#include <pfaff/runs/support/structure.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace pfaff {

template <class T>
StepDifferentiator<T>::StepDifferentiator(const MethodInstance& method, std::shared_ptr<const Model> model)
    : stepper_(method.stepper(std::move(model), StepDual<T>())) {}

template <class T>
StepJacobian<T> StepDifferentiator<T>::operator()(const T& t, const T& h, const std::vector<T>& z,
                                                  const std::vector<T>& units) {
  const auto move = [&](std::vector<StepDual<T>>& moved) {
    stepper_->forget();
    std::int64_t completed = 0;
    return stepper_->advance(StepDual<T>(t), 0, StepDual<T>(h), 1, moved, completed);
  };
  return jacobian_of_map(z, move, units);
}

std::string_view structure_name(const Model& model) {
  const FacetSet facets = model.facets();
  // Friction and applied forces contract the structure, or do what they like with it.
  if (model.holonomic())
    return !model.frictionless() || model.forced() ? std::string_view() : "constrained-symplectic";
  if (facets.has(Facet::structure)) return "K-symplectic";
  if (!facets.has(Facet::hamiltonian)) return {};
  return facets.has(Facet::darboux_chart) ? "symplectic" : "poisson";
}

template <class T>
KeptStructure<T>::KeptStructure(std::shared_ptr<const Model> model)
    : problem_(model), poisson_(structure_name(*model) == "poisson"), constrained_(model->holonomic()) {}

template <class T>
bool KeptStructure<T>::applies(const Model& model) {
  return !structure_name(model).empty();
}

template <class T>
std::vector<T> tangent_projection(const Model& model, const T& t, const std::vector<T>& z) {
  const auto constraints = model.holonomic_constraints<T>();
  const std::size_t size = z.size(), n = size / 2;
  const In<T> q(z.data(), n), p(z.data() + n, n);
  std::vector<T> matrix(size * size), u(size), move(n), by_momentum(constraints->count()),
      normal(constraints->count());
  if (constraints->place(t, q, p) != Status::converged) {
    matrix.assign(size * size, std::numeric_limits<T>::quiet_NaN());
    return matrix;
  }
  for (std::size_t column = 0; column < size; ++column) {
    std::fill(u.begin(), u.end(), T(0));
    u[column] = T(1);
    const Out<T> u_q = Out<T>(u).first(n), u_p = Out<T>(u).subspan(n);
    constraints->apply(u_q, normal);
    constraints->solve(normal, normal);
    constraints->hidden_by_momentum_transpose(normal, move);
    for (std::size_t k = 0; k < n; ++k) u_q[k] = u_q[k] - move[k];
    constraints->hidden_by_position(u_q, normal);
    constraints->hidden_by_momentum(u_p, by_momentum);
    for (std::size_t i = 0; i < normal.size(); ++i) normal[i] = normal[i] + by_momentum[i];
    constraints->solve(normal, normal);
    constraints->apply_transpose(normal, move);
    for (std::size_t k = 0; k < n; ++k) u_p[k] = u_p[k] - move[k];
    for (std::size_t row = 0; row < size; ++row) matrix[row * size + column] = u[row];
  }
  return matrix;
}

template <class T>
Congruence<T> KeptStructure<T>::congruence(const StepJacobian<T>& step, const T& t, const T& h,
                                           const std::vector<T>& z, const std::vector<T>& units) {
  const std::size_t n = z.size();
  const auto matrix = [&](const std::vector<T>& a, int row, int column) {
    return Matrix<T>(n, in_units(a, units, row, column));
  };
  const Matrix<T> jacobian = matrix(step.jacobian, -1, 1);
  std::vector<T> before(n * n), after(n * n);
  if (constrained_) {
    // (M U)^T J (M U) = U^T J U, where U is the projection onto the tangent space.
    const Matrix<T> u = matrix(tangent_projection(*problem_.model(), t, z), -1, 1);
    for (std::size_t k = 0; k < n / 2; ++k) {
      after[k * n + n / 2 + k] = T(-1);
      after[(n / 2 + k) * n + k] = T(1);
    }
    const Matrix<T> j = matrix(after, 1, 1);
    return {jacobian * u, j, u.transposed() * (j * u)};
  }
  if (!poisson_) {
    problem_.structure(t, z, before);
    problem_.structure(t + h, step.z, after);
    return {jacobian, matrix(after, 1, 1), matrix(before, 1, 1)};
  }
  problem_.poisson_tensor(t, z, before);
  problem_.poisson_tensor(t + h, step.z, after);
  return {jacobian.transposed(), matrix(before, -1, -1), matrix(after, -1, -1)};
}

template <class T>
T KeptStructure<T>::operator()(const StepJacobian<T>& step, const T& t, const T& h, const std::vector<T>& z,
                               const std::vector<T>& units) {
  if (step.status != Status::converged) return std::numeric_limits<T>::quiet_NaN();
  return congruence_residual(CongruenceDifference<T>(congruence(step, t, h, z, units)));
}

// What stiff steps round shows in units in which the stiff coordinates count as the others do. A residual of
// the map itself hardly changes with a step that is changed a little, rounding is another number.
template <class T>
T StructureResidual<T>::operator()(const T& t, const T& h, const std::vector<T>& z) {
  constexpr double at_round_off = 1000, most_change = 0.125;
  const StepJacobian<T> own = differentiate_(t, h, z);
  if (own.status != Status::converged) return std::numeric_limits<T>::quiet_NaN();
  const Congruence<T> congruence = kept_.congruence(own, t, h, z);
  const T residual = congruence_residual(CongruenceDifference<T>(congruence));
  const std::vector<T> units = equilibrating_units(congruence);
  if (units.empty()) return residual;
  // The derivatives of a step are converged in the units in which they are made.
  const auto difference = [&](const T& step) {
    const StepJacobian<T> jacobian = differentiate_(t, step, z, units);
    std::optional<CongruenceDifference<T>> found;
    if (jacobian.status == Status::converged)
      found = in_units(CongruenceDifference<T>(kept_.congruence(jacobian, t, step, z)), units);
    return found;
  };
  const auto here = difference(h);
  if (!here) return std::numeric_limits<T>::quiet_NaN();
  const T in_alike = congruence_residual(*here);
  if (!(in_alike > T(at_round_off) * unit_roundoff<T>())) return in_alike;
  auto change = difference(h * (T(1) + T(0x1p-30)));
  if (!change) return in_alike;
  change->entries = change->entries - here->entries;
  return congruence_residual(*change) > T(most_change) * in_alike ? residual : in_alike;
}

template class StepDifferentiator<double>;
template class StepDifferentiator<Quad>;
template class KeptStructure<double>;
template class KeptStructure<Quad>;
template class StructureResidual<double>;
template class StructureResidual<Quad>;
template std::vector<double> tangent_projection(const Model&, const double&, const std::vector<double>&);
template std::vector<Quad> tangent_projection(const Model&, const Quad&, const std::vector<Quad>&);

}  // namespace pfaff
