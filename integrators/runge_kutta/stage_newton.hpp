// Simplified Newton iteration for the stages of a step, all components of all stages together.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <pfaff/core/linear/lu.hpp>
#include <pfaff/core/solve/newton.hpp>
#include <pfaff/integrators/support/beside_rounding.hpp>

namespace pfaff {

/// The stages and what their iteration works with; `stages` of so many components.
template <class T>
class StageNewton {
 public:
  using Number = Value<T>;
  StageNewton(std::size_t stages, std::size_t components)
      : components_(components),
        matrix_(stages * components),
        unknowns_(stages * components),
        reference_(unknowns_),
        residual_(unknowns_),
        correction_(unknowns_) {}

  /// Factors the matrix of the iteration: coupling(i, k, j, l) is how component k of stage i follows
  /// component l of stage j. False where it is singular.
  template <class Coupling>
  [[nodiscard]] bool factor(const Coupling& coupling) {
    const std::size_t m = components_;
    for (std::size_t row = 0; row < unknowns_.size(); ++row)
      for (std::size_t column = 0; column < unknowns_.size(); ++column)
        matrix_(row, column) =
            (row == column ? Number(1) : Number(0)) - coupling(row / m, row % m, column / m, column % m);
    return matrix_.factor();
  }
  /// Sets component k of stage i to x, whose corrections are measured by `reference`.
  void begin(std::size_t i, std::size_t k, const T& x, const T& reference) {
    unknowns_[i * components_ + k] = x;
    reference_[i * components_ + k] = reference;
  }
  [[nodiscard]] const T& stage(std::size_t i, std::size_t k) const { return unknowns_[i * components_ + k]; }

  /// Solves for the stages, with newton(): residual(unknowns, residual) fills in the residuals, stage by
  /// stage. Where corrections are in vain by the references they are measured by what is rounded too, which
  /// rounded(sizes) fills in for the components of each stage.
  template <class Residual, class Rounded>
  Status solve(const Residual& residual, const Rounded& rounded, auto&& iterations) {
    int count = 0;
    const Status status = newton<T>(matrix_, residual, unknowns_, reference_, residual_, correction_, 100,
                                    count, [&] { return references_of_rounding(rounded); });
    iterations += count;
    return status;
  }

 private:
  template <class Rounded>
  std::span<const T> references_of_rounding(const Rounded& rounded) {
    std::vector<Number> sizes(unknowns_.size());
    rounded(std::span<Number>(sizes).first(components_));
    for (std::size_t k = components_; k < sizes.size(); ++k) sizes[k] = sizes[k % components_];
    rounding_ = reference_;
    add_rounding(rounding_, sizes, residual_, correction_,
                 [this] { matrix_.solve(residual_.data(), correction_.data()); });
    return rounding_;
  }

  std::size_t components_;
  LU<Number> matrix_;
  std::vector<T> unknowns_, reference_, residual_, correction_;
  std::vector<T> rounding_;  // made by the first step that asks for it
};

}  // namespace pfaff
