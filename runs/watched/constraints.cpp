#include <pfaff/runs/watched/constraints.hpp>

#include <type_traits>

namespace pfaff {

template <class T>
WatchedConstraints<T>::WatchedConstraints(const Model& model)
    : names_(constraint_residual_names(model)),
      residuals_at_(model),
      drift_(names_.size()),
      growth_(names_.size()) {
  if (model.restricted()) roundings_.emplace(model.tape(Formula::constraints));
}

template <class T>
std::string WatchedConstraints<T>::take(const T& t, const std::vector<T>& z) {
  residuals_at_(t, z, residuals_);
  for (std::size_t i = 0; i < residuals_.size(); ++i)
    if (!drift_[i].add(static_cast<double>(t), static_cast<double>(residuals_[i])))
      return "the residual " + names_[i] + " is not finite";
  return {};
}

template <class T>
void WatchedConstraints<T>::sample(double t, double elapsed, const std::vector<double>& z) {
  if (roundings_) roundings_->add(t, z);
  for (std::size_t i = 0; i < growth_.size(); ++i)
    growth_[i].add(elapsed, static_cast<double>(residuals_[i]));
}

// Constraints and hidden ones stand by turns.
template <class T>
ConstraintsLeft WatchedConstraints<T>::left(std::int64_t steps) {
  ConstraintsLeft left;
  const double unit = std::is_same_v<T, Quad> ? 0x1p-113 : 0x1p-53;
  for (std::size_t i = 0; i < drift_.size(); ++i) {
    left.drift.push_back(drift_[i].result(roundings_->largest(unit, steps, i, drift_.size())));
    left.growth.push_back(growth_[i].growth());
  }
  return left;
}

template class WatchedConstraints<double>;
template class WatchedConstraints<Quad>;

}  // namespace pfaff
