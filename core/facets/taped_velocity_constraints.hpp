// The constraints A(q, t) v + b(q, t) = 0 of any canonical H(q, p, t), from tapes.
//
// Everything is derived from the formulas A, b, phi and H: psi = A v + b with v = H_p, phi's rows and values
// at the level of velocities, P = dpsi/dp and the rate {psi, H} + psi_t by differentiation onto the tape. The
// tape also tells where these matrices have entries, and from this follows the structure in which S = P A^T
// is factored. H may have any mass matrix M(q), and need not be quadratic in p.
#pragma once

#include <memory>
#include <utility>

#include <pfaff/core/facets/scalar_units.hpp>
#include <pfaff/core/facets/taped_parts.hpp>
#include <pfaff/core/facets/velocity_constraints.hpp>

namespace pfaff {

class Model;

/// The tapes that are recorded once for a system. R of LinearTapes is A; `place` goes on with psi and {psi,
/// H}
/// + psi_t.
struct VelocityTapes : LinearTapes {
  std::shared_ptr<const Tape> values;  // (q, p, t) -> psi
};

/// Records these tapes from the formulas velocity_constraints, velocity_offsets, hamiltonian and, where there
/// is one, holonomic of a model.
VelocityTapes record_velocity(const Model& model);

template <class T>
class TapedVelocityConstraints final : public TapedParts<T, VelocityConstraints<T>, VelocityTapes> {
  using Parts = TapedParts<T, VelocityConstraints<T>, VelocityTapes>;

 public:
  using Parts::count;
  using Parts::degrees;

  explicit TapedVelocityConstraints(std::shared_ptr<const VelocityTapes> tapes)
      : Parts(tapes, {}), values_(tapes->values) {}

  void values(const T& t, In<T> q, In<T> p, Out<T> psi) override { values_(t, this->join(q, p), psi.data()); }
  void by_momentum(In<T> u, Out<T> r) const override { this->times_momenta(u, r); }
  void by_momentum_transpose(In<T> x, Out<T> v) const override { this->times_momenta_transpose(x, v); }

  [[nodiscard]] std::span<const T> residuals() const override { return this->part(2 * degrees(), count()); }
  [[nodiscard]] std::span<const T> rates() const override {
    return this->part(2 * degrees() + count(), count());
  }

 private:
  Replay<T> values_;
};

/// The factory of a model's taped velocity constraints.
class TapedVelocityFactory final : public detail::MakerInUnits<TapedVelocityFactory, VelocityFactory> {
 public:
  explicit TapedVelocityFactory(VelocityTapes tapes)
      : tapes_(std::make_shared<const VelocityTapes>(std::move(tapes))) {}
  template <class T>
  [[nodiscard]] VelocityPointer<T> made() const {
    return std::make_unique<TapedVelocityConstraints<T>>(tapes_);
  }

 private:
  std::shared_ptr<const VelocityTapes> tapes_;
};

}  // namespace pfaff
