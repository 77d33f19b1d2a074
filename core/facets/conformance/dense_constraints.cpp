#include <pfaff/core/facets/conformance/dense_constraints.hpp>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/tape/derivatives.hpp>

namespace pfaff {

namespace {
using Numbers = std::vector<Recorded>;

// (q, p, t) -> phi, phi~, h, H_p, -H_q, lambda, B, (T, P) row by row.
std::shared_ptr<const Tape> record_constraints(const Model& model) {
  const auto phi = model.tape(Formula::holonomic), slopes = model.tape(Formula::hamiltonian_gradient);
  const auto n = static_cast<std::size_t>(phi->inputs), count = phi->outputs.size();
  const int inputs = static_cast<int>(2 * n);
  const Tape hidden =
      record(inputs, static_cast<int>(count), [&](const Recorded& t, In<Recorded> z, Out<Recorded> out) {
        const Numbers gradient = evaluate(*slopes, t, z);
        const Numbers rates =
            directional_derivative(*phi, t, Recorded(1), z.first(n), In<Recorded>(gradient).subspan(n));
        std::copy(rates.begin(), rates.end(), out.begin());
      });
  const std::size_t outputs = 3 * count + 3 * n + 3 * count * n;
  return std::make_shared<const Tape>(
      record(inputs, static_cast<int>(outputs), [&](const Recorded& t, In<Recorded> z, Out<Recorded> out) {
        std::size_t at = 0;
        const auto append = [&](const Numbers& numbers) {
          for (const Recorded& x : numbers) out[at++] = x;
        };
        const Numbers gradient = evaluate(*slopes, t, z);
        Numbers flow(2 * n);
        for (std::size_t k = 0; k < n; ++k) flow[k] = gradient[n + k], flow[n + k] = -gradient[k];
        if (model.forced()) {
          const Numbers applied = evaluate(*model.tape(Formula::applied_force), t, z);
          for (std::size_t k = 0; k < n; ++k) flow[n + k] = flow[n + k] + applied[k];
        }
        append(evaluate(*phi, t, z.first(n)));
        append(evaluate(hidden, t, z));
        append(directional_derivative(hidden, t, Recorded(1), z, flow));
        append(flow);
        if (model.given(Formula::friction))
          append(evaluate(*model.tape(Formula::friction), t, z));
        else
          for (std::size_t k = 0; k < n; ++k) out[at++] = Recorded(0);
        append(jacobian(*phi, t, z.first(n)));
        append(jacobian(hidden, t, z));
      }));
}

// a x = b; not-a-number where a is singular.
std::vector<Quad> dense_solve(const Matrix<Quad>& a, const std::vector<Quad>& b) {
  const std::size_t n = a.rows();
  LU<Quad> lu(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) lu(i, j) = a(i, j);
  std::vector<Quad> x(n, Quad(std::numeric_limits<double>::quiet_NaN()));
  if (lu.factor()) lu.solve(b.data(), x.data());
  return x;
}

void set_block(Matrix<Quad>& m, std::size_t row, std::size_t column, const Matrix<Quad>& block) {
  for (std::size_t i = 0; i < block.rows(); ++i)
    for (std::size_t j = 0; j < block.columns(); ++j) m(row + i, column + j) = block(i, j);
}

}  // namespace

DenseConstraints::DenseConstraints(const Model& model)
    : by_position(0, 0),
      by_momentum(0, 0),
      hidden_by_position(0, 0),
      s(0, 0),
      count_(model.tape(Formula::holonomic)->outputs.size()),
      degrees_(static_cast<std::size_t>(model.dimension()) / 2),
      everything_(record_constraints(model)),
      numbers_(3 * count_ + 3 * degrees_ + 3 * count_ * degrees_) {}

void DenseConstraints::place(Quad t, In<Quad> z) {
  everything_(t, z.data(), numbers_.data());
  const In<Quad> all(numbers_);
  std::size_t at = 0;
  const auto take = [&](std::size_t size) {
    const In<Quad> part = all.subspan(at, size);
    at += size;
    return std::vector<Quad>(part.begin(), part.end());
  };
  residuals = take(count_);
  hidden = take(count_);
  hidden_rates = take(count_);
  velocities = take(degrees_);
  forces = take(degrees_);
  friction = take(degrees_);
  by_position = Matrix<Quad>(count_, take(count_ * degrees_));
  const Matrix<Quad> slopes(count_, take(2 * count_ * degrees_));
  hidden_by_position = slopes.block(0, 0, count_, degrees_);
  by_momentum = slopes.block(0, degrees_, count_, degrees_);
  s = by_momentum * by_position.transposed();
}

double DenseConstraints::condition() const {
  if (count_ == 0) return 1;
  const auto size = static_cast<double>(largest(s) * largest(inverse(s)));
  return std::isnan(size) ? std::numeric_limits<double>::infinity() : static_cast<double>(count_) * size;
}

std::vector<Quad> DenseConstraints::rates(Reactions reactions) const {
  if (reactions == Reactions::other) return {};
  const std::size_t n = degrees_, k = count_;
  std::vector<Quad> rate = velocities;
  rate.insert(rate.end(), forces.begin(), forces.end());
  if (k == 0) return rate;
  // Rows: the rates of phi~, or of phi and phi~, as functions of (q', p'); columns: the reactions.
  const bool both = reactions != Reactions::ideal;
  Matrix<Quad> rows(both ? 2 * k : k, 2 * n), columns(2 * n, both ? 2 * k : k);
  std::vector<Quad> unwanted;  // what those rates are without reactions
  if (both) {
    set_block(rows, 0, 0, by_position);
    unwanted = hidden;
  }
  set_block(rows, both ? k : 0, 0, hidden_by_position);
  set_block(rows, both ? k : 0, n, by_momentum);
  unwanted.insert(unwanted.end(), hidden_rates.begin(), hidden_rates.end());
  set_block(columns, n, 0, by_position.transposed());
  if (both) set_block(columns, 0, k, by_momentum.transposed());
  if (reactions == Reactions::hamiltonian) set_block(columns, n, k, -hidden_by_position.transposed());
  const std::vector<Quad> reaction = columns * dense_solve(rows * columns, unwanted);
  for (std::size_t i = 0; i < 2 * n; ++i) rate[i] = rate[i] - reaction[i];
  return rate;
}

std::vector<Quad> DenseConstraints::response(const std::vector<Quad>& f) const {
  std::vector<Quad> rest = f;
  if (count_ == 0) return rest;
  const std::vector<Quad> reaction = by_position.transposed() * dense_solve(s, by_momentum * f);
  for (std::size_t i = 0; i < degrees_; ++i) rest[i] = rest[i] - reaction[i];
  return rest;
}

std::vector<Quad> DenseConstraints::metriplectic_friction() const {
  // Gram and Schmidt on the columns of Lambda^1/2 P^T, twice; those that depend on others are left out.
  std::vector<std::vector<Quad>> range;
  const auto remove_range = [&](std::vector<Quad>& w) {
    for (int again = 0; again < 2; ++again)
      for (const std::vector<Quad>& unit : range) {
        Quad along(0);
        for (std::size_t a = 0; a < degrees_; ++a) along += unit[a] * w[a];
        for (std::size_t a = 0; a < degrees_; ++a) w[a] -= along * unit[a];
      }
  };
  const auto norm = [&](const std::vector<Quad>& w) {
    Quad square(0);
    for (const Quad& x : w) square += x * x;
    return sqrt(square);
  };
  for (std::size_t i = 0; i < count_; ++i) {
    std::vector<Quad> w(degrees_);
    for (std::size_t a = 0; a < degrees_; ++a) w[a] = sqrt(friction[a]) * by_momentum(i, a);
    const Quad before = norm(w);
    remove_range(w);
    const Quad after = norm(w);
    if (!(after > Quad(1e-24) * before)) continue;
    for (Quad& x : w) x = x / after;
    range.push_back(std::move(w));
  }
  std::vector<Quad> force(degrees_);
  for (std::size_t a = 0; a < degrees_; ++a) force[a] = sqrt(friction[a]) * velocities[a];
  remove_range(force);
  for (std::size_t a = 0; a < degrees_; ++a) force[a] = -(sqrt(friction[a]) * force[a]);
  return force;
}

std::vector<Quad> DenseConstraints::stokes_friction() const {
  std::vector<Quad> force(degrees_);
  for (std::size_t a = 0; a < degrees_; ++a) force[a] = -(friction[a] * velocities[a]);
  if (count_ == 0) return force;
  const std::vector<Quad> reaction = by_position.transposed() * dense_solve(s, by_momentum * force);
  for (std::size_t a = 0; a < degrees_; ++a) force[a] -= reaction[a];
  return force;
}

}  // namespace pfaff
