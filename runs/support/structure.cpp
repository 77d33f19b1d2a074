#include <pfaff/runs/support/structure.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfaff {

template <class T>
StepDifferentiator<T>::StepDifferentiator(const MethodInstance& method, std::shared_ptr<const Model> model)
    : stepper_(method.stepper(std::move(model), StepDual<T>())) {}

template <class T>
StepJacobian<T> StepDifferentiator<T>::operator()(const T& t, const T& h, const std::vector<T>& z) {
  return jacobian_of_map(z, [&](std::vector<StepDual<T>>& moved) {
    stepper_->forget();
    std::int64_t completed = 0;
    return stepper_->advance(StepDual<T>(t), 0, StepDual<T>(h), 1, moved, completed);
  });
}

namespace {
// The product a b of n x n matrices.
template <class T>
std::vector<T> product(const std::vector<T>& a, const std::vector<T>& b, std::size_t n) {
  std::vector<T> c(n * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t j = 0; j < n; ++j) c[i * n + j] = c[i * n + j] + a[i * n + k] * b[k * n + j];
  return c;
}

template <class T>
std::vector<T> absolute(std::vector<T> a) {
  for (T& x : a) x = abs(x);
  return a;
}

// Units of coordinates, as powers of two, in which the largest entry in each row of A^T |K1| A is about one,
// A being |M| + 1: a symmetric matrix is divided by roots of the largest numbers of its rows until these are
// alike. The unit matrix is there for directions that M leads to nothing, whose entries are round-off. Where
// units would differ by less than `ordinary` all are one, so that the residuals of ordinary systems are those
// of their own coordinates.
template <class T>
std::vector<T> equilibrating_units(const std::vector<T>& m, const std::vector<T>& k1, std::size_t n) {
  constexpr int passes = 20;
  constexpr double ordinary = 64;
  constexpr double none = -std::numeric_limits<double>::infinity();
  std::vector<T> moved = absolute(m), transposed(n * n);
  for (std::size_t i = 0; i < n; ++i) moved[i * n + i] = moved[i * n + i] + T(1);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) transposed[j * n + i] = moved[i * n + j];
  const std::vector<T> sizes = product(transposed, product(absolute(k1), moved, n), n);
  std::vector<double> logarithms(n * n), exponent(n), change(n);
  for (std::size_t k = 0; k < n * n; ++k) {
    const auto size = static_cast<double>(sizes[k]);
    logarithms[k] = size > 0 && std::isfinite(size) ? std::log2(size) : none;
  }
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t i = 0; i < n; ++i) {
      double largest = none;
      for (std::size_t j = 0; j < n; ++j)
        largest = std::max(largest, logarithms[i * n + j] - exponent[i] - exponent[j]);
      change[i] = largest == none ? 0 : largest / 2;
    }
    for (std::size_t i = 0; i < n; ++i) exponent[i] += change[i];
  }
  const auto [least, most] = std::minmax_element(exponent.begin(), exponent.end());
  std::vector<T> units(n, T(1));
  if (*most - *least > std::log2(ordinary))
    for (std::size_t i = 0; i < n; ++i) units[i] = T(std::exp2(std::round(exponent[i])));
  return units;
}

}  // namespace

template <class T>
T congruence_residual(const std::vector<T>& m, const std::vector<T>& k1, const std::vector<T>& k0) {
  const auto n = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(m.size()))));
  const std::vector<T> image = product(k1, m, n);  // image_size sums the absolute values of the same terms
  const std::vector<T> image_size = product(absolute(k1), absolute(m), n);
  std::vector<T> differences(n * n), sizes(n * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      T sum(0), size(0);
      for (std::size_t a = 0; a < n; ++a) {
        sum = sum + m[a * n + i] * image[a * n + j];
        size = size + abs(m[a * n + i]) * image_size[a * n + j];
      }
      differences[i * n + j] = abs(sum - k0[i * n + j]);
      sizes[i * n + j] = size;
      if (isnan(differences[i * n + j])) return differences[i * n + j];
    }
  const std::vector<T> units = equilibrating_units(m, k1, n);
  T worst(0), scale(0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      worst = std::max(worst, T(differences[i * n + j] / units[i] / units[j]));
      scale = std::max(scale, T(sizes[i * n + j] / units[i] / units[j]));
    }
  return worst / scale;
}

std::string_view structure_name(const Model& model) {
  const FacetSet facets = model.facets();
  if (model.holonomic()) return "constrained-symplectic";
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

namespace {
// The residual M^T J M - J restricted to tangent vectors: (M U)^T J (M U) - U^T J U, where U is the
// projection onto the tangent space.
template <class T>
T tangent_residual(const std::vector<T>& m, const std::vector<T>& u, const std::vector<T>& units,
                   std::size_t n) {
  std::vector<T> j(n * n), transposed(n * n);
  for (std::size_t k = 0; k < n / 2; ++k) {
    j[k * n + n / 2 + k] = T(-1);
    j[(n / 2 + k) * n + k] = T(1);
  }
  j = in_units(std::move(j), units, 1, 1);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k) transposed[k * n + i] = u[i * n + k];
  return congruence_residual(product(m, u, n), j, product(transposed, product(j, u, n), n));
}
}  // namespace

template <class T>
T KeptStructure<T>::operator()(const StepJacobian<T>& step, const T& t, const T& h, const std::vector<T>& z,
                               const std::vector<T>& units) {
  if (step.status != Status::converged) return std::numeric_limits<T>::quiet_NaN();
  const std::size_t n = z.size();
  const std::vector<T> jacobian = in_units(step.jacobian, units, -1, 1);
  if (constrained_) {
    const std::vector<T> tangent = in_units(tangent_projection(*problem_.model(), t, z), units, -1, 1);
    return tangent_residual(jacobian, tangent, units, n);
  }
  std::vector<T> before(n * n), after(n * n);
  if (!poisson_) {
    problem_.structure(t, z, before);
    problem_.structure(t + h, step.z, after);
    return congruence_residual(jacobian, in_units(std::move(after), units, 1, 1),
                               in_units(std::move(before), units, 1, 1));
  }
  problem_.poisson_tensor(t, z, before);
  problem_.poisson_tensor(t + h, step.z, after);
  std::vector<T> transposed(n * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) transposed[j * n + i] = jacobian[i * n + j];
  return congruence_residual(transposed, in_units(std::move(before), units, -1, -1),
                             in_units(std::move(after), units, -1, -1));
}

template class StepDifferentiator<double>;
template class StepDifferentiator<Quad>;
template class KeptStructure<double>;
template class KeptStructure<Quad>;
template std::vector<double> tangent_projection(const Model&, const double&, const std::vector<double>&);
template std::vector<Quad> tangent_projection(const Model&, const Quad&, const std::vector<Quad>&);
template double congruence_residual(const std::vector<double>&, const std::vector<double>&,
                                    const std::vector<double>&);
template Quad congruence_residual(const std::vector<Quad>&, const std::vector<Quad>&,
                                  const std::vector<Quad>&);

}  // namespace pfaff
