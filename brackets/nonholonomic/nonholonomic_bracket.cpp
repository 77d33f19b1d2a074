#include <pfaff/brackets/nonholonomic/nonholonomic_bracket.hpp>

#include <algorithm>

#include <pfaff/brackets/conformance/residuals.hpp>
#include <pfaff/core/facets/sparse_tape.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

namespace {

using RecordedList = std::vector<Recorded>;

// H_pp as a function of (q, p, t).
Tape second_derivatives(const Tape& gradient, std::size_t n) {
  return record(gradient.inputs, static_cast<int>(n * n),
                [&](const Recorded& t, std::span<const Recorded> z, std::span<Recorded> out) {
                  const RecordedList all = jacobian(gradient, t, z);
                  for (std::size_t i = 0; i < n; ++i)
                    for (std::size_t j = 0; j < n; ++j) out[i * n + j] = all[(n + i) * 2 * n + n + j];
                });
}

// Tapes hold nothing that their outputs do not need.
bool depends_on_momenta(const Tape& tape, std::size_t n) {
  return std::any_of(tape.code.begin(), tape.code.end(), [n](const Instruction& i) {
    return i.operation == Operation::input && i.a >= static_cast<int>(n);
  });
}

template <class T>
std::vector<T> replayed(const std::shared_ptr<const Tape>& tape, const T& t, const std::vector<T>& x) {
  std::vector<T> out(tape->outputs.size());
  Replay<T> replay(tape);
  replay(t, x.data(), out.data());
  return out;
}

// The largest component of Pibar covector, relative to the largest sum of absolute values of the terms of
// one.
template <class T>
double image_of(const Matrix<T>& tensor, const std::vector<T>& covector) {
  IdentityResidual<T> worst;
  for (std::size_t i = 0; i < tensor.rows(); ++i) {
    IdentityResidual<T> r;
    for (std::size_t j = 0; j < covector.size(); ++j) r.add(tensor(i, j) * covector[j]);
    if (!(abs(r.residual) <= worst.residual)) worst.residual = abs(r.residual);
    if (!(r.size <= worst.size)) worst.size = r.size;
  }
  return worst.relative();
}

template <class T>
Jacobiator<T> largest_jacobiator(const Matrix<T>& p, const std::vector<Matrix<T>>& slopes) {
  Jacobiator<T> worst;
  const std::size_t n = p.rows();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      for (std::size_t k = j + 1; k < n; ++k) {
        T sum(0);
        for (std::size_t l = 0; l < n; ++l)
          sum = sum + p(i, l) * slopes[l](j, k) + p(j, l) * slopes[l](k, i) + p(k, l) * slopes[l](i, j);
        // Of sums that are equal but for rounding the first one is named, in every precision.
        const T margin = abs(worst.value) / T(1 << 20);
        if (worst.coordinates[2] == 0 || abs(sum) > abs(worst.value) + margin) worst = {sum, {i, j, k}};
      }
  return worst;
}

}  // namespace

NonholonomicBracket::NonholonomicBracket(const Model& model) {
  if (!model.content().has(Facet::velocity_constraints))
    throw InputError("nonholonomic bracket: system " + model.name() +
                     " has no velocity constraints; expected A(q, t) v + b(q, t) = 0");
  const auto gradient = model.tape(Formula::hamiltonian_gradient),
             a = model.tape(Formula::velocity_constraints), b = model.tape(Formula::velocity_offsets),
             phi = model.given(Formula::holonomic) ? model.tape(Formula::holonomic) : nullptr;
  const std::size_t n = degrees_ = static_cast<std::size_t>(a->inputs);
  const Tape metric = second_derivatives(*gradient, n);
  if (depends_on_momenta(metric, n))
    throw InputError("nonholonomic bracket: the Hamiltonian of system " + model.name() +
                     " is not quadratic in the momenta; expected a kinetic energy with a mass matrix M(q)");
  for (const std::string& name : model.source().constraint_names) names_.push_back(name + "~");
  for (const std::string& name : model.source().velocity_constraint_names) names_.push_back(name);

  linear_ =
      record_list(static_cast<int>(n), [&](const Recorded& t, const RecordedList& q, RecordedList& out) {
        RecordedList at_rest = q;
        at_rest.resize(2 * n, Recorded(0));
        const RecordedList slopes = evaluate(*gradient, t, at_rest), offsets = evaluate(*b, t, q);
        const auto v = std::span<const Recorded>(slopes).subspan(n);  // H_p at p = 0
        RecordedList rows = phi == nullptr ? RecordedList{} : jacobian(*phi, t, q);
        append(rows, evaluate(*a, t, q));
        RecordedList psi = phi == nullptr ? RecordedList{} : time_derivative(*phi, t, q);
        append(psi, offsets);
        for (std::size_t i = 0; i < psi.size(); ++i)
          for (std::size_t k = 0; k < n; ++k) psi[i] = psi[i] + rows[i * n + k] * v[k];
        append(out, rows);
        append(out, evaluate(metric, t, at_rest));
        append(out, psi);
      });
}

// The projection at a time, as a field over positions.
template <class T>
struct NonholonomicBracket::Projection {
  const NonholonomicBracket& bracket;
  const T& t;

  template <class S>
  [[nodiscard]] AlmostProduct<S> structure(const Matrix<S>& rows, const Matrix<S>& inverse_metric) const {
    return orthogonal(ContravariantTensor<S>(inverse_metric), covectors_in_rows(rows), bracket.names_);
  }
  template <class S>
  [[nodiscard]] MomentumProjector<S> at(const std::vector<S>& q) const {
    const std::size_t n = bracket.degrees_, m = bracket.names_.size();
    const std::vector<S> out = replayed(bracket.linear_, S(t), q);
    const std::span<const S> all(out);
    const Matrix<S> rows(m, all.first(m * n)), inverse_metric(n, all.subspan(m * n, n * n));
    const auto projectors = structure(rows, inverse_metric);
    // -A^T G^-1 psi(q, 0)
    const std::vector<S> weights = inverse(rows * inverse_metric * rows.transposed()) *
                                   std::vector<S>(out.end() - static_cast<std::ptrdiff_t>(m), out.end());
    Covector<S> shift(n);
    for (std::size_t a = 0; a < m; ++a) shift = shift - weights[a] * projectors.one_forms()[a];
    return {projectors.admissible(), shift};
  }
};

template <class T>
AlmostProduct<T> NonholonomicBracket::projectors(const T& t, const std::vector<T>& q) const {
  const std::size_t n = degrees_, m = names_.size();
  const std::vector<T> out = replayed(linear_, t, q);
  const std::span<const T> all(out);
  return Projection<T>{*this, t}.structure(Matrix<T>(m, all.first(m * n)),
                                           Matrix<T>(n, all.subspan(m * n, n * n)));
}

template <class T>
std::vector<T> NonholonomicBracket::projected(const T& t, const std::vector<T>& z) const {
  const auto half = z.begin() + static_cast<std::ptrdiff_t>(degrees_);
  const std::vector<T> q(z.begin(), half);
  std::vector<T> result = q;
  const Covector<T> p = Projection<T>{*this, t}.at(q)(Covector<T>(std::vector<T>(half, z.end())));
  result.insert(result.end(), p.components().begin(), p.components().end());
  return result;
}

template <class T>
Matrix<T> NonholonomicBracket::tensor(const T& t, const std::vector<T>& z) const {
  const std::vector<T> on_surface = projected(t, z);
  const auto half = on_surface.begin() + static_cast<std::ptrdiff_t>(degrees_);
  return pseudo_poisson_tensor<T>(Projection<T>{*this, t}, std::vector<T>(on_surface.begin(), half),
                                  Covector<T>(std::vector<T>(half, on_surface.end())));
}

template <class T>
NonholonomicPoint<T> nonholonomic_point(const Model& model, const T& t, const std::vector<T>& z) {
  using D = Dual<T, 1>;
  const NonholonomicBracket bracket(model);
  const std::size_t n = bracket.degrees();
  const std::vector<T> on_surface = bracket.projected(t, z);
  const auto projectors =
      bracket.projectors(t, std::vector<T>(z.begin(), z.begin() + static_cast<std::ptrdiff_t>(n)));
  NonholonomicPoint<T> point{projectors.admissible(), bracket.tensor(t, z), 0, 0, 0, {}};
  point.rank = detail::rank_of(point.tensor);

  const Matrix<T> gradients(model.constraint_names().size(),
                            replayed(model.tape(Formula::constraint_gradients), t, on_surface));
  for (std::size_t i = 0; i < gradients.rows(); ++i)
    point.casimirs =
        std::max(point.casimirs, image_of(point.tensor, gradients.block(i, 0, 1, 2 * n).entries()));
  for (const Covector<T>& w : projectors.one_forms()) {
    std::vector<T> covector = w.components();
    covector.resize(2 * n);
    point.one_forms = std::max(point.one_forms, image_of(point.tensor, covector));
  }

  std::vector<Matrix<T>> slopes;
  std::vector<D> moved(on_surface.begin(), on_surface.end());
  for (std::size_t l = 0; l < 2 * n; ++l) {
    moved[l].derivative[0] = T(1);
    const Matrix<D> there = bracket.tensor<D>(D(t), moved);
    moved[l].derivative[0] = T(0);
    Matrix<T> slope(2 * n, 2 * n);
    for (std::size_t i = 0; i < 2 * n; ++i)
      for (std::size_t j = 0; j < 2 * n; ++j) slope(i, j) = there(i, j).derivative[0];
    slopes.push_back(std::move(slope));
  }
  point.jacobiator = largest_jacobiator(point.tensor, slopes);
  return point;
}

#define PFAFF_INSTANTIATE(T)                                                                        \
  template AlmostProduct<T> NonholonomicBracket::projectors(const T&, const std::vector<T>&) const; \
  template std::vector<T> NonholonomicBracket::projected(const T&, const std::vector<T>&) const;    \
  template Matrix<T> NonholonomicBracket::tensor(const T&, const std::vector<T>&) const;            \
  template NonholonomicPoint<T> nonholonomic_point(const Model&, const T&, const std::vector<T>&);
PFAFF_INSTANTIATE(double)
PFAFF_INSTANTIATE(Quad)
#undef PFAFF_INSTANTIATE
// For residuals with derivatives by duals (sharp).
template Matrix<Dual<double, 1>> NonholonomicBracket::tensor(const Dual<double, 1>&,
                                                             const std::vector<Dual<double, 1>>&) const;
template Matrix<Dual<Quad, 1>> NonholonomicBracket::tensor(const Dual<Quad, 1>&,
                                                           const std::vector<Dual<Quad, 1>>&) const;

}  // namespace pfaff
