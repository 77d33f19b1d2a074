// One step of a method on a model, as the measures of claims use it: its start and end, its Jacobian, and
// further steps for claims about more than one.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

#include <pfaff/runs/history.hpp>
#include <pfaff/runs/integration.hpp>
#include <pfaff/runs/support/structure.hpp>
#include <pfaff/verify/step_scale.hpp>

namespace pfaff {

/// The round-off allowed in one step, relative to the sizes of the numbers that the step is made of: 1e-14 in
/// double and 1e-31 in quad. These are about 100 and 1000 units of round-off, which leaves room for sums over
/// stages and for the conditioning of a step.
template <class T>
constexpr double tolerance() {
  return std::is_same_v<T, Quad> ? 1e-31 : 1e-14;
}
template <class T>
constexpr const char* precision_name() {
  return std::is_same_v<T, Quad> ? "quad" : "double";
}

/// The residual of a step that does not converge: not-a-number, with which no check passes.
inline constexpr double no_step = std::numeric_limits<double>::quiet_NaN();

/// As many steps forget the start of a method that remembers its past, which is not of the method's own kind.
inline constexpr int steps_of_warm_up = static_cast<int>(longest_beginning);

/// A step of size h from `start` at time t, in the scalar T. What is asked of it is computed when it is first
/// asked for, and kept. With a warm-up, the stepper takes so many steps of the same size before the one that
/// is measured, and keeps its history. Claims about two steps take the second with the history of the first
/// after a warm-up, or where it is said that history is `carried`.
template <class T>
class MeasuredStep {
 public:
  MeasuredStep(const MethodInstance& method, std::shared_ptr<const Model> model,
               const std::vector<Real>& start, const Real& t, const Real& h, int warm_up = 0,
               bool carried = false);

  /// Moves the step to another state and time: what was found is forgotten, and the stepper stays, which
  /// takes longer to make than many a step.
  void move_to(const std::vector<Real>& start, const Real& t);

  [[nodiscard]] const MethodInstance& method() const { return method_; }
  [[nodiscard]] const std::shared_ptr<const Model>& model() const { return model_; }
  /// The time at which the measured step begins, and its size.
  [[nodiscard]] const T& t() const { return t_; }
  [[nodiscard]] const T& h() const { return h_; }
  /// The state from which the measured step begins, after the warm-up.
  const std::vector<T>& start() {
    (void)end();
    return start_;
  }

  /// The state after the step; nullopt where it does not converge.
  const std::optional<std::vector<T>>& end();
  /// How the step, or the first of the warm-up that failed, ended.
  Status status() {
    (void)end();
    return status_;
  }
  /// The state after `count` steps of size `length` from z at `time`, without history; nullopt where one does
  /// not converge.
  std::optional<std::vector<T>> after(const T& time, const T& length, std::vector<T> z, int count = 1);
  /// The method at a state, without history, to take steps of size `length` from there. There is one run for
  /// all calls, which every member that takes steps moves on.
  Integration<T>& from(const T& time, const T& length, std::vector<T> z);
  /// The run where the measured step ends, with the history of the warm-up and that step where it is carried;
  /// null where the step does not converge.
  Integration<T>* at_end();
  /// The Jacobian of the step without history, from dual numbers carried through the converged step.
  const StepJacobian<T>& jacobian();
  /// The sizes against which residuals of the step are judged, one for each coordinate (step_scales).
  const std::vector<T>& scales();
  /// The largest difference of two states in units of the scales.
  T distance(const std::vector<T>& a, const std::vector<T>& b);
  /// The number of steps taken before the one that is measured.
  [[nodiscard]] int warm_up() const { return warm_up_; }

 private:
  const MethodInstance& method_;
  std::shared_ptr<const Model> model_;
  T begin_, t_, h_;  // the time before the warm-up, that of the measured step, and its size
  int warm_up_;
  bool carried_;
  std::vector<T> begin_state_, start_;  // before the warm-up and after it
  std::optional<Integration<T>> run_;
  bool taken_ = false;
  Status status_ = Status::converged;
  std::optional<std::vector<T>> end_;
  std::optional<StepJacobian<T>> jacobian_;
  std::vector<T> scales_;
};

}  // namespace pfaff
