#include <pfaff/verify/measured_step.hpp>

#include <algorithm>

#include <pfaff/runs/motion.hpp>

namespace pfaff {

template <class T>
MeasuredStep<T>::MeasuredStep(const MethodInstance& method, std::shared_ptr<const Model> model,
                              const std::vector<Real>& start, const Real& t, const Real& h, int warm_up,
                              bool carried)
    : method_(method), model_(std::move(model)), h_(h), warm_up_(warm_up), carried_(carried || warm_up > 0) {
  move_to(start, t);
}

template <class T>
void MeasuredStep<T>::move_to(const std::vector<Real>& start, const Real& t) {
  begin_ = T(t);
  t_ = T(t) + T(warm_up_) * h_;
  begin_state_.clear();
  for (const Real& x : start) begin_state_.push_back(T(x));
  start_ = begin_state_;
  taken_ = false;
  status_ = Status::converged;
  end_.reset();
  jacobian_.reset();
  scales_.clear();
}

template <class T>
Integration<T>& MeasuredStep<T>::from(const T& time, const T& length, std::vector<T> z) {
  if (run_) {
    run_->forget();
    run_->go_on_from(std::move(z), time, length);
  } else {
    Start<T> start = start_with(method_, model_, std::move(z), length, time);
    start.block_rows = 1;
    run_.emplace(std::move(start));
  }
  return *run_;
}

template <class T>
const std::optional<std::vector<T>>& MeasuredStep<T>::end() {
  if (taken_) return end_;
  Integration<T>& run = from(begin_, h_, begin_state_);
  status_ = run.steps(warm_up_).status();
  start_.assign(run.state().begin(), run.state().end());
  if (status_ == Status::converged) status_ = run.steps(1).status();
  if (status_ == Status::converged) end_.emplace(run.state().begin(), run.state().end());
  taken_ = true;  // not before, since the budget of a check may end in between
  return end_;
}

template <class T>
std::optional<std::vector<T>> MeasuredStep<T>::after(const T& time, const T& length, std::vector<T> z,
                                                     int count) {
  Integration<T>& run = from(time, length, std::move(z));
  if (!run.steps(count).reached()) return std::nullopt;
  return std::vector<T>(run.state().begin(), run.state().end());
}

template <class T>
Integration<T>* MeasuredStep<T>::at_end() {
  if (!end()) return nullptr;
  if (!carried_) return &from(t_ + h_, h_, *end_);
  Integration<T>& run = from(begin_, h_, begin_state_);
  return run.steps(warm_up_ + 1).reached() ? &run : nullptr;
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
