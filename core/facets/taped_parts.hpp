// What constraints from tapes have in common, whether those of positions, phi(q, t) = 0, or of velocities,
// A(q, t) v + b(q, t) = 0: the slopes of H, a matrix R of rows (B or A), the matrix P = dpsi/dp of the
// constraints psi at the level of velocities, and S = P R^T, factored in the structure that its tape shows.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include <pfaff/core/facets/sparse_tape.hpp>
#include <pfaff/core/linear/structured_ldlt.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

/// The tapes that are recorded once for a system, and the structure of the matrices on them. Beside
/// coordinates the formulas may have parameters, as the last inputs of every tape, by which nothing is
/// differentiated.
struct LinearTapes {
  std::size_t count = 0, degrees = 0, parameters = 0;
  std::shared_ptr<const Tape> gradient;  // (q, p, t) -> (H_q - Q, H_p), the slopes of the motion
  std::shared_ptr<const Tape> linear;    // (q, p, t) -> R, P, S: entries, diagonal, couplings
  std::shared_ptr<const Tape> place;     // -> those, H_p, -H_q, and what follows
  SparseRows rows, by_momentum;          // R, P
  std::shared_ptr<const SymmetricPattern> pattern;
};

/// Appends the entries of R, P and S, with which the outputs of `linear` and of `place` begin, to `out`, and
/// fills in where they are.
void record_linear(const SparseRecorded& rows, const SparseRecorded& by_momentum, LinearTapes& tapes,
                   std::vector<Recorded>& out);

class Model;

/// (q, p, t) -> (H_q - Q, H_p) of a canonical model with the energy H and, where it has them, applied forces
/// Q: without reactions and friction q' is the second half and p' the negative of the first.
std::shared_ptr<const Tape> slopes_of_motion(const Model& model);

/// H_p and -H_q of a gradient tape with 2n outputs: the flow of H.
std::vector<Recorded> flow_of(const Tape& gradient, const Recorded& t, const std::vector<Recorded>& z);

/// A base of evaluators: Interface is HolonomicConstraints<T> or VelocityConstraints<T>, Tapes derives from
/// LinearTapes.
template <class T, class Interface, class Tapes>
class TapedParts : public Interface {
 public:
  [[nodiscard]] std::size_t count() const override { return tapes_->count; }
  [[nodiscard]] std::size_t degrees() const override { return tapes_->degrees; }
  [[nodiscard]] const SymmetricPattern& pattern() const override { return *tapes_->pattern; }

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
  void apply(In<T> u, Out<T> r) const override { tapes_->rows.template multiply<T>(placed_.data(), u, r); }
  void apply_transpose(In<T> x, Out<T> f) const override {
    tapes_->rows.template multiply_transpose<T>(placed_.data(), x, f);
  }
  void solve(In<T> r, Out<T> x) const override { ldlt_.solve(r.data(), x.data()); }

  Status place(const T& t, In<T> q, In<T> p) override {
    join(q, p);
    place_(t, state_.data(), placed_.data());
    return factor();
  }
  [[nodiscard]] std::span<const T> velocities() const override { return part(0, degrees()); }
  [[nodiscard]] std::span<const T> forces() const override { return part(degrees(), degrees()); }

 protected:
  /// `parameters` are the values of the parameters of the formulas.
  TapedParts(std::shared_ptr<const Tapes> tapes, const std::vector<T>& parameters)
      : tapes_(std::move(tapes)),
        gradient_(tapes_->gradient),
        linear_(tapes_->linear),
        place_(tapes_->place),
        state_(2 * tapes_->degrees + parameters.size()),
        slopes_(2 * tapes_->degrees),
        placed_(tapes_->place->outputs.size()),
        ldlt_(tapes_->pattern) {
    std::copy(parameters.rbegin(), parameters.rend(), state_.rbegin());
  }

  /// r = P u and v = P^T x.
  void times_momenta(In<T> u, Out<T> r) const {
    tapes_->by_momentum.template multiply<T>(placed_.data() + momentum_begin(), u, r);
  }
  void times_momenta_transpose(In<T> x, Out<T> v) const {
    tapes_->by_momentum.template multiply_transpose<T>(placed_.data() + momentum_begin(), x, v);
  }
  /// The outputs of `place` after those of `linear`: `size` from `offset`.
  [[nodiscard]] std::span<const T> part(std::size_t offset, std::size_t size) const {
    return std::span<const T>(placed_).subspan(placed_begin() + offset, size);
  }
  /// (q, p) and the parameters, joined for a tape.
  const T* join(In<T> q, In<T> p) {
    for (std::size_t k = 0; k < degrees(); ++k) {
      state_[k] = q[k];
      state_[degrees() + k] = p[k];
    }
    return state_.data();
  }
  /// S as last placed: its diagonal, and its couplings in the order of the pattern's.
  [[nodiscard]] std::span<const T> diagonal() const {
    return std::span<const T>(placed_).subspan(pattern_begin(), count());
  }
  [[nodiscard]] std::span<const T> couplings() const {
    return std::span<const T>(placed_).subspan(pattern_begin() + count(),
                                               tapes_->pattern->couplings().size());
  }
  [[nodiscard]] const Tapes& tapes() const { return *tapes_; }
  [[nodiscard]] const StructuredLDLT<T>& factors() const { return ldlt_; }

 private:
  [[nodiscard]] std::size_t momentum_begin() const { return tapes_->rows.columns.size(); }
  [[nodiscard]] std::size_t pattern_begin() const {
    return momentum_begin() + tapes_->by_momentum.columns.size();
  }
  [[nodiscard]] std::size_t placed_begin() const {
    return pattern_begin() + count() + tapes_->pattern->couplings().size();
  }
  void slopes(const T& t, In<T> q, In<T> p) { gradient_(t, join(q, p), slopes_.data()); }
  Status factor() {
    const T* entries = placed_.data() + pattern_begin();
    for (std::size_t k = 0; k < count(); ++k) ldlt_.diagonal()[k] = entries[k];
    for (std::size_t c = 0; c < tapes_->pattern->couplings().size(); ++c)
      ldlt_.couplings()[c] = entries[count() + c];
    return ldlt_.factor();
  }

  std::shared_ptr<const Tapes> tapes_;
  Replay<T> gradient_, linear_, place_;
  std::vector<T> state_, slopes_, placed_;
  StructuredLDLT<T> ldlt_;
};

}  // namespace pfaff
