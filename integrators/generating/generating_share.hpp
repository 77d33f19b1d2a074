// The share P of w = P y' + (I - P) y: the matrix which says how a generating function mixes new coordinates
// y' and old coordinates y.
//
// Normal Darboux matrices P = (I + V)/2 with V in sp(2n), J V + V^T J = 0: only these make the Jacobian of
// the generating function's gradient symmetric, and so the scheme symplectic in the chart. V = 0 is
// Poincare's midpoint form, the one that is symmetric in time; V = diag(I, -I) takes new q with old p, V =
// diag(-I, I) old q with new p.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// The three classical mixes of old and new coordinates.
enum class GeneratingForm { midpoint, new_q_old_p, old_q_new_p };

/// P for any number of degrees of freedom, exact.
class GeneratingShare {
 public:
  GeneratingShare(GeneratingForm form) {  // NOLINT(google-explicit-constructor): a form is a share
    const int sign = form == GeneratingForm::midpoint ? 0 : form == GeneratingForm::new_q_old_p ? 1 : -1;
    normal_ = {sign, 0, 0, -sign};
  }
  /// P = (I + V)/2 with V row-major on (q, p): (2n)^2 numbers, or four (a b; c d) that stand for the blocks a
  /// I, b I, c I, d I of any size.
  explicit GeneratingShare(std::vector<Real> normal) : normal_(std::move(normal)) {}

  /// Whether V has a size that `dimension` coordinates can take.
  [[nodiscard]] bool fits(std::size_t dimension) const {
    return normal_.size() == 4 || normal_.size() == dimension * dimension;
  }
  [[nodiscard]] Quad normal(std::size_t i, std::size_t j, std::size_t dimension) const {
    if (normal_.size() == dimension * dimension) return normal_[i * dimension + j].quad();
    const std::size_t half = dimension / 2, row = i < half ? 0 : 1, column = j < half ? 0 : 1;
    return i - row * half == j - column * half ? normal_[2 * row + column].quad() : Quad(0);
  }
  /// max |J V + V^T J|; zero for normal Darboux matrices.
  [[nodiscard]] Quad defect(std::size_t dimension) const {
    const std::size_t half = dimension / 2;
    // (J V)_ij: row i of J picks row i + n with sign +, or row i - n with sign -.
    const auto rotated = [&](std::size_t i, std::size_t j) {
      return i < half ? normal(i + half, j, dimension) : -normal(i - half, j, dimension);
    };
    Quad worst(0);
    for (std::size_t i = 0; i < dimension; ++i)
      for (std::size_t j = 0; j < i; ++j) worst = std::max(worst, abs(rotated(i, j) - rotated(j, i)));
    return worst;
  }
  /// True where each component of w depends on its own coordinate alone.
  [[nodiscard]] bool diagonal(std::size_t dimension) const {
    for (std::size_t i = 0; i < dimension; ++i)
      for (std::size_t j = 0; j < dimension; ++j)
        if (i != j && !(normal(i, j, dimension) == Quad(0))) return false;
    return true;
  }
  [[nodiscard]] bool midpoint(std::size_t dimension) const {
    for (std::size_t i = 0; i < dimension; ++i)
      if (!(normal(i, i, dimension) == Quad(0))) return false;
    return diagonal(dimension);
  }

 private:
  std::vector<Real> normal_;
};

/// P as numbers of T.
template <class T>
class ShareMatrix {
 public:
  ShareMatrix(const GeneratingShare& share, std::size_t dimension)
      : n_(dimension), diagonal_(share.diagonal(dimension)), entries_(diagonal_ ? n_ : n_ * n_) {
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t j = 0; j < n_; ++j)
        if (i == j || !diagonal_)
          entries_[diagonal_ ? i : i * n_ + j] =
              T(Real((Quad(i == j ? 1 : 0) + share.normal(i, j, n_)) / Quad(2)));
  }

  [[nodiscard]] bool diagonal() const { return diagonal_; }
  [[nodiscard]] T operator()(std::size_t i, std::size_t j) const {
    if (diagonal_) return i == j ? entries_[i] : T(0);
    return entries_[i * n_ + j];
  }
  /// (P x)_i
  template <class X>
  [[nodiscard]] X row(std::size_t i, const X* x) const {
    if (diagonal_) return entries_[i] * x[i];
    X sum = entries_[i * n_] * x[0];
    for (std::size_t j = 1; j < n_; ++j) sum = sum + entries_[i * n_ + j] * x[j];
    return sum;
  }

 private:
  std::size_t n_;
  bool diagonal_;
  std::vector<T> entries_;
};

}  // namespace pfaff
