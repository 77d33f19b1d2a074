// The engine's side of section 4: a system with velocity constraints at one constrained state.
#pragma once

#include <memory>

#include <pfaff/brackets/nonholonomic/nonholonomic_bracket.hpp>
#include <pfaff/papers/rows.hpp>

namespace pfaff::pitanga_rodrigues {

/// The examples of the paper: the sleigh with J and r, and the particle with w = dz - y dx.
std::shared_ptr<const Model> sleigh_model();
std::shared_ptr<const Model> contact_model();
inline const Quad sleigh_inertia = Quad(2), sleigh_distance = Quad(3) / Quad(4);

class EnginePoint {
 public:
  /// At the state whose momenta are those of z, projected onto the constraints.
  EnginePoint(std::shared_ptr<const Model> model, const Quad& t, const Numbers& z);

  [[nodiscard]] const Numbers& state() const { return state_; }
  [[nodiscard]] Numbers q() const { return first_half(state_); }
  [[nodiscard]] Numbers p() const { return second_half(state_); }
  /// (q', p') in the formulation `nonholonomic`, and q'' that follows.
  [[nodiscard]] const Numbers& rate() const { return rate_; }
  [[nodiscard]] Numbers velocity() const { return first_half(rate_); }
  [[nodiscard]] const Numbers& acceleration() const { return acceleration_; }
  [[nodiscard]] Numbers energy_slopes() const { return energy_slopes_; }
  [[nodiscard]] Quad energy() const;
  /// psi at this state, or at any other.
  [[nodiscard]] Numbers constraints() const { return constraints(state_); }
  [[nodiscard]] Numbers constraints(const Numbers& z) const;
  [[nodiscard]] AlmostProduct<Quad> projectors() const { return bracket_.projectors(t_, q()); }
  [[nodiscard]] Matrix<Quad> tensor() const { return bracket_.tensor(t_, state_); }
  [[nodiscard]] NonholonomicPoint<Quad> point() const { return nonholonomic_point(*model_, t_, state_); }
  /// The inverse of H_pp, the metric of the kinetic energy.
  [[nodiscard]] Matrix<Quad> metric() const;

  static Numbers first_half(const Numbers& z) {
    return {z.begin(), z.begin() + static_cast<std::ptrdiff_t>(z.size() / 2)};
  }
  static Numbers second_half(const Numbers& z) {
    return {z.begin() + static_cast<std::ptrdiff_t>(z.size() / 2), z.end()};
  }

 private:
  // The derivatives of H_q and H_p along a motion of the state and of time.
  [[nodiscard]] Numbers slopes_along(const Numbers& rate, const Quad& time_rate) const;

  std::shared_ptr<const Model> model_;
  Quad t_;
  NonholonomicBracket bracket_;
  Numbers state_, rate_, energy_slopes_, acceleration_;
};

}  // namespace pfaff::pitanga_rodrigues
