// The residuals of constraints along a run: the largest of each level, how they drift and how fast they grow.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pfaff/runs/support/constraints.hpp>
#include <pfaff/runs/support/growth.hpp>
#include <pfaff/runs/support/rounding_sizes.hpp>
#include <pfaff/runs/support/watched_error.hpp>

namespace pfaff {

/// What is left of the residuals at the end of a run, in the order of constraint_residual_names().
struct ConstraintsLeft {
  std::vector<Drift> drift;
  std::vector<std::optional<Growth>> growth;
};

/// Watches the constraints of one run in the scalar T. States are taken in their order, the start first; some
/// of them are samples too.
template <class T>
class WatchedConstraints {
 public:
  explicit WatchedConstraints(const Model& model);

  /// Takes a state, of which residuals() are then the largest residuals of each level. What is not finite, as
  /// a phrase; or nothing.
  [[nodiscard]] std::string take(const T& t, const std::vector<T>& z);
  [[nodiscard]] const std::vector<T>& residuals() const { return residuals_; }
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

  /// Samples a state, of which residuals() are the residuals, so long after the start.
  void sample(double t, double elapsed, const std::vector<double>& z);

  /// After so many steps.
  [[nodiscard]] ConstraintsLeft left(std::int64_t steps);

 private:
  std::vector<std::string> names_;
  ConstraintResiduals<T> residuals_at_;
  std::optional<RoundingSizes> roundings_;  // none without constraints
  std::vector<T> residuals_;
  std::vector<WatchedError> drift_;
  std::vector<GrowthFit> growth_;
};

extern template class WatchedConstraints<double>;
extern template class WatchedConstraints<Quad>;

}  // namespace pfaff
