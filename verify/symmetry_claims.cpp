// Claims about symmetry: what undoes a step, another of -h or, by way of a reversal, another of h. Methods
// that remember earlier steps take the second step with what they remember of the first, since their map is
// one of the state and of what is remembered.
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/verify/claim_checks.hpp>

namespace pfaff {

namespace {
// The distance of a state from the start of the step, relative to the rounding of the step.
template <class T>
double distance_from_start(MeasuredStep<T>& step, const std::optional<std::vector<T>>& z) {
  return z ? static_cast<double>(step.distance(*z, step.start())) : no_step;
}
}  // namespace

template <class T>
double symmetry_residual(MeasuredStep<T>& step) {
  if (!step.end()) return no_step;
  return distance_from_start(step, step.carried() ? step.then(-step.h(), *step.end())
                                                  : step.after(step.t() + step.h(), -step.h(), *step.end()));
}

// The claim speaks of autonomous systems only, so that both steps may be taken at the same time t.
template <class T>
double reversibility_residual(MeasuredStep<T>& step) {
  Replay<T> reversal(step.model()->tape(Formula::reversal));
  const auto reversed = [&](const std::vector<T>& z) {
    std::vector<T> out(z.size());
    reversal(step.t(), z.data(), out.data());
    return out;
  };
  if (!step.end()) return no_step;
  const auto back = step.carried() ? step.then(step.h(), reversed(*step.end()))
                                   : step.after(step.t(), step.h(), reversed(*step.end()));
  if (!back) return no_step;
  return distance_from_start(step, std::optional(reversed(*back)));
}

template double symmetry_residual(MeasuredStep<double>&);
template double symmetry_residual(MeasuredStep<Quad>&);
template double reversibility_residual(MeasuredStep<double>&);
template double reversibility_residual(MeasuredStep<Quad>&);

}  // namespace pfaff
