#include <pfaff/bench/reproduce/nguyen_turski/constrained_point.hpp>

#include <pfaff/core/facets/problem.hpp>

namespace pfaff::nguyen_turski {

ConstrainedPoint::ConstrainedPoint(const std::string& system, const Assignments& set, const Quad& off)
    : model_(systems().get(system, "system").make(set)),
      constraints_(model_->holonomic_constraints<Quad>()),
      n_(constraints_->degrees()),
      count_(constraints_->count()),
      axes_(2),
      gradient_(count_, n_),
      momentum_gradient_(count_, n_),
      position_gradient_(count_, n_) {
  for (const auto& [key, value] : model_->parameters())
    if (key == "dimension") axes_ = value == "3" ? 3 : 2;
  if (system == "humanoid") axes_ = 3;
  for (std::size_t k = 0; k < 2 * n_; ++k) {
    const Quad moved = model_->initial()[k].quad() + off * sin(Quad(static_cast<int>(3 * k + 1)));
    (k < n_ ? q_ : p_).push_back(moved);
  }
  const Quad t(0);
  velocity_.resize(n_);
  force_.resize(n_);
  residuals_.resize(count_);
  hidden_.resize(count_);
  constraints_->velocity(t, q_, p_, velocity_);
  constraints_->force(t, q_, p_, force_);
  constraints_->values(t, q_, residuals_);
  constraints_->hidden_values(t, q_, p_, hidden_);
  Numbers unit(n_), row(n_);
  for (std::size_t k = 0; k < n_; ++k) {
    unit.assign(n_, Quad(0));
    unit[k] = Quad(1);
    constraints_->velocity(t, q_, unit, row);
    inverse_mass_.push_back(row[k]);
  }
  (void)constraints_->place(t, q_, p_);
  friction_.assign(constraints_->friction().begin(), constraints_->friction().end());
  friction_.resize(n_, Quad(0));
  unit.assign(count_, Quad(0));
  for (std::size_t i = 0; i < count_; ++i) {
    unit[i] = Quad(1);
    const auto put = [&](Matrix<Quad>& m) {
      for (std::size_t k = 0; k < n_; ++k) m(i, k) = row[k];
    };
    constraints_->apply_transpose(unit, row);
    put(gradient_);
    constraints_->hidden_by_position_transpose(unit, row);
    put(position_gradient_);
    unit[i] = Quad(0);
  }
  // P = B M^-1, from the masses and not from what formulations use.
  for (std::size_t i = 0; i < count_; ++i)
    for (std::size_t k = 0; k < n_; ++k) momentum_gradient_(i, k) = gradient_(i, k) * inverse_mass_[k];
}

Quad ConstrainedPoint::energy() const {
  Numbers z = q_, values(model_->invariants().size());
  z.insert(z.end(), p_.begin(), p_.end());
  Problem<Quad>(model_).invariants(Quad(0), z, values);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (model_->invariants()[i].name == "energy") return values[i];
  return Quad(std::numeric_limits<double>::quiet_NaN());
}
Quad ConstrainedPoint::mass(std::size_t bead) const { return 1 / inverse_mass_[bead * axes_]; }
Quad ConstrainedPoint::friction(std::size_t bead) const { return friction_[bead * axes_]; }

Matrix<Quad> ConstrainedPoint::a() const {
  const Matrix<Quad> half = position_gradient_ * momentum_gradient_.transposed();
  return half - half.transposed();
}
Matrix<Quad> ConstrainedPoint::w() const {
  const Matrix<Quad> symmetric = s(), skew = a();
  Matrix<Quad> m(2 * count_, 2 * count_);
  for (std::size_t i = 0; i < count_; ++i)
    for (std::size_t j = 0; j < count_; ++j) {
      m(i, count_ + j) = symmetric(i, j);
      m(count_ + i, j) = -symmetric(j, i);
      m(count_ + i, count_ + j) = skew(i, j);
    }
  return m;
}
Matrix<Quad> ConstrainedPoint::s_friction() const {
  Matrix<Quad> weighted = momentum_gradient_;
  for (std::size_t i = 0; i < count_; ++i)
    for (std::size_t k = 0; k < n_; ++k) weighted(i, k) = weighted(i, k) * friction_[k];
  return weighted * momentum_gradient_.transposed();
}

Numbers ConstrainedPoint::rates(const std::string& formulation, const std::string& form) const {
  Assignments set;
  if (!form.empty()) set.emplace_back("friction-form", form);
  const Problem<Quad> problem(formulations().get(formulation, "formulation").apply(model_, set));
  Numbers z = q_, rate(2 * n_);
  z.insert(z.end(), p_.begin(), p_.end());
  problem.field(Quad(0), z, rate);
  return rate;
}

Numbers ConstrainedPoint::rates_by_definition() const {
  // {phi_j, H}: phi~ for the first level, T v + P f for the second.
  Numbers with_energy = hidden_;
  for (std::size_t i = 0; i < count_; ++i) {
    Quad sum(0);
    for (std::size_t k = 0; k < n_; ++k)
      sum += position_gradient_(i, k) * velocity_[k] + momentum_gradient_(i, k) * force_[k];
    with_energy.push_back(sum);
  }
  const Matrix<Quad> c = inverse(w());
  Numbers rate = velocity_;
  rate.insert(rate.end(), force_.begin(), force_.end());
  for (std::size_t i = 0; i < 2 * count_; ++i) {
    Quad x(0);
    for (std::size_t j = 0; j < 2 * count_; ++j) x += c(i, j) * with_energy[j];
    for (std::size_t k = 0; k < n_; ++k) {
      // {q, phi} = dphi/dp and {p, phi} = -dphi/dq.
      if (i < count_) {
        rate[n_ + k] += gradient_(i, k) * x;
      } else {
        rate[k] -= momentum_gradient_(i - count_, k) * x;
        rate[n_ + k] += position_gradient_(i - count_, k) * x;
      }
    }
  }
  return rate;
}

Numbers ConstrainedPoint::rates_with_multipliers() const {
  const Matrix<Quad> inverted = inverse(s());
  Numbers rate = velocity_;
  rate.insert(rate.end(), force_.begin(), force_.end());
  for (std::size_t i = 0; i < count_; ++i) {
    Quad multiplier(0);
    for (std::size_t j = 0; j < count_; ++j)
      for (std::size_t k = 0; k < n_; ++k)
        multiplier +=
            inverted(i, j) * (position_gradient_(j, k) * velocity_[k] + momentum_gradient_(j, k) * force_[k]);
    for (std::size_t k = 0; k < n_; ++k) rate[n_ + k] -= gradient_(i, k) * multiplier;
  }
  return rate;
}

double ConstrainedPoint::energy_rate(const std::string& formulation, const std::string& form) const {
  const Numbers rate = rates(formulation, form);
  Quad sum(0);
  for (std::size_t k = 0; k < n_; ++k) sum += -force_[k] * rate[k] + velocity_[k] * rate[n_ + k];
  return static_cast<double>(sum);
}

Matrix<Quad> ConstrainedPoint::gradient_at(const Numbers& q) const {
  (void)constraints_->linearise(Quad(0), q, p_);
  Matrix<Quad> gradient(count_, n_);
  Numbers unit(count_), row(n_);
  for (std::size_t i = 0; i < count_; ++i) {
    unit.assign(count_, Quad(0));
    unit[i] = Quad(1);
    constraints_->apply_transpose(unit, row);
    for (std::size_t k = 0; k < n_; ++k) gradient(i, k) = row[k];
  }
  return gradient;
}

Quad ConstrainedPoint::half_log_determinant(std::size_t k, const Quad& by) const {
  Numbers q = q_;
  q[k] += by;
  const Matrix<Quad> gradient = gradient_at(q);
  Matrix<Quad> weighted = gradient;
  for (std::size_t i = 0; i < count_; ++i)
    for (std::size_t x = 0; x < n_; ++x) weighted(i, x) = weighted(i, x) * inverse_mass_[x];
  return log(determinant(weighted * gradient.transposed())) / 2;
}

Numbers ConstrainedPoint::half_log_gradient() const {
  const Matrix<Quad> inverted = inverse(s());
  Numbers result;
  for (std::size_t a = 0; a < n_; ++a) {
    // Constraints of rods are quadratic: their gradients change by a whole step exactly as by a small one.
    Numbers q = q_;
    q[a] += Quad(1);
    const Matrix<Quad> change = gradient_at(q) - gradient_;
    const Matrix<Quad> half = change * momentum_gradient_.transposed();
    Quad trace(0);
    for (std::size_t i = 0; i < count_; ++i)
      for (std::size_t j = 0; j < count_; ++j) trace += inverted(i, j) * half(j, i);
    result.push_back(trace);
  }
  return result;
}

}  // namespace pfaff::nguyen_turski
