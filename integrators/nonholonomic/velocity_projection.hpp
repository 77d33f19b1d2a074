// What projection of a method's steps onto constraints psi(q, p, t) = A v + b = 0 of velocities v = H_p
// shifts, where a formulation has made a vector field of the system: momenta along A^T, so that in the metric
// of the masses they move as little as can be. Positions are free. The forms of projection are those of
// integrators/constrained/projection.hpp.
#pragma once

#include <memory>
#include <vector>

#include <pfaff/integrators/constrained/projection.hpp>

namespace pfaff {

/// The shift for constraints of velocities: of momenta.
template <class T>
class VelocityShift {
 public:
  using Constraints = VelocityConstraints<T>;
  template <class P>
  static constexpr bool fits = HasVelocityConstraints<P>;
  static constexpr bool moves_positions = false;

  template <class P>
  static Constraints& of(const P& p) {
    return p.nonholonomic();
  }
  static std::unique_ptr<Constraints> made(const Model& model) {
    return model.template velocity_constraints<T>();
  }
  explicit VelocityShift(const Constraints& c)
      : multiplier_(c.count()), residual_(c.count()), kick_(c.degrees()) {}

  /// Adds A^T x to the momenta of a state, with A of the point where the constraints `at` were placed.
  void apply(const Constraints& at, auto& state) {
    at.apply_transpose(multiplier_, kick_);
    for (std::size_t k = 0; k < kick_.size(); ++k)
      state[kick_.size() + k] = state[kick_.size() + k] + kick_[k];
  }
  /// Corrects the multipliers by what the constraints lack at (q, p). They act at both ends of the step, so
  /// that half the correction at each is enough. `kick` is what is to be taken from p.
  void correct(Constraints& c, const T& t, In<T> q, In<T> p, const CoordinateConvergence<T>& convergence) {
    c.values(t, q, p, residual_);
    c.solve(residual_, residual_);
    convergence.kick(residual_);
    for (std::size_t i = 0; i < residual_.size(); ++i) multiplier_[i] = multiplier_[i] - residual_[i] / T(2);
    c.apply_transpose(residual_, kick_);
  }
  [[nodiscard]] const T& kick(std::size_t k) const { return kick_[k]; }
  void forget() {
    for (T& x : multiplier_) x = T(0);
  }

 private:
  std::vector<T> multiplier_, residual_, kick_;
};

}  // namespace pfaff
