#include <pfaff/papers/nguyen_turski/bead_rod_point.hpp>

#include <pfaff/bench/evaluation/evaluation.hpp>
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/systems/bead_rod/system.hpp>

namespace pfaff::nguyen_turski {

std::shared_ptr<const Model> bead_rod_model(const BeadRodDescription& description) {
  return pfaff::bead_rod_model(
      {.name = "bead-rod", .title = "beads on rods", .reference = "nguyen-turski section 4"}, description);
}

BeadRodPoint::BeadRodPoint(std::shared_ptr<const Model> model, Numbers z)
    : model_(std::move(model)),
      constraints_(model_->holonomic_constraints<Quad>()),
      z_(std::move(z)),
      brackets_(constraint_brackets(*model_, Quad(0), z_)) {
  (void)constraints_->place(Quad(0), q(), p());
  if (!constraints_->friction().empty()) (void)constraints_->factor_friction();
}

Numbers BeadRodPoint::q() const {
  return {z_.begin(), z_.begin() + static_cast<std::ptrdiff_t>(z_.size() / 2)};
}
Numbers BeadRodPoint::p() const {
  return {z_.begin() + static_cast<std::ptrdiff_t>(z_.size() / 2), z_.end()};
}
Numbers BeadRodPoint::constraints() const {
  return {constraints_->residuals().begin(), constraints_->residuals().end()};
}
Numbers BeadRodPoint::hidden_constraints() const {
  return {constraints_->hidden().begin(), constraints_->hidden().end()};
}
Numbers BeadRodPoint::hidden_rates() const {
  return {constraints_->hidden_rates().begin(), constraints_->hidden_rates().end()};
}
Numbers BeadRodPoint::force() const { return {constraints_->forces().begin(), constraints_->forces().end()}; }
Numbers BeadRodPoint::friction() const {
  return {constraints_->friction().begin(), constraints_->friction().end()};
}

Matrix<Quad> BeadRodPoint::s() const {
  const std::size_t count = constraints_->count();
  Matrix<Quad> m(count, count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j) m(i, j) = brackets_.brackets(2 * i, 2 * j + 1);
  return m;
}
Matrix<Quad> BeadRodPoint::a() const {
  const std::size_t count = constraints_->count();
  Matrix<Quad> m(count, count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j) m(i, j) = brackets_.brackets(2 * i + 1, 2 * j + 1);
  return m;
}
Matrix<Quad> BeadRodPoint::w() const {
  const std::size_t count = constraints_->count();
  Matrix<Quad> m(2 * count, 2 * count);
  for (std::size_t i = 0; i < 2 * count; ++i)
    for (std::size_t j = 0; j < 2 * count; ++j)
      m(i, j) = brackets_.brackets(2 * (i % count) + i / count, 2 * (j % count) + j / count);
  return m;
}

Matrix<Quad> BeadRodPoint::s_inverse() const {
  const std::size_t count = constraints_->count();
  Matrix<Quad> m(count, count);
  for (std::size_t j = 0; j < count; ++j) {
    Numbers unit(count), column(count);
    unit[j] = Quad(1);
    constraints_->solve(unit, column);
    for (std::size_t i = 0; i < count; ++i) m(i, j) = column[i];
  }
  return m;
}
Matrix<Quad> BeadRodPoint::s_friction_inverse() const {
  const std::size_t count = constraints_->count();
  Matrix<Quad> m(count, count);
  for (std::size_t j = 0; j < count; ++j) {
    Numbers unit(count), column(count);
    unit[j] = Quad(1);
    constraints_->solve_friction(unit, column);
    for (std::size_t i = 0; i < count; ++i) m(i, j) = column[i];
  }
  return m;
}
Numbers BeadRodPoint::hidden_by_momentum(const Numbers& u) const {
  Numbers result(constraints_->count());
  constraints_->hidden_by_momentum(u, result);
  return result;
}

std::shared_ptr<const Model> BeadRodPoint::moving(const std::string& formulation,
                                                  const std::string& friction) const {
  return formulations().get(formulation, "formulation").apply(model_, {{"friction-form", friction}});
}
Numbers BeadRodPoint::rates(const std::string& formulation, const std::string& friction) const {
  const Problem<Quad> problem(moving(formulation, friction));
  Numbers rate(z_.size());
  problem.field(Quad(0), z_, rate);
  return rate;
}
Numbers BeadRodPoint::multipliers() const {
  EvaluationSettings settings;
  settings.at.model = moving("lmm", "none");
  for (const Quad& x : z_) settings.at.state.emplace_back(x);
  settings.at.t = Real(0);
  settings.precision = Precision::quad;
  const nlohmann::json shown = evaluation(settings);
  Numbers lambda;
  for (const auto& text : shown["multipliers"]) {
    Quad number;
    if (!parse(text.get<std::string>(), number)) return {};
    lambda.push_back(number);
  }
  return lambda;
}

Quad BeadRodPoint::energy() const {
  Numbers value(1);
  Replay<Quad>(model_->tape(Formula::hamiltonian))(Quad(0), z_.data(), value.data());
  return value.front();
}
Quad BeadRodPoint::energy_rate(const std::string& formulation, const std::string& friction) const {
  const Numbers rate = rates(formulation, friction);
  Numbers slope(z_.size());
  Replay<Quad>(model_->tape(Formula::hamiltonian_gradient))(Quad(0), z_.data(), slope.data());
  Quad sum(0);
  for (std::size_t k = 0; k < rate.size(); ++k) sum += slope[k] * rate[k];
  return sum;
}

}  // namespace pfaff::nguyen_turski
