#include <pfaff/papers/pitanga_rodrigues/engine_point.hpp>

#include <pfaff/core/formulation.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff::pitanga_rodrigues {

namespace {

Numbers replayed(const std::shared_ptr<const Tape>& tape, const Quad& t, const Numbers& x) {
  Numbers out(tape->outputs.size());
  Replay<Quad> replay(tape);
  replay(t, x.data(), out.data());
  return out;
}

}  // namespace

std::shared_ptr<const Model> sleigh_model() {
  return systems().get("sleigh", "system").make({{"mass", "1"}, {"inertia", "2"}, {"offset", "0.75"}});
}
std::shared_ptr<const Model> contact_model() { return systems().get("contact-particle", "system").make({}); }

EnginePoint::EnginePoint(std::shared_ptr<const Model> model, const Quad& t, const Numbers& z)
    : model_(std::move(model)), t_(t), bracket_(*model_), state_(bracket_.projected(t, z)) {
  const auto moving = formulations().get("nonholonomic", "formulation").apply(model_, {});
  rate_ = replayed(moving->tape(Formula::field), t_, state_);
  energy_slopes_ = replayed(model_->tape(Formula::hamiltonian_gradient), t_, state_);
  acceleration_ = second_half(slopes_along(rate_, Quad(1)));
}

Quad EnginePoint::energy() const { return replayed(model_->tape(Formula::hamiltonian), t_, state_).front(); }
Numbers EnginePoint::constraints(const Numbers& z) const {
  return replayed(model_->tape(Formula::constraints), t_, z);
}

Numbers EnginePoint::slopes_along(const Numbers& rate, const Quad& time_rate) const {
  using D = Dual<Quad, 1>;
  std::vector<D> moving(state_.begin(), state_.end()), out(state_.size());
  for (std::size_t k = 0; k < moving.size(); ++k) moving[k].derivative[0] = rate[k];
  D time(t_);
  time.derivative[0] = time_rate;
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
    const Numbers column = slopes_along(unit, Quad(0));
    for (std::size_t i = 0; i < n; ++i) second(i, j) = column[n + i];
  }
  return inverse(second);
}

}  // namespace pfaff::pitanga_rodrigues
