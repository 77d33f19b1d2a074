#include <pfaff/verify/measured_step.hpp>

#include <algorithm>

#include <pfaff/runs/motion.hpp>

namespace pfaff {

template <class T>
MeasuredStep<T>::MeasuredStep(const MethodInstance& method, std::shared_ptr<const Model> model,
                              const std::vector<Real>& start, const Real& t, const Real& h, int warm_up,
                              bool carried)
    : method_(method),
      model_(std::move(model)),
      begin_(t),
      t_(T(t) + T(warm_up) * T(h)),
      h_(h),
      warm_up_(warm_up),
      carried_(carried || warm_up > 0) {
  for (const Real& x : start) begin_state_.push_back(T(x));
  start_ = begin_state_;
}

template <class T>
const std::optional<std::vector<T>>& MeasuredStep<T>::end() {
  if (taken_) return end_;
  stepper().forget();
  std::int64_t completed = 0;
  start_ = begin_state_;
  status_ = stepper().advance(begin_, 0, h_, warm_up_, start_, completed);
  if (status_ == Status::converged) {
    std::vector<T> z = start_;
    status_ = stepper().advance(begin_, warm_up_, h_, 1, z, completed);
    if (status_ == Status::converged) end_ = std::move(z);
  }
  taken_ = true;  // not before, since the budget of a check may end in between
  return end_;
}

template <class T>
std::optional<std::vector<T>> MeasuredStep<T>::after(const T& time, const T& length, std::vector<T> z,
                                                     int count) {
  stepper().forget();
  std::int64_t completed = 0;
  if (stepper().advance(time, 0, length, count, z, completed) != Status::converged) return std::nullopt;
  return z;
}

template <class T>
std::optional<std::vector<T>> MeasuredStep<T>::then(const T& length, std::vector<T> z) {
  stepper().forget();
  std::int64_t completed = 0;
  std::vector<T> before = begin_state_;
  if (stepper().advance(begin_, 0, h_, warm_up_ + 1, before, completed) != Status::converged ||
      stepper().advance(t_ + h_, 0, length, 1, z, completed) != Status::converged)
    return std::nullopt;
  return z;
}

template <class T>
const StepJacobian<T>& MeasuredStep<T>::jacobian() {
  if (!jacobian_) jacobian_ = StepDifferentiator<T>(method_, model_)(t_, h_, start());
  return *jacobian_;
}

template <class T>
const std::vector<T>& MeasuredStep<T>::scales() {
  if (scales_.empty()) {
    const std::vector<T> last = end().value_or(start_);
    scales_ = step_scales<T>(*motion_of(model_), t_, h_, start_, last);
  }
  return scales_;
}

template <class T>
T MeasuredStep<T>::distance(const std::vector<T>& a, const std::vector<T>& b) {
  T largest(0);
  for (std::size_t k = 0; k < a.size(); ++k) {
    const T difference = abs(a[k] - b[k]);
    if (difference == T(0)) continue;
    const T relative = difference / scales()[k];
    largest = isnan(relative) || isnan(largest) ? relative + largest : std::max(largest, relative);
  }
  return largest;
}

template class MeasuredStep<double>;
template class MeasuredStep<Quad>;

}  // namespace pfaff
