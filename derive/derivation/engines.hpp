// The engines that `pfaff derive` offers for holonomic constraints, as templates over the scalar: recorded
// they leave the equations of motion on a tape, and with numbers they are right-hand sides.
//
// They differ in how the Dirac bracket is made. Solving with the factors of S = B H_pp B^T is that of the
// formulations (formulations/); here are the closed inverse of a chain's S and the recursions, which take
// the solvers of brackets/dirac/. Symbols are those of core/facets/holonomic.hpp.
#pragma once

#include <utility>
#include <vector>

#include <pfaff/brackets/canonical.hpp>
#include <pfaff/brackets/dirac/recursive_solvers.hpp>
#include <pfaff/core/facets/taped_constraints.hpp>
#include <pfaff/core/linear/tridiagonal_inverse.hpp>
#include <pfaff/formulations/hamiltonian_reactions.hpp>

namespace pfaff {

/// Constraints whose S is one path, in which S^-1 is the closed form by minors, nguyen-turski (4.6).
template <class T>
class ConstraintsByMinors final : public TapedConstraints<T> {
 public:
  using TapedConstraints<T>::TapedConstraints;

  /// True where the rows of S are one path.
  static bool fits(const SymmetricPattern& pattern) {
    if (pattern.rows() < 2) return pattern.rows() == 1;
    return pattern.structure() == MatrixStructure::tridiagonal &&
           pattern.couplings().size() + 1 == pattern.rows();
  }

  Status place(const T& t, In<T> q, In<T> p) override {
    const Status status = TapedConstraints<T>::place(t, q, p);
    const EliminationPlan& plan = this->pattern().plan();
    Tridiagonal<T> s;
    for (std::size_t k = 0; k < this->count(); ++k) s.diagonal.push_back(this->diagonal()[row(k)]);
    for (std::size_t k = 0; k + 1 < this->count(); ++k)
      s.couplings.push_back(this->couplings()[plan.link[k]]);
    inverse_ = inverse_by_minors(s);
    return status;
  }
  void solve(In<T> r, Out<T> x) const override {
    std::vector<T> product(r.size(), T(0));
    for (std::size_t i = 0; i < r.size(); ++i)
      for (std::size_t j = 0; j < r.size(); ++j)
        product[row(i)] = product[row(i)] + inverse_(i, j) * r[row(j)];
    std::copy(product.begin(), product.end(), x.begin());
  }
  void solve(In<T> r1, Out<T> x1, In<T> r2, Out<T> x2) const override {
    solve(r1, x1);
    solve(r2, x2);
  }

 private:
  // The constraint that is the k-th along the path.
  [[nodiscard]] std::size_t row(std::size_t k) const {
    return this->count() < 2 ? k : this->pattern().plan().order[k];
  }
  Matrix<T> inverse_{0, 0};
};

/// Constraints as a solver of the Dirac bracket sees them: K gradients on n coordinates, and their brackets.
template <class T>
class BracketData {
 public:
  BracketData(Symmetry symmetry, std::size_t dimension, std::vector<T> gradients)
      : symmetry_(symmetry),
        dimension_(dimension),
        count_(gradients.size() / dimension),
        gradients_(std::move(gradients)),
        sharps_(gradients_.size()),
        gram_(count_ * count_),
        vector_(dimension),
        brackets_(count_) {}

  /// Computes all brackets, and the bracket's vector of `covector`, with sharp(covector, vector) of the base;
  /// `tensor` is that of the base, or empty where the solver does without.
  template <class Sharp>
  DiracData<T> place(const Sharp& sharp, In<T> covector, In<T> tensor) {
    const std::size_t n = dimension_;
    for (std::size_t i = 0; i < count_; ++i) sharp(gradient(i), Out<T>(sharps_).subspan(i * n, n));
    sharp(covector, Out<T>(vector_));
    std::vector<std::size_t> support;
    for (std::size_t i = 0; i < count_; ++i) {
      support.clear();
      for (std::size_t a = 0; a < n; ++a)
        if (!structurally_zero(gradient(i)[a])) support.push_back(a);
      const auto bracket = [&](const T* other) {
        T sum(0);
        for (const std::size_t a : support) sum = sum + gradient(i)[a] * other[a];
        return sum;
      };
      for (std::size_t j = i; j < count_; ++j) {
        const bool itself = i == j && symmetry_ == Symmetry::skew;
        const T w = itself ? T(0) : bracket(sharps_.data() + j * n);
        gram_[i * count_ + j] = w;
        gram_[j * count_ + i] = symmetry_ == Symmetry::skew ? T(-w) : w;
      }
      brackets_[i] = bracket(vector_.data());
    }
    return {n, count_, symmetry_, gradients_, sharps_, gram_, covector, vector_, brackets_, tensor};
  }

 private:
  [[nodiscard]] In<T> gradient(std::size_t i) const {
    return In<T>(gradients_).subspan(i * dimension_, dimension_);
  }
  Symmetry symmetry_;
  std::size_t dimension_, count_;
  std::vector<T> gradients_, sharps_, gram_, vector_, brackets_;
};

/// The motion of holonomic constraints by a solver of the Dirac bracket: {z, H}_D - <z, H>_D with the
/// canonical bracket and, where the constraints have friction, the symmetric one with the coefficients
/// lambda. The order of the constraints is phi_1, phi~_1, phi_2, phi~_2, ... or the one that is given, as
/// places in this list; those of positions are Casimirs of the symmetric bracket. Constraints that depend on
/// time have no place here.
template <class Solver, class T>
class BracketRates {
 public:
  explicit BracketRates(HolonomicConstraints<T>& constraints, std::vector<std::size_t> order = {})
      : constraints_(constraints), order_(std::move(order)) {}

  Status operator()(const T& t, In<T> q, In<T> p, Out<T> rate) {
    const Status status = place(t, q, p);
    const std::size_t n = q.size();
    std::vector<T> slopes;  // dH
    for (const T& f : constraints_.forces()) slopes.push_back(-f);
    for (const T& v : constraints_.velocities()) slopes.push_back(v);
    const Status moved = sharp(slopes, rate);
    const In<T> lambda = constraints_.friction();
    if (lambda.empty() || moved != Status::converged) return status == Status::converged ? moved : status;
    std::vector<T> rubbed(2 * n);
    const Status dragged = apply(
        Symmetry::symmetric, hidden_, slopes,
        [&](In<T> covector, Out<T> vector) {
          for (std::size_t k = 0; k < n; ++k) {
            vector[k] = T(0);
            vector[n + k] = lambda[k] * covector[n + k];
          }
        },
        rubbed);
    for (std::size_t k = 0; k < 2 * n; ++k) rate[k] = rate[k] - rubbed[k];
    return status == Status::converged ? dragged : status;
  }

  /// Places the gradients of all constraints at a state.
  Status place(const T& t, In<T> q, In<T> p) {
    const Status status = constraints_.place(t, q, p);
    const std::size_t n = q.size(), count = constraints_.count();
    std::vector<T> unit(count, T(0));
    all_.clear();
    hidden_.clear();
    for (std::size_t k = 0; k < count; ++k) {
      unit[k] = T(1);
      std::vector<T> position(2 * n, T(0)), velocity(2 * n, T(0));
      constraints_.apply_transpose(unit, Out<T>(position).first(n));
      constraints_.hidden_by_position_transpose(unit, Out<T>(velocity).first(n));
      constraints_.hidden_by_momentum_transpose(unit, Out<T>(velocity).subspan(n));
      unit[k] = T(0);
      all_.insert(all_.end(), position.begin(), position.end());
      all_.insert(all_.end(), velocity.begin(), velocity.end());
      hidden_.insert(hidden_.end(), velocity.begin(), velocity.end());
    }
    if (!order_.empty()) {
      const std::vector<T> plain = std::move(all_);
      all_.clear();
      for (const std::size_t i : order_)
        for (std::size_t a = 0; a < 2 * n; ++a) all_.push_back(plain[i * 2 * n + a]);
    }
    return status;
  }
  /// The gradients on (q, p) at the state last placed, in their order.
  [[nodiscard]] const std::vector<T>& gradients() const { return all_; }
  /// vector = the Dirac bracket's vector of a covector on (q, p), at the state last placed.
  Status sharp(In<T> covector, Out<T> vector) const {
    return apply(
        Symmetry::skew, all_, covector,
        [](In<T> f, Out<T> x) { CanonicalBracket().sharp(T(0), In<T>(), f, x); }, vector);
  }

 private:
  template <class Sharp>
  static Status apply(Symmetry symmetry, std::vector<T> gradients, In<T> covector, const Sharp& sharp,
                      Out<T> result) {
    const std::size_t n = covector.size(), count = gradients.size() / n;
    std::vector<T> tensor(Solver::wants_tensor ? n * n : 0, T(0)), unit(n, T(0)), column(n);
    if (Solver::wants_tensor)
      for (std::size_t b = 0; b < n; ++b) {
        unit[b] = T(1);
        sharp(In<T>(unit), Out<T>(column));
        for (std::size_t a = 0; a < n; ++a) tensor[a * n + b] = column[a];
        unit[b] = T(0);
      }
    BracketData<T> brackets(symmetry, n, std::move(gradients));
    const DiracData<T> data = brackets.place(sharp, covector, tensor);
    const Solver solver{};
    typename Solver::template Work<T> work(solver, n, count);
    return solver(data, result, work);
  }

  HolonomicConstraints<T>& constraints_;
  std::vector<std::size_t> order_;
  std::vector<T> all_, hidden_;  // dphi_1, dphi~_1, dphi_2, ..., and dphi~_1, dphi~_2, ...
};

}  // namespace pfaff
