// The constraints phi(q, t) = 0 of any canonical H(q, p, t), from tapes.
//
// Everything is derived from the formulas phi and H: phi~ = {phi, H} + phi_t, its rate, and B, P, T by
// differentiation onto the tape. The tape also tells where these matrices have entries, and from this follows
// the structure in which S = B H_pp B^T is factored.
// H may have any mass matrix M(q), and need not be quadratic in p.
#pragma once

#include <algorithm>
#include <vector>

#include <pfaff/core/facets/holonomic.hpp>
#include <pfaff/core/facets/sparse_tape.hpp>
#include <pfaff/core/linear/structured_ldlt.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

class Model;

/// The formulas that everything else follows from. Beside coordinates they may have parameters, as the last
/// inputs of every tape, by which nothing is differentiated.
struct HolonomicFormulas {
  std::size_t degrees = 0, parameters = 0;
  std::shared_ptr<const Tape> values;    // (q, t) -> phi
  std::shared_ptr<const Tape> gradient;  // (q, p, t) -> (H_q, H_p)
  std::shared_ptr<const Tape> friction;  // (q, p, t) -> lambda; null where there is none
};

/// The tapes that are recorded once for a system, and the structure of the matrices on them.
struct HolonomicTapes {
  std::size_t count = 0, degrees = 0, parameters = 0;
  std::shared_ptr<const Tape> values;    // (q, t) -> phi
  std::shared_ptr<const Tape> hidden;    // (q, p, t) -> phi~
  std::shared_ptr<const Tape> gradient;  // (q, p, t) -> (H_q, H_p)
  std::shared_ptr<const Tape> linear;    // (q, p, t) -> B, P, S: entries, diagonal, couplings
  std::shared_ptr<const Tape> place;     // -> those, H_p, -H_q, phi, phi~, h, T, lambda, S^D
  SparseRows by_position, by_momentum, hidden_by_position;  // B, P, T
  std::shared_ptr<const SymmetricPattern> pattern, friction_pattern;
  bool friction = false;
};

/// Records these tapes. The time is linear in the size of the formulas.
HolonomicTapes record_holonomic(const HolonomicFormulas& formulas);
/// The same from the formulas holonomic, hamiltonian and, where there is one, friction of a model.
HolonomicTapes record_holonomic(const Model& model);

template <class T>
class TapedConstraints : public HolonomicConstraints<T> {
 public:
  /// `parameters` are the values of the parameters of the formulas.
  explicit TapedConstraints(std::shared_ptr<const HolonomicTapes> tapes,
                            const std::vector<T>& parameters = {})
      : tapes_(std::move(tapes)),
        values_(tapes_->values),
        hidden_(tapes_->hidden),
        gradient_(tapes_->gradient),
        linear_(tapes_->linear),
        place_(tapes_->place),
        position_(tapes_->degrees + parameters.size()),
        state_(2 * tapes_->degrees + parameters.size()),
        slopes_(2 * tapes_->degrees),
        placed_(tapes_->place->outputs.size()),
        ldlt_(tapes_->pattern),
        friction_ldlt_(tapes_->friction_pattern) {
    std::copy(parameters.begin(), parameters.end(), position_.end() - parameters_size(parameters));
    std::copy(parameters.begin(), parameters.end(), state_.end() - parameters_size(parameters));
  }

  [[nodiscard]] std::size_t count() const override { return tapes_->count; }
  [[nodiscard]] std::size_t degrees() const override { return tapes_->degrees; }
  [[nodiscard]] const SymmetricPattern& pattern() const override { return *tapes_->pattern; }

  void values(const T& t, In<T> q, Out<T> phi) override {
    std::copy(q.begin(), q.end(), position_.begin());
    values_(t, position_.data(), phi.data());
  }
  void hidden_values(const T& t, In<T> q, In<T> p, Out<T> hidden) override {
    join(q, p);
    hidden_(t, state_.data(), hidden.data());
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
  void apply(In<T> u, Out<T> r) const override { tapes_->by_position.multiply<T>(placed_.data(), u, r); }
  void apply_transpose(In<T> x, Out<T> f) const override {
    tapes_->by_position.multiply_transpose<T>(placed_.data(), x, f);
  }
  void solve(In<T> r, Out<T> x) const override { ldlt_.solve(r.data(), x.data()); }
  void solve(In<T> r1, Out<T> x1, In<T> r2, Out<T> x2) const override {
    ldlt_.solve(r1.data(), x1.data(), r2.data(), x2.data());
  }
  void hidden_by_momentum(In<T> u, Out<T> r) const override {
    tapes_->by_momentum.multiply<T>(placed_.data() + momentum_begin(), u, r);
  }
  void hidden_by_momentum_transpose(In<T> x, Out<T> v) const override {
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
  [[nodiscard]] std::span<const T> hidden() const override { return part(2 * degrees() + count(), count()); }
  [[nodiscard]] std::span<const T> hidden_rates() const override {
    return part(2 * degrees() + 2 * count(), count());
  }
  void hidden_by_position(In<T> u, Out<T> r) const override {
    tapes_->hidden_by_position.multiply<T>(placed_.data() + hidden_begin(), u, r);
  }
  void hidden_by_position_transpose(In<T> x, Out<T> f) const override {
    tapes_->hidden_by_position.multiply_transpose<T>(placed_.data() + hidden_begin(), x, f);
  }

  [[nodiscard]] std::span<const T> friction() const override {
    return part(friction_begin() - placed_begin(), tapes_->friction ? degrees() : 0);
  }
  Status factor_friction() override {
    const std::size_t begin = friction_begin() + degrees();
    for (std::size_t k = 0; k < count(); ++k) friction_ldlt_.diagonal()[k] = placed_[begin + k];
    for (std::size_t c = 0; c < tapes_->friction_pattern->couplings().size(); ++c)
      friction_ldlt_.couplings()[c] = placed_[begin + count() + c];
    return friction_ldlt_.factor_semidefinite();
  }
  void solve_friction(In<T> r, Out<T> x) const override { friction_ldlt_.solve(r.data(), x.data()); }

 protected:
  /// S as last placed: its diagonal, and its couplings in the order of the pattern's.
  [[nodiscard]] std::span<const T> diagonal() const {
    return std::span<const T>(placed_).subspan(pattern_begin(), count());
  }
  [[nodiscard]] std::span<const T> couplings() const {
    return std::span<const T>(placed_).subspan(pattern_begin() + count(),
                                               tapes_->pattern->couplings().size());
  }

 private:
  static std::ptrdiff_t parameters_size(const std::vector<T>& parameters) {
    return static_cast<std::ptrdiff_t>(parameters.size());
  }
  // Outputs of `linear` come first in those of `place`: B, P, the diagonal and the couplings of S.
  [[nodiscard]] std::size_t momentum_begin() const { return tapes_->by_position.columns.size(); }
  [[nodiscard]] std::size_t pattern_begin() const {
    return momentum_begin() + tapes_->by_momentum.columns.size();
  }
  [[nodiscard]] std::size_t placed_begin() const {
    return pattern_begin() + count() + tapes_->pattern->couplings().size();
  }
  [[nodiscard]] std::size_t hidden_begin() const { return placed_begin() + 2 * degrees() + 3 * count(); }
  [[nodiscard]] std::size_t friction_begin() const {
    return hidden_begin() + tapes_->hidden_by_position.columns.size();
  }
  [[nodiscard]] std::span<const T> part(std::size_t offset, std::size_t size) const {
    return std::span<const T>(placed_).subspan(placed_begin() + offset, size);
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
  std::shared_ptr<const HolonomicTapes> tapes_;
  Replay<T> values_, hidden_, gradient_, linear_, place_;
  std::vector<T> position_, state_, slopes_, placed_;
  StructuredLDLT<T> ldlt_, friction_ldlt_;
};

/// The factory of a model's taped constraints.
struct TapedConstraintSource {
  std::shared_ptr<const HolonomicTapes> tapes;
  template <class T>
  [[nodiscard]] std::unique_ptr<HolonomicConstraints<T>> constraint_evaluator() const {
    return std::make_unique<TapedConstraints<T>>(tapes);
  }
};

}  // namespace pfaff
