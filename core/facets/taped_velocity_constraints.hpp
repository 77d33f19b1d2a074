// The constraints A(q, t) v + b(q, t) = 0 of any canonical H(q, p, t), from tapes.
//
// Everything is derived from the formulas A, b, phi and H: psi = A v + b with v = H_p, phi's rows and values
// at the level of velocities, P = dpsi/dp and the rate {psi, H} + psi_t by differentiation onto the tape. The
// tape also tells where these matrices have entries, and from this follows the structure in which S = P A^T
// is factored. H may have any mass matrix M(q), and need not be quadratic in p.
#pragma once

#include <vector>

#include <pfaff/core/facets/sparse_tape.hpp>
#include <pfaff/core/facets/velocity_constraints.hpp>
#include <pfaff/core/linear/structured_ldlt.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

class Model;

/// The tapes that are recorded once for a system, and the structure of the matrices on them.
struct VelocityTapes {
  std::size_t count = 0, degrees = 0;
  std::shared_ptr<const Tape> values;    // (q, p, t) -> psi
  std::shared_ptr<const Tape> gradient;  // (q, p, t) -> (H_q, H_p)
  std::shared_ptr<const Tape> linear;    // (q, p, t) -> A, P, S: entries, diagonal, couplings
  std::shared_ptr<const Tape> place;     // -> those, H_p, -H_q, psi, {psi, H} + psi_t
  SparseRows rows, by_momentum;          // A, P
  std::shared_ptr<const SymmetricPattern> pattern;
};

/// Records these tapes from the formulas velocity_constraints, velocity_offsets, hamiltonian and, where there
/// is one, holonomic of a model.
VelocityTapes record_velocity(const Model& model);

template <class T>
class TapedVelocityConstraints final : public VelocityConstraints<T> {
 public:
  explicit TapedVelocityConstraints(std::shared_ptr<const VelocityTapes> tapes)
      : tapes_(std::move(tapes)),
        values_(tapes_->values),
        gradient_(tapes_->gradient),
        linear_(tapes_->linear),
        place_(tapes_->place),
        state_(2 * tapes_->degrees),
        slopes_(2 * tapes_->degrees),
        placed_(tapes_->place->outputs.size()),
        ldlt_(tapes_->pattern) {}

  [[nodiscard]] std::size_t count() const override { return tapes_->count; }
  [[nodiscard]] std::size_t degrees() const override { return tapes_->degrees; }
  [[nodiscard]] const SymmetricPattern& pattern() const override { return *tapes_->pattern; }

  void values(const T& t, In<T> q, In<T> p, Out<T> psi) override {
    join(q, p);
    values_(t, state_.data(), psi.data());
  }
  void velocity(const T& t, In<T> q, In<T> p, Out<T> v) override {
    slopes(t, q, p);
    for (std::size_t k = 0; k < degrees(); ++k) v[k] = slopes_[degrees() + k];
  }
  void force(const T& t, In<T> q, In<T> p, Out<T> f) override {
    slopes(t, q, p);
    for (std::size_t k = 0; k < degrees(); ++k) f[k] = -slopes_[k];
  }

  Status linearise(const T& t, In<T> q, In<T> p) override {
    join(q, p);
    linear_(t, state_.data(), placed_.data());
    return factor();
  }
  void apply(In<T> u, Out<T> r) const override { tapes_->rows.multiply<T>(placed_.data(), u, r); }
  void apply_transpose(In<T> x, Out<T> f) const override {
    tapes_->rows.multiply_transpose<T>(placed_.data(), x, f);
  }
  void solve(In<T> r, Out<T> x) const override { ldlt_.solve(r.data(), x.data()); }
  void by_momentum(In<T> u, Out<T> r) const override {
    tapes_->by_momentum.multiply<T>(placed_.data() + momentum_begin(), u, r);
  }
  void by_momentum_transpose(In<T> x, Out<T> v) const override {
    tapes_->by_momentum.multiply_transpose<T>(placed_.data() + momentum_begin(), x, v);
  }

  Status place(const T& t, In<T> q, In<T> p) override {
    join(q, p);
    place_(t, state_.data(), placed_.data());
    return factor();
  }
  [[nodiscard]] std::span<const T> velocities() const override { return part(0, degrees()); }
  [[nodiscard]] std::span<const T> forces() const override { return part(degrees(), degrees()); }
  [[nodiscard]] std::span<const T> residuals() const override { return part(2 * degrees(), count()); }
  [[nodiscard]] std::span<const T> rates() const override { return part(2 * degrees() + count(), count()); }

 private:
  // Outputs of `linear` come first in those of `place`: A, P, the diagonal and the couplings of S.
  [[nodiscard]] std::size_t momentum_begin() const { return tapes_->rows.columns.size(); }
  [[nodiscard]] std::size_t pattern_begin() const {
    return momentum_begin() + tapes_->by_momentum.columns.size();
  }
  [[nodiscard]] std::span<const T> part(std::size_t offset, std::size_t size) const {
    const std::size_t begin = pattern_begin() + count() + tapes_->pattern->couplings().size();
    return std::span<const T>(placed_).subspan(begin + offset, size);
  }

  void join(In<T> q, In<T> p) {
    for (std::size_t k = 0; k < degrees(); ++k) {
      state_[k] = q[k];
      state_[degrees() + k] = p[k];
    }
  }
  void slopes(const T& t, In<T> q, In<T> p) {
    join(q, p);
    gradient_(t, state_.data(), slopes_.data());
  }
  Status factor() {
    const T* entries = placed_.data() + pattern_begin();
    for (std::size_t k = 0; k < count(); ++k) ldlt_.diagonal()[k] = entries[k];
    for (std::size_t c = 0; c < tapes_->pattern->couplings().size(); ++c)
      ldlt_.couplings()[c] = entries[count() + c];
    return ldlt_.factor();
  }

  std::shared_ptr<const VelocityTapes> tapes_;
  Replay<T> values_, gradient_, linear_, place_;
  std::vector<T> state_, slopes_, placed_;
  StructuredLDLT<T> ldlt_;
};

/// The factory of a model's taped velocity constraints.
class TapedVelocityFactory final : public MakerOf<TapedVelocityFactory, VelocityFactory> {
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
