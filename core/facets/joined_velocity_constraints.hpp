// Constraints of velocities of a system whose author wrote an evaluator of its holonomic constraints: that
// evaluator, and beside it the constraints A v + b = 0 from tapes.
//
// With the index h for holonomic constraints and v for those of velocities,
//
//   S = [S_h  C; C^T  S_v],  C = P_h A_v^T,  S_h Y = C,  Z = S_v - C^T Y
//   S x = r:  S_h y = r_h,  Z x_v = r_v - C^T y,  x_h = y - Y x_v
//
// so that S_h is factored by the author's evaluator in its own structure, and a placement costs one more
// solve with it for each constraint of velocities. These are taken to be few: Z is factored as a dense
// matrix. The tapes hold what belongs to A_v alone, and are short where its rows have few entries.
//
// Where the author's evaluator offers its ideal rates p'_h, those of all constraints are
//
//   p' = p'_h - W x_v,  W = (1 - B^T S_h^-1 P_h) A_v^T,  Z = psi_p W,  Z x_v = psi_t + psi_q v + psi_p p'_h
//
// with one response of the holonomic motion, a column of W, for each constraint of velocities.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include <pfaff/core/facets/holonomic.hpp>
#include <pfaff/core/facets/sparse_tape.hpp>
#include <pfaff/core/facets/velocity_constraints.hpp>
#include <pfaff/core/linear/structured_ldlt.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

class Model;

/// The tapes of the constraints of velocities alone, psi = A v + b, and where all of S has entries.
struct JoinedTapes {
  std::size_t holonomic = 0, count = 0, degrees = 0;       // count: of constraints of velocities
  std::shared_ptr<const Tape> values;                      // (q, p, t) -> psi
  std::shared_ptr<const Tape> place;                       // (q, p, t) -> A, psi_p, psi_q, psi, psi_t
  SparseRows rows, by_momentum, by_position;               // A, psi_p, psi_q
  std::shared_ptr<const SymmetricPattern> pattern, dense;  // of S and of Z
  std::vector<std::size_t> read;                           // the entries of (q, p) that these tapes read
};

/// Records them of a model with holonomic constraints and constraints of velocities. Entries of C are looked
/// for at a point off all special positions.
JoinedTapes record_joined(const Model& model);

template <class T>
class JoinedVelocityConstraints final : public VelocityConstraints<T> {
 public:
  JoinedVelocityConstraints(std::unique_ptr<HolonomicConstraints<T>> holonomic,
                            std::shared_ptr<const JoinedTapes> tapes)
      : holonomic_(std::move(holonomic)),
        tapes_(std::move(tapes)),
        values_(tapes_->values),
        place_(tapes_->place),
        z_(tapes_->dense),
        state_(2 * degrees()),
        placed_(tapes_->place->outputs.size()),
        row_(degrees()),
        coupling_(tapes_->holonomic * tapes_->count),
        answer_(coupling_.size()),
        residuals_(count()),
        rates_(count()),
        response_(degrees() * tapes_->count),
        multipliers_(tapes_->count),
        ideal_(holonomic_->ideal_rates()) {}

  [[nodiscard]] std::size_t count() const override { return tapes_->holonomic + tapes_->count; }
  [[nodiscard]] std::size_t degrees() const override { return tapes_->degrees; }
  [[nodiscard]] const SymmetricPattern& pattern() const override { return *tapes_->pattern; }

  void values(const T& t, In<T> q, In<T> p, Out<T> psi) override {
    holonomic_->hidden_values(t, q, p, psi.first(tapes_->holonomic));
    values_(t, join(q, p), psi.data() + tapes_->holonomic);
  }
  void velocity(const T& t, In<T> q, In<T> p, Out<T> v) override { holonomic_->velocity(t, q, p, v); }
  void force(const T& t, In<T> q, In<T> p, Out<T> f) override { holonomic_->force(t, q, p, f); }

  Status linearise(const T& t, In<T> q, In<T> p) override {
    const Status status = holonomic_->linearise(t, q, p);
    place_(t, join(q, p), placed_.data());
    const Status joined = factor();
    return status == Status::converged ? joined : status;
  }
  void apply(In<T> u, Out<T> r) const override {
    holonomic_->apply(u, r.first(tapes_->holonomic));
    tapes_->rows.template multiply<T>(placed_.data(), u, r.subspan(tapes_->holonomic));
  }
  void apply_transpose(In<T> x, Out<T> f) const override {
    holonomic_->apply_transpose(x.first(tapes_->holonomic), f);
    add_transpose(tapes_->rows, placed_.data(), x, f);
  }
  void by_momentum(In<T> u, Out<T> r) const override {
    holonomic_->hidden_by_momentum(u, r.first(tapes_->holonomic));
    tapes_->by_momentum.template multiply<T>(momenta(), u, r.subspan(tapes_->holonomic));
  }
  void by_momentum_transpose(In<T> x, Out<T> v) const override {
    holonomic_->hidden_by_momentum_transpose(x.first(tapes_->holonomic), v);
    add_transpose(tapes_->by_momentum, momenta(), x, v);
  }
  void solve(In<T> r, Out<T> x) const override {
    const std::size_t h = tapes_->holonomic;
    for (std::size_t i = 0; i < tapes_->count; ++i) {  // C^T y = Y^T r_h, since S_h is symmetric
      T sum = r[h + i];
      for (std::size_t k = 0; k < h; ++k) sum = sum - answer_[i * h + k] * r[k];
      x[h + i] = sum;
    }
    holonomic_->solve(r.first(h), x.first(h));
    z_.solve(x.data() + h, x.data() + h);
    for (std::size_t i = 0; i < tapes_->count; ++i)
      for (std::size_t k = 0; k < h; ++k) x[k] = x[k] - answer_[i * h + k] * x[h + i];
  }

  Status place(const T& t, In<T> q, In<T> p) override {
    const std::size_t h = tapes_->holonomic;
    const Status status = holonomic_->place(t, q, p);
    place_(t, join(q, p), placed_.data());
    const Status joined = factor();
    const T *slopes = positions(), *psi = placed_values();
    const In<T> v = holonomic_->velocities(), f = holonomic_->forces();
    std::copy(holonomic_->hidden().begin(), holonomic_->hidden().end(), residuals_.begin());
    std::copy(holonomic_->hidden_rates().begin(), holonomic_->hidden_rates().end(), rates_.begin());
    for (std::size_t i = 0; i < tapes_->count; ++i) {
      residuals_[h + i] = psi[i];
      T rate = psi[tapes_->count + i];
      for (std::size_t e = tapes_->by_position.begin[i]; e < tapes_->by_position.begin[i + 1]; ++e)
        rate = rate + slopes[e] * v[tapes_->by_position.columns[e]];
      for (std::size_t e = tapes_->by_momentum.begin[i]; e < tapes_->by_momentum.begin[i + 1]; ++e)
        rate = rate + momenta()[e] * f[tapes_->by_momentum.columns[e]];
      rates_[h + i] = rate;
    }
    return status == Status::converged ? joined : status;
  }
  [[nodiscard]] std::span<const T> residuals() const override { return residuals_; }
  [[nodiscard]] std::span<const T> rates() const override { return rates_; }
  [[nodiscard]] std::span<const T> velocities() const override { return holonomic_->velocities(); }
  [[nodiscard]] std::span<const T> forces() const override { return holonomic_->forces(); }
  [[nodiscard]] ConstrainedRates<T>* ideal_rates() override { return ideal_ == nullptr ? nullptr : &motion_; }

 private:
  struct Motion final : ConstrainedRates<T> {
    explicit Motion(JoinedVelocityConstraints& of) : joined(of) {}
    Status operator()(const T& t, In<T> q, In<T> p, Out<T> q_rate, Out<T> p_rate) override {
      return joined.move(t, q, p, q_rate, p_rate);
    }
    JoinedVelocityConstraints& joined;
  };

  Status move(const T& t, In<T> q, In<T> p, Out<T> q_rate, Out<T> p_rate) {
    const std::size_t n = degrees(), m = tapes_->count;
    const SparseRows &rows = tapes_->rows, &by_momentum = tapes_->by_momentum;
    const Status status = (*ideal_)(t, q, p, q_rate, p_rate);
    place_(t, join(q, p), placed_.data());
    const auto along = [](const SparseRows& where, std::size_t i, const T* entries, In<T> u) {
      T sum(0);
      for (std::size_t e = where.begin[i]; e < where.begin[i + 1]; ++e)
        sum = sum + entries[e] * u[where.columns[e]];
      return sum;
    };
    for (std::size_t i = 0; i < m; ++i) {
      const Out<T> response = Out<T>(response_).subspan(i * n, n);
      for (std::size_t e = rows.begin[i]; e < rows.begin[i + 1]; ++e) row_[rows.columns[e]] = placed_[e];
      ideal_->respond(row_, response);
      for (std::size_t e = rows.begin[i]; e < rows.begin[i + 1]; ++e) row_[rows.columns[e]] = T(0);
      for (std::size_t j = 0; j <= i; ++j) {
        const T entry = along(by_momentum, j, momenta(), response);
        if (i == j) {
          z_.diagonal()[i] = entry;
        } else {
          z_.couplings()[tapes_->dense->coupling(j, i)] = entry;
        }
      }
      multipliers_[i] = placed_values()[m + i] + along(tapes_->by_position, i, positions(), q_rate) +
                        along(by_momentum, i, momenta(), p_rate);
    }
    const Status joined = z_.factor();
    z_.solve(multipliers_.data(), multipliers_.data());
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t k = 0; k < n; ++k) p_rate[k] = p_rate[k] - response_[i * n + k] * multipliers_[i];
    return status == Status::converged ? joined : status;
  }

  // As last placed: the entries of psi_p and psi_q, and psi and psi_t.
  [[nodiscard]] const T* momenta() const { return placed_.data() + tapes_->rows.columns.size(); }
  [[nodiscard]] const T* positions() const { return momenta() + tapes_->by_momentum.columns.size(); }
  [[nodiscard]] const T* placed_values() const { return positions() + tapes_->by_position.columns.size(); }
  // What the tapes read of the state.
  const T* join(In<T> q, In<T> p) {
    for (const std::size_t k : tapes_->read) state_[k] = k < degrees() ? q[k] : p[k - degrees()];
    return state_.data();
  }
  // f += X^T x_v
  void add_transpose(const SparseRows& matrix, const T* entries, In<T> x, Out<T> f) const {
    for (std::size_t i = 0; i < tapes_->count; ++i)
      for (std::size_t e = matrix.begin[i]; e < matrix.begin[i + 1]; ++e)
        f[matrix.columns[e]] = f[matrix.columns[e]] + entries[e] * x[tapes_->holonomic + i];
  }
  // C and Y row by row, and the factors of Z.
  Status factor() {
    const std::size_t h = tapes_->holonomic, m = tapes_->count;
    const SparseRows& rows = tapes_->rows;
    for (std::size_t i = 0; i < m; ++i) {
      for (std::size_t e = rows.begin[i]; e < rows.begin[i + 1]; ++e) row_[rows.columns[e]] = placed_[e];
      const Out<T> c = Out<T>(coupling_).subspan(i * h, h), y = Out<T>(answer_).subspan(i * h, h);
      holonomic_->hidden_by_momentum(row_, c);
      holonomic_->solve(c, y);
      for (std::size_t j = 0; j <= i; ++j) {
        T entry(0);  // of S_v = psi_p A^T
        for (std::size_t e = tapes_->by_momentum.begin[j]; e < tapes_->by_momentum.begin[j + 1]; ++e)
          entry = entry + momenta()[e] * row_[tapes_->by_momentum.columns[e]];
        for (std::size_t k = 0; k < h; ++k) entry = entry - coupling_[j * h + k] * y[k];
        if (i == j) {
          z_.diagonal()[i] = entry;
        } else {
          z_.couplings()[tapes_->dense->coupling(j, i)] = entry;
        }
      }
      for (std::size_t e = rows.begin[i]; e < rows.begin[i + 1]; ++e) row_[rows.columns[e]] = T(0);
    }
    return z_.factor();
  }

  std::unique_ptr<HolonomicConstraints<T>> holonomic_;
  std::shared_ptr<const JoinedTapes> tapes_;
  Replay<T> values_, place_;
  StructuredLDLT<T> z_;
  std::vector<T> state_, placed_, row_, coupling_, answer_, residuals_, rates_;
  std::vector<T> response_, multipliers_;  // W column by column, and x_v
  IdealRates<T>* ideal_;                   // of the holonomic constraints, where they offer them
  Motion motion_{*this};
};

/// The factory of such constraints.
class JoinedVelocityFactory final : public detail::MakerInUnits<JoinedVelocityFactory, VelocityFactory> {
 public:
  JoinedVelocityFactory(std::shared_ptr<const HolonomicFactory> holonomic, JoinedTapes tapes)
      : holonomic_(std::move(holonomic)), tapes_(std::make_shared<const JoinedTapes>(std::move(tapes))) {}
  template <class T>
  [[nodiscard]] VelocityPointer<T> made() const {
    return std::make_unique<JoinedVelocityConstraints<T>>(holonomic_->make_for(std::type_identity<T>()),
                                                          tapes_);
  }

 private:
  std::shared_ptr<const HolonomicFactory> holonomic_;
  std::shared_ptr<const JoinedTapes> tapes_;
};

}  // namespace pfaff
