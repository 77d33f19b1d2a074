// The constraints phi(q, t) = 0 of any canonical H(q, p, t), from tapes.
//
// Everything is derived from the formulas phi and H: phi~ = {phi, H} + phi_t, its rate, and B, P, T by
// differentiation onto the tape. The tape also tells where these matrices have entries, and from this follows
// the structure in which S = B H_pp B^T is factored.
// H may have any mass matrix M(q), and need not be quadratic in p.
#pragma once

#include <memory>
#include <utility>

#include <pfaff/core/facets/holonomic.hpp>
#include <pfaff/core/facets/taped_parts.hpp>

namespace pfaff {

class Model;

/// The formulas that everything else follows from. Beside coordinates they may have parameters, as the last
/// inputs of every tape, by which nothing is differentiated.
struct HolonomicFormulas {
  std::size_t degrees = 0, parameters = 0;
  std::shared_ptr<const Tape> values;    // (q, t) -> phi
  std::shared_ptr<const Tape> gradient;  // (q, p, t) -> (H_q - Q, H_p), the slopes of the motion
  std::shared_ptr<const Tape> friction;  // (q, p, t) -> lambda; null where there is none
};

/// The tapes that are recorded once for a system. R of LinearTapes is B; `place` goes on with phi, phi~, h,
/// T, lambda, S^D.
struct HolonomicTapes : LinearTapes {
  std::shared_ptr<const Tape> values;  // (q, t) -> phi
  std::shared_ptr<const Tape> hidden;  // (q, p, t) -> phi~
  SparseRows hidden_by_position;       // T
  std::shared_ptr<const SymmetricPattern> friction_pattern;
  bool friction = false;
};

/// Records these tapes. The time is linear in the size of the formulas.
HolonomicTapes record_holonomic(const HolonomicFormulas& formulas);
/// The same from the formulas holonomic, hamiltonian and, where there is one, friction of a model.
HolonomicTapes record_holonomic(const Model& model);

template <class T>
class TapedConstraints : public TapedParts<T, HolonomicConstraints<T>, HolonomicTapes> {
  using Parts = TapedParts<T, HolonomicConstraints<T>, HolonomicTapes>;

 public:
  using Parts::count;
  using Parts::degrees;
  using Parts::solve;

  /// `parameters` are the values of the parameters of the formulas.
  explicit TapedConstraints(std::shared_ptr<const HolonomicTapes> tapes,
                            const std::vector<T>& parameters = {})
      : Parts(tapes, parameters),
        values_(tapes->values),
        hidden_(tapes->hidden),
        position_(tapes->degrees + parameters.size()),
        friction_ldlt_(tapes->friction_pattern) {
    std::copy(parameters.rbegin(), parameters.rend(), position_.rbegin());
  }

  void values(const T& t, In<T> q, Out<T> phi) override {
    std::copy(q.begin(), q.end(), position_.begin());
    values_(t, position_.data(), phi.data());
  }
  void hidden_values(const T& t, In<T> q, In<T> p, Out<T> hidden) override {
    hidden_(t, this->join(q, p), hidden.data());
  }
  void solve(In<T> r1, Out<T> x1, In<T> r2, Out<T> x2) const override {
    this->factors().solve(r1.data(), x1.data(), r2.data(), x2.data());
  }
  void hidden_by_momentum(In<T> u, Out<T> r) const override { this->times_momenta(u, r); }
  void hidden_by_momentum_transpose(In<T> x, Out<T> v) const override { this->times_momenta_transpose(x, v); }

  [[nodiscard]] std::span<const T> residuals() const override { return after_flow(0, count()); }
  [[nodiscard]] std::span<const T> hidden() const override { return after_flow(count(), count()); }
  [[nodiscard]] std::span<const T> hidden_rates() const override { return after_flow(2 * count(), count()); }
  void hidden_by_position(In<T> u, Out<T> r) const override {
    this->tapes().hidden_by_position.template multiply<T>(positions_of_hidden().data(), u, r);
  }
  void hidden_by_position_transpose(In<T> x, Out<T> f) const override {
    this->tapes().hidden_by_position.template multiply_transpose<T>(positions_of_hidden().data(), x, f);
  }

  [[nodiscard]] std::span<const T> friction() const override {
    return after_hidden(0, this->tapes().friction ? degrees() : 0);
  }
  Status factor_friction() override {
    const std::size_t couplings = this->tapes().friction_pattern->couplings().size();
    const std::span<const T> entries = after_hidden(degrees(), count() + couplings);
    for (std::size_t k = 0; k < count(); ++k) friction_ldlt_.diagonal()[k] = entries[k];
    for (std::size_t c = 0; c < couplings; ++c) friction_ldlt_.couplings()[c] = entries[count() + c];
    return friction_ldlt_.factor_semidefinite();
  }
  void solve_friction(In<T> r, Out<T> x) const override { friction_ldlt_.solve(r.data(), x.data()); }

 private:
  // The outputs of `place` after H_p and -H_q, and those after the entries of T, which follow phi, phi~ and
  // h.
  [[nodiscard]] std::span<const T> after_flow(std::size_t offset, std::size_t size) const {
    return this->part(2 * degrees() + offset, size);
  }
  [[nodiscard]] std::span<const T> positions_of_hidden() const {
    return after_flow(3 * count(), this->tapes().hidden_by_position.columns.size());
  }
  [[nodiscard]] std::span<const T> after_hidden(std::size_t offset, std::size_t size) const {
    return after_flow(3 * count() + positions_of_hidden().size() + offset, size);
  }

  Replay<T> values_, hidden_;
  std::vector<T> position_;
  StructuredLDLT<T> friction_ldlt_;
};

/// The factory of a model's taped constraints.
class TapedHolonomicFactory final : public detail::MakerInUnits<TapedHolonomicFactory, HolonomicFactory> {
 public:
  explicit TapedHolonomicFactory(HolonomicTapes tapes)
      : tapes_(std::make_shared<const HolonomicTapes>(std::move(tapes))) {}
  template <class T>
  [[nodiscard]] HolonomicPointer<T> made() const {
    return std::make_unique<TapedConstraints<T>>(tapes_);
  }

 private:
  std::shared_ptr<const HolonomicTapes> tapes_;
};

}  // namespace pfaff
