// Claims about symmetry: what undoes a step, another of -h or, by way of a reversal, another of h. Methods
// that remember earlier steps take the second step with what they remember of the first, since their map is
// one of the state and of what is remembered.
#include <pfaff/runs/way_back.hpp>
#include <pfaff/verify/claim_checks.hpp>

namespace pfaff {

namespace {
// How far a way back misses the start of the step, relative to the rounding of the step.
template <class T>
double missed_by(const WayBack<T>& back, MeasuredStep<T>& step) {
  Integration<T>* const run = step.at_end();
  const auto z = run != nullptr ? back(*run, 1) : std::nullopt;
  return z ? static_cast<double>(step.distance(*z, step.start())) : no_step;
}
}  // namespace

template <class T>
double symmetry_residual(MeasuredStep<T>& step) {
  return missed_by(WayBack<T>(), step);
}

template <class T>
double reversibility_residual(MeasuredStep<T>& step) {
  return missed_by(WayBack<T>(step.model()), step);
}

template double symmetry_residual(MeasuredStep<double>&);
template double symmetry_residual(MeasuredStep<Quad>&);
template double reversibility_residual(MeasuredStep<double>&);
template double reversibility_residual(MeasuredStep<Quad>&);

}  // namespace pfaff
