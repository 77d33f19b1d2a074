#include <pfaff/core/facets/conformance/dense_velocity_constraints.hpp>

#include <stdexcept>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/tape/derivatives.hpp>

namespace pfaff {

namespace {
using Numbers = std::vector<Recorded>;

void append_entries(const Numbers& numbers, std::size_t& at, Out<Recorded> out) {
  for (const Recorded& x : numbers) out[at++] = x;
}

std::size_t holonomic_count(const Model& model) {
  return model.given(Formula::holonomic) ? model.tape(Formula::holonomic)->outputs.size() : 0;
}
std::size_t velocity_count(const Model& model) {
  if (!model.content().has(Facet::velocity_constraints))
    throw std::logic_error("system " + model.name() + " has no velocity constraints");
  return model.tape(Formula::velocity_offsets)->outputs.size();
}

// (q, t) -> A row by row, then b.
Tape record_linear(const Model& model) {
  const auto a = model.tape(Formula::velocity_constraints), b = model.tape(Formula::velocity_offsets);
  const std::size_t n = static_cast<std::size_t>(a->inputs), before = holonomic_count(model),
                    count = before + velocity_count(model);
  return record(a->inputs, static_cast<int>(count * (n + 1)),
                [&](const Recorded& t, In<Recorded> q, Out<Recorded> out) {
                  std::size_t row = 0, offset = count * n;
                  if (before > 0) {
                    const Tape& phi = *model.tape(Formula::holonomic);
                    append_entries(jacobian(phi, t, q), row, out);
                    append_entries(time_derivative(phi, t, q), offset, out);
                  }
                  append_entries(evaluate(*a, t, q), row, out);
                  append_entries(evaluate(*b, t, q), offset, out);
                });
}

// (q, p, t) -> H_p, -H_q, H_pq H_p + H_pt, H_pp row by row, dpsi/dq, A, b, and A' and b' along q' = H_p.
std::shared_ptr<const Tape> record_velocity_constraints(const Model& model) {
  const Tape linear = record_linear(model);
  const auto slopes = model.tape(Formula::hamiltonian_gradient);
  const std::size_t n = static_cast<std::size_t>(linear.inputs), size = 2 * n, rows = linear.outputs.size(),
                    count = rows / (n + 1);
  const Tape psi = record(static_cast<int>(size), static_cast<int>(count),
                          [&](const Recorded& t, In<Recorded> z, Out<Recorded> out) {
                            const Numbers entries = evaluate(linear, t, z.first(n)),
                                          slope = evaluate(*slopes, t, z);
                            for (std::size_t i = 0; i < count; ++i) {
                              out[i] = entries[count * n + i];
                              for (std::size_t k = 0; k < n; ++k)
                                out[i] = out[i] + entries[i * n + k] * slope[n + k];
                            }
                          });
  return std::make_shared<const Tape>(
      record(static_cast<int>(size), static_cast<int>(3 * n + n * n + count * n + 2 * rows),
             [&](const Recorded& t, In<Recorded> z, Out<Recorded> out) {
               std::size_t at = 0;
               const Numbers gradient = evaluate(*slopes, t, z), curvature = jacobian(*slopes, t, z);
               const Numbers v(gradient.begin() + static_cast<std::ptrdiff_t>(n), gradient.end());
               Numbers flow = v;
               flow.resize(size);
               const Numbers moved = directional_derivative(*slopes, t, Recorded(1), z, flow);
               append_entries(v, at, out);
               Numbers forces(n);
               if (model.forced()) forces = evaluate(*model.tape(Formula::applied_force), t, z);
               for (std::size_t k = 0; k < n; ++k) out[at++] = forces[k] - gradient[k];
               for (std::size_t k = 0; k < n; ++k) out[at++] = moved[n + k];
               for (std::size_t i = 0; i < n; ++i)
                 for (std::size_t j = 0; j < n; ++j) out[at++] = curvature[(n + i) * size + n + j];
               const Numbers slopes_of_psi = jacobian(psi, t, z);
               for (std::size_t i = 0; i < count; ++i)
                 for (std::size_t j = 0; j < n; ++j) out[at++] = slopes_of_psi[i * size + j];
               append_entries(evaluate(linear, t, z.first(n)), at, out);
               append_entries(directional_derivative(linear, t, Recorded(1), z.first(n), v), at, out);
             }));
}

// (q, w, lambda, t) -> the gradient by q of lambda.(A w + b).
std::shared_ptr<const Tape> record_reaction(const Model& model) {
  const Tape linear = record_linear(model);
  const std::size_t n = static_cast<std::size_t>(linear.inputs), count = linear.outputs.size() / (n + 1);
  const int inputs = static_cast<int>(2 * n + count);
  const Tape product = record(inputs, 1, [&](const Recorded& t, In<Recorded> x, Out<Recorded> out) {
    const Numbers entries = evaluate(linear, t, x.first(n));
    for (std::size_t i = 0; i < count; ++i) {
      Recorded sum = entries[count * n + i];
      for (std::size_t k = 0; k < n; ++k) sum = sum + entries[i * n + k] * x[n + k];
      out[0] = out[0] + x[2 * n + i] * sum;
    }
  });
  return std::make_shared<const Tape>(
      record(inputs, static_cast<int>(n), [&](const Recorded& t, In<Recorded> x, Out<Recorded> out) {
        const Numbers one{Recorded(1)}, slopes = gradient(product, t, x, one);
        for (std::size_t k = 0; k < n; ++k) out[k] = slopes[k];
      }));
}

}  // namespace

DenseVelocityConstraints::DenseVelocityConstraints(const Model& model)
    : rows(0, 0),
      by_position(0, 0),
      by_momentum(0, 0),
      s(0, 0),
      inverse_mass(0, 0),
      holonomic_(holonomic_count(model)),
      count_(holonomic_ + velocity_count(model)),
      degrees_(static_cast<std::size_t>(model.dimension()) / 2),
      everything_(record_velocity_constraints(model)),
      gradient_(model.tape(Formula::hamiltonian_gradient)),
      reaction_(record_reaction(model)),
      numbers_(everything_.tape().outputs.size()) {}

void DenseVelocityConstraints::place(Quad t, In<Quad> z) {
  time_ = t;
  state_.assign(z.begin(), z.end());
  everything_(t, z.data(), numbers_.data());
  const In<Quad> all(numbers_);
  std::size_t at = 0;
  const auto take = [&](std::size_t size) {
    const In<Quad> part = all.subspan(at, size);
    at += size;
    return std::vector<Quad>(part.begin(), part.end());
  };
  velocities = take(degrees_);
  forces = take(degrees_);
  drift = take(degrees_);
  inverse_mass = Matrix<Quad>(degrees_, take(degrees_ * degrees_));
  by_position = Matrix<Quad>(count_, take(count_ * degrees_));
  rows = Matrix<Quad>(count_, take(count_ * degrees_));
  offsets = take(count_);
  const Matrix<Quad> turned(count_, take(count_ * degrees_));
  const std::vector<Quad> moved = take(count_);
  by_momentum = rows * inverse_mass;
  s = by_momentum * rows.transposed();
  residuals = rows * velocities;
  turning = turned * velocities;
  rates = rows * drift;
  const std::vector<Quad> pushed = by_momentum * forces;
  for (std::size_t i = 0; i < count_; ++i) {
    residuals[i] += offsets[i];
    turning[i] += moved[i];
    rates[i] += turning[i] + pushed[i];
  }
}

double DenseVelocityConstraints::condition() const {
  const auto size = static_cast<double>(largest(s) * largest(inverse(s)));
  return std::isnan(size) ? std::numeric_limits<double>::infinity() : static_cast<double>(count_) * size;
}

std::vector<Quad> DenseVelocityConstraints::saddle_point(const std::vector<Quad>& upper,
                                                         const std::vector<Quad>& lower) const {
  const Matrix<Quad> mass = inverse(inverse_mass);
  const std::size_t n = degrees_, size = n + count_;
  LU<Quad> lu(size);
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j < size; ++j)
      lu(i, j) = i < n ? (j < n ? mass(i, j) : rows(j - n, i)) : (j < n ? rows(i - n, j) : Quad(0));
  std::vector<Quad> right(size), x(size, Quad(std::numeric_limits<double>::quiet_NaN()));
  for (std::size_t i = 0; i < size; ++i) right[i] = i < n ? upper[i] : lower[i - n];
  if (lu.factor()) lu.solve(right.data(), x.data());
  return x;
}

std::vector<Quad> DenseVelocityConstraints::nonholonomic_motion() const {
  // v' = drift + H_pp p' with p' = f - A^T lambda, so that M v' + A^T lambda = f + M drift.
  std::vector<Quad> upper = inverse(inverse_mass) * drift, lower;
  for (std::size_t k = 0; k < degrees_; ++k) upper[k] += forces[k];
  for (const Quad& x : turning) lower.push_back(-x);
  const std::vector<Quad> x = saddle_point(upper, lower);
  const std::vector<Quad> reaction =
      rows.transposed() * std::vector<Quad>(x.begin() + static_cast<std::ptrdiff_t>(degrees_), x.end());
  std::vector<Quad> rate = velocities;
  for (std::size_t k = 0; k < degrees_; ++k) rate.push_back(forces[k] - reaction[k]);
  return rate;
}

std::vector<Quad> DenseVelocityConstraints::vakonomic_motion() {
  // p - A^T lambda = p + M (w - v): momenta are those of w.
  std::vector<Quad> lower;
  for (const Quad& x : offsets) lower.push_back(-x);
  const std::vector<Quad> x = saddle_point(inverse(inverse_mass) * velocities, lower);
  const auto end = x.begin() + static_cast<std::ptrdiff_t>(degrees_);
  const std::vector<Quad> multipliers(end, x.end()), reaction = rows.transposed() * multipliers;
  std::vector<Quad> moving = state_, slopes(2 * degrees_), turn(degrees_);
  for (std::size_t k = 0; k < degrees_; ++k) moving[degrees_ + k] -= reaction[k];
  gradient_(time_, moving.data(), slopes.data());
  std::vector<Quad> at(state_.begin(), state_.begin() + static_cast<std::ptrdiff_t>(degrees_));
  at.insert(at.end(), x.begin(), x.end());
  reaction_(time_, at.data(), turn.data());
  std::vector<Quad> rate(x.begin(), end);
  for (std::size_t k = 0; k < degrees_; ++k) rate.push_back(turn[k] - slopes[k]);
  return rate;
}

}  // namespace pfaff
