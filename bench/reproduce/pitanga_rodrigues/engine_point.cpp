#include <pfaff/bench/reproduce/pitanga_rodrigues/engine_point.hpp>

#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff::pitanga_rodrigues {

namespace {

const SystemDescriptor descriptor{.name = "example", .title = "", .reference = ""};

struct Sleigh {
  static constexpr int dimension = 6, velocity_constraint_count = 1;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2] / 2) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> /*q*/) const {
    return T(0);
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = -sin(q[2]);
    rows[1] = cos(q[2]);
    rows[2] = -T(3) / T(4);
  }
};

struct ContactParticle {
  static constexpr int dimension = 6, velocity_constraint_count = 1;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> /*q*/) const {
    return T(0);
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = -q[1];
    rows[1] = T(0);
    rows[2] = T(1);
  }
};

Numbers replayed(const std::shared_ptr<const Tape>& tape, const Quad& t, const Numbers& x) {
  Numbers out(tape->outputs.size());
  Replay<Quad> replay(tape);
  replay(t, x.data(), out.data());
  return out;
}

}  // namespace

std::shared_ptr<const Model> sleigh_model() { return make_model(descriptor, Sleigh{}); }
std::shared_ptr<const Model> contact_model() { return make_model(descriptor, ContactParticle{}); }

EnginePoint::EnginePoint(std::shared_ptr<const Model> model, const Quad& t, const Numbers& z)
    : model_(std::move(model)), t_(t), bracket_(*model_), state_(bracket_.projected(t, z)) {
  const std::size_t n = bracket_.degrees();
  const auto constraints = model_->velocity_constraints<Quad>();
  const In<Quad> all(state_);
  if (constraints->place(t_, all.first(n), all.subspan(n)) != Status::converged)
    throw RunError("pitanga-rodrigues: the constraints of a sample are singular");
  Numbers multipliers(constraints->count()), reaction(n);
  constraints->solve(constraints->rates(), multipliers);
  constraints->apply_transpose(multipliers, reaction);
  velocity_.assign(constraints->velocities().begin(), constraints->velocities().end());
  for (std::size_t k = 0; k < n; ++k) momentum_rate_.push_back(constraints->forces()[k] - reaction[k]);
  energy_slopes_ = replayed(model_->tape(Formula::hamiltonian_gradient), t_, state_);
  acceleration_ = second_half(slopes_along(rate()));
}

Numbers EnginePoint::rate() const {
  Numbers all = velocity_;
  all.insert(all.end(), momentum_rate_.begin(), momentum_rate_.end());
  return all;
}
Quad EnginePoint::energy() const { return replayed(model_->tape(Formula::hamiltonian), t_, state_).front(); }
Numbers EnginePoint::constraints(const Numbers& z) const {
  return replayed(model_->tape(Formula::constraints), t_, z);
}

Numbers EnginePoint::slopes_along(const Numbers& rate) const {
  using D = Dual<Quad, 1>;
  std::vector<D> moving(state_.begin(), state_.end()), out(state_.size());
  for (std::size_t k = 0; k < moving.size(); ++k) moving[k].derivative[0] = rate[k];
  D time(t_);
  time.derivative[0] = Quad(1);
  Replay<D> replay(model_->tape(Formula::hamiltonian_gradient));
  replay(time, moving.data(), out.data());
  Numbers slopes;
  for (const D& x : out) slopes.push_back(x.derivative[0]);
  return slopes;
}

Matrix<Quad> EnginePoint::metric() const {
  const std::size_t n = state_.size() / 2;
  Matrix<Quad> second(n, n);
  for (std::size_t j = 0; j < n; ++j) {
    Numbers unit(2 * n);
    unit[n + j] = Quad(1);
    const Numbers column = slopes_along(unit);
    for (std::size_t i = 0; i < n; ++i) second(i, j) = column[n + i];
  }
  return inverse(second);
}

}  // namespace pfaff::pitanga_rodrigues
