#include <pfaff/verify/dense_motion.hpp>

#include <cmath>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/tape/derivatives.hpp>

namespace pfaff {

namespace {

std::shared_ptr<const Tape> time_derivative_tape(const Tape& tape) {
  return std::make_shared<const Tape>(record(tape.inputs, static_cast<int>(tape.outputs.size()),
                                             [&](const Recorded& t, In<Recorded> z, Out<Recorded> out) {
                                               const auto rates = time_derivative(tape, t, z);
                                               std::copy(rates.begin(), rates.end(), out.begin());
                                             }));
}

std::vector<Quad> values(Replay<Quad>& replay, Quad t, const std::vector<Quad>& z) {
  std::vector<Quad> out(replay.tape().outputs.size());
  replay(t, z.data(), out.data());
  return out;
}

// Sums of terms, each kept together with the sum of the sizes of its terms and of the bounds of their errors,
// in units of round-off, which is the scale of its rounding.
class Sums {
 public:
  void add(Quad term) {
    sum_ += term;
    scale_ += abs(term);
  }
  // factor * x, where x is known up to `bound`.
  void add(Quad factor, Quad x, Quad bound) {
    add(factor * x);
    scale_ += abs(factor) * bound;
  }
  // The sum is known up to the rounding of something of this size.
  void allow(Quad size) { scale_ += abs(size); }
  // Ends the current sum and keeps in `worst` the largest ratio |sum| / scale of all sums so far.
  void end(double& worst) {
    const double ratio = sum_ == Quad(0) ? 0 : static_cast<double>(abs(sum_) / scale_);
    worst = std::isnan(ratio) || std::isnan(worst) ? NAN : std::max(worst, ratio);
    sum_ = scale_ = Quad(0);
  }

 private:
  Quad sum_{0}, scale_{0};
};

}  // namespace

DenseMotion::PhaseSpace::PhaseSpace(const Model& model)
    : gradients(model.derived(Formula::constraint_gradients)),
      moving(time_derivative_tape(*model.tape(Formula::constraints))),
      poisson(model.tape(Formula::poisson_tensor)),
      slope(model.tape(Formula::hamiltonian_gradient)) {
  if (!model.given(Formula::symmetric_tensor)) return;
  symmetric.emplace_back(model.tape(Formula::symmetric_tensor));
  if (model.given(Formula::entropy))
    entropy.emplace_back(std::make_shared<const Tape>(jacobian_tape(*model.tape(Formula::entropy))));
}

void DenseMotion::PhaseSpace::place(Quad t, const std::vector<Quad>& z) {
  const std::size_t n = z.size();
  shift = values(moving, t, z);
  rows = Matrix<Quad>(shift.size(), values(gradients, t, z));
  pi = Matrix<Quad>(n, values(poisson, t, z));
  energy = values(slope, t, z);
  if (symmetric.empty()) return;
  g = Matrix<Quad>(n, values(symmetric.front(), t, z));
  direction = energy;
  for (Quad& x : direction) x = -x;
  if (!entropy.empty()) direction = values(entropy.front(), t, z);
}

std::vector<Quad> DenseMotion::PhaseSpace::projected(const Matrix<Quad>& tensor,
                                                     const std::vector<Quad>& covector,
                                                     const std::vector<Quad>& moved) const {
  std::vector<Quad> vector = tensor * covector;
  const Matrix<Quad> sharps = tensor * rows.transposed(), w = rows * sharps;
  std::vector<std::size_t> kept;  // constraints that are no Casimirs of the tensor
  for (std::size_t i = 0; i < rows.rows(); ++i)
    for (std::size_t a = 0; a < vector.size(); ++a)
      if (sharps(a, i) != Quad(0)) {
        kept.push_back(i);
        break;
      }
  LU<Quad> lu(kept.size());
  const std::vector<Quad> along = rows * vector;
  std::vector<Quad> right, c(kept.size(), Quad(std::numeric_limits<double>::quiet_NaN()));
  for (std::size_t i = 0; i < kept.size(); ++i) {
    right.push_back(along[kept[i]] + (moved.empty() ? Quad(0) : moved[kept[i]]));
    for (std::size_t j = 0; j < kept.size(); ++j) lu(i, j) = w(kept[i], kept[j]);
  }
  if (kept.empty()) return vector;
  if (lu.factor()) lu.solve(right.data(), c.data());
  for (std::size_t i = 0; i < kept.size(); ++i)
    for (std::size_t a = 0; a < vector.size(); ++a) vector[a] -= sharps(a, kept[i]) * c[i];
  return vector;
}

DenseMotion::DenseMotion(const Model& model) {
  if (model.facets().has(Facet::holonomic)) {
    holonomic_ = std::make_unique<DenseConstraints>(model);
  } else if (model.nonholonomic()) {
    velocities_ = std::make_unique<DenseVelocityConstraints>(model);
  } else {
    phase_space_ = std::make_unique<PhaseSpace>(model);
  }
}

void DenseMotion::place(Quad t, const std::vector<Quad>& z) {
  state_ = z;
  if (holonomic_ != nullptr) {
    holonomic_->place(t, z);
  } else if (velocities_ != nullptr) {
    velocities_->place(t, z);
  } else {
    phase_space_->place(t, z);
  }
}

std::vector<Quad> DenseMotion::field(const FormulationStatement& statement) {
  if (velocities_ != nullptr) {
    if (statement.of_an_energy) return velocities_->vakonomic_motion();
    return statement.reactions == Reactions::ideal ? velocities_->nonholonomic_motion() : std::vector<Quad>();
  }
  if (phase_space_ != nullptr) {
    if (statement.reactions != Reactions::hamiltonian) return {};
    std::vector<Quad> rate =
        phase_space_->projected(phase_space_->pi, phase_space_->energy, phase_space_->shift);
    if (phase_space_->symmetric.empty() || statement.friction == FrictionForm::none) return rate;
    const auto friction = phase_space_->projected(phase_space_->g, phase_space_->direction, {});
    for (std::size_t a = 0; a < rate.size(); ++a) rate[a] += friction[a];
    return rate;
  }
  std::vector<Quad> rate = holonomic_->rates(statement.reactions);
  if (rate.empty() || statement.friction == FrictionForm::none) return rate;
  const auto friction = statement.friction == FrictionForm::stokes ? holonomic_->stokes_friction()
                                                                   : holonomic_->metriplectic_friction();
  for (std::size_t a = 0; a < friction.size(); ++a) rate[friction.size() + a] += friction[a];
  return rate;
}

std::vector<Quad> DenseMotion::free_field() const {
  if (phase_space_ != nullptr) return phase_space_->pi * phase_space_->energy;
  std::vector<Quad> rate = velocities_ != nullptr ? velocities_->velocities : holonomic_->velocities;
  const std::vector<Quad>& forces = velocities_ != nullptr ? velocities_->forces : holonomic_->forces;
  rate.insert(rate.end(), forces.begin(), forces.end());
  return rate;
}

std::vector<Quad> DenseMotion::energy_gradient() const {
  if (phase_space_ != nullptr) return phase_space_->energy;
  const std::vector<Quad> flow = free_field();  // (H_p, -H_q)
  const std::size_t n = flow.size() / 2;
  std::vector<Quad> gradient(flow.size());
  for (std::size_t k = 0; k < n; ++k) {
    gradient[k] = -flow[n + k];
    gradient[n + k] = flow[k];
  }
  return gradient;
}

DenseMotion::Rates DenseMotion::rates_of_velocities(const std::vector<Quad>& field,
                                                    const std::vector<Quad>& bounds) const {
  Rates rates;
  Sums sums;
  const DenseVelocityConstraints& c = *velocities_;
  const std::size_t n = c.degrees();
  // psi' = psi_t + psi_q q' + P p', where psi_t is what is left of the rate along the free field.
  for (std::size_t i = 0; i < c.count(); ++i) {
    Quad moving = c.rates[i];
    for (std::size_t a = 0; a < n; ++a) {
      moving -= c.by_position(i, a) * c.velocities[a] + c.by_momentum(i, a) * c.forces[a];
      sums.add(c.by_position(i, a), field[a], bounds[a]);
      sums.add(c.by_momentum(i, a), field[n + a], bounds[n + a]);
    }
    sums.add(moving);
    sums.end(rates.velocities);
    sums.add(c.offsets[i]);
    for (std::size_t a = 0; a < n; ++a) sums.add(c.rows(i, a), field[a], bounds[a]);
    sums.end(rates.inadmissible);
    if (i < c.holonomic()) rates.constraints = std::max(rates.constraints, rates.inadmissible);
  }
  const std::vector<Quad> gradient = energy_gradient();
  for (std::size_t a = 0; a < field.size(); ++a) sums.add(gradient[a], field[a], bounds[a]);
  sums.end(rates.energy);
  return rates;
}

DenseMotion::Rates DenseMotion::rates(const std::vector<Quad>& field, const std::vector<Quad>& bounds) const {
  if (velocities_ != nullptr) return rates_of_velocities(field, bounds);
  Rates rates;
  Sums sums;
  if (phase_space_ != nullptr) {
    for (std::size_t i = 0; i < phase_space_->rows.rows(); ++i) {
      sums.add(phase_space_->shift[i]);
      for (std::size_t a = 0; a < field.size(); ++a) sums.add(phase_space_->rows(i, a), field[a], bounds[a]);
      sums.end(rates.constraints);
    }
    for (std::size_t a = 0; a < field.size(); ++a) sums.add(phase_space_->energy[a], field[a], bounds[a]);
    sums.end(rates.energy);
    return rates;
  }
  const DenseConstraints& c = *holonomic_;
  const std::size_t n = c.degrees();
  for (std::size_t i = 0; i < c.count(); ++i) {
    // phi~ and h are these rates along the free field. What is left of them without it is phi_t and phi~_t.
    Quad moving = c.hidden[i], hidden_moving = c.hidden_rates[i];
    for (std::size_t a = 0; a < n; ++a) {
      moving -= c.by_position(i, a) * c.velocities[a];
      sums.add(c.by_position(i, a), field[a], bounds[a]);
    }
    sums.add(moving);
    // phi' = phi~ where positions move with their velocities, and phi~ is zero up to the rounding of a state.
    for (std::size_t a = 0; a < n; ++a) {
      sums.allow(c.hidden_by_position(i, a) * state_[a]);
      sums.allow(c.by_momentum(i, a) * state_[n + a]);
    }
    sums.end(rates.constraints);
    for (std::size_t a = 0; a < n; ++a) {
      hidden_moving -= c.hidden_by_position(i, a) * c.velocities[a] + c.by_momentum(i, a) * c.forces[a];
      sums.add(c.hidden_by_position(i, a), field[a], bounds[a]);
      sums.add(c.by_momentum(i, a), field[n + a], bounds[n + a]);
    }
    sums.add(hidden_moving);
    sums.end(rates.hidden);
  }
  const std::vector<Quad> gradient = energy_gradient();
  for (std::size_t a = 0; a < field.size(); ++a) sums.add(gradient[a], field[a], bounds[a]);
  sums.end(rates.energy);
  return rates;
}

}  // namespace pfaff
