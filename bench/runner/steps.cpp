#include <pfaff/bench/runner/steps.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <pfaff/bench/runner/record.hpp>
#include <pfaff/runs/asked_for.hpp>
#include <pfaff/runs/support/chosen_steps.hpp>

namespace pfaff {

namespace {
// Refuses steps of which too little is left in the scalar T of the run: one that rounds to zero, and one for
// which t + h is off by more than a millionth of h at a time of the run. Forces that depend on time would be
// taken at wrong times, and samples be given wrong ones. Where the start and the step are multiples of the
// spacing of numbers at the latest time, nothing is off. `step_text` and `option` are the step as it was
// asked for.
template <class T>
void check_times(const ResolvedRun& run, const T& signed_step, const std::string& step_text,
                 const std::string& option) {
  const T step = abs(signed_step), t0(run.t0), end = t0 + T(run.time);
  const T latest = std::max(abs(t0), abs(end));
  const std::string in = " in " + std::string(to_string(run.settings.precision)) + " precision";
  const std::string expected = std::is_same_v<T, Quad> ? "" : ", or --precision quad";
  if (!(step > T(0)))
    throw InputError(option + ": " + step_text + " rounds to 0" + in + "; expected a larger number" +
                     expected);
  const T unit = std::numeric_limits<T>::epsilon();
  const T spacing = (latest + T(3) / T(4) * unit * latest) - latest;
  const auto multiple = [&](const T& x) {
    const T whole = T(1) / unit;  // numbers from here on have no fraction, and sums with it lose theirs
    const T parts = abs(x) / spacing;
    return parts >= whole || (parts + whole) - whole == parts;
  };
  if ((multiple(t0) && multiple(step)) || spacing <= T(2) / T(1000000) * step) return;
  throw InputError(option + ": " + step_text + " is too little beside the time " +
                   to_string(Quad(latest), 6) + in + ", where t + h is off by up to " +
                   to_string(Quad(spacing / T(2)), 3) +
                   " and a millionth of h is allowed; expected a larger number" +
                   (t0 == T(0) ? "" : ", an origin of time that is nearer to the run") + expected);
}

// Refuses a tolerance that no step can meet in the scalar T of the run.
template <class T>
void check_tolerance(const ResolvedRun& run) {
  constexpr T round_off = std::numeric_limits<T>::epsilon();
  if (T(run.tolerance) < round_off)
    throw InputError("--tolerance: " + run.settings.tolerance + " is below round-off, which is " +
                     to_string(Quad(round_off), 3) + "; expected at least that" +
                     (adaptive_in_quad(*run.method, run.model) && !std::is_same_v<T, Quad>
                          ? ", or --precision quad"
                          : ""));
}

// Refuses a start at rest in zero to which no absolute tolerance gives a scale.
template <class T>
void check_scales(const ResolvedRun& run) {
  if (!run.model->moves()) return;
  const Problem<T> problem(run.model);
  std::vector<T> z, rate(run.initial.size());
  for (const Real& x : run.initial) z.push_back(T(x));
  problem.field(T(run.t0), z, rate);
  const std::vector<T> absolute = absolute_tolerances<T>(run);
  CoordinateScales<Problem<T>>(problem).find({T(run.tolerance), absolute}, z, rate, T(0));
}

template <class T>
void check_adaptive(const ResolvedRun& run) {
  check_tolerance<T>(run);
  // Samples are that far apart at least.
  check_times(run, T(run.time) / T(most_intervals), run.settings.time, "--time");
  check_scales<T>(run);
}

// For a run that chooses its steps: fills in its tolerances.
void resolve_tolerance(ResolvedRun& run) {
  const RunSettings& settings = run.settings;
  if (!settings.step.empty()) throw InputError("--step and --tolerance exclude each other");
  run.tolerance = finite_number(settings.tolerance, "--tolerance");
  if (settings.every > 0)
    throw InputError(
        "--every counts steps of one length; with --tolerance samples are evenly spaced in time");
  for (const std::string& text : settings.absolute) run.absolute.push_back(finite_number(text, "--absolute"));
  if (run.absolute.size() == 1) run.absolute.assign(run.initial.size(), Real(run.absolute.front()));
  check_tolerances(*run.method, *run.model, run.tolerance.quad(), {run.absolute.begin(), run.absolute.end()},
                   {.tolerance = "--tolerance",
                    .absolute = "--absolute",
                    .got = ", got '" + settings.tolerance + "'",
                    .without = "--step instead of --tolerance"});
  if (settings.precision == Precision::quad && !adaptive_in_quad(*run.method, run.model))
    throw InputError(run.method->called() + " chooses its steps in double only; expected --precision double");
  if (settings.precision == Precision::quad) {
    check_adaptive<Quad>(run);
  } else {
    check_adaptive<double>(run);
  }
}

// For a run with steps of one length: fills in the step, how many there are and after how many to sample.
void resolve_fixed_steps(ResolvedRun& run) {
  const RunSettings& settings = run.settings;
  if (settings.step.empty())
    throw InputError("--step is missing (or --tolerance for methods that choose their steps)");
  run.step = finite_number(settings.step, "--step");
  if (run.step == Real(0)) throw InputError("--step: expected a number > 0, got '" + settings.step + "'");
  if (run.step < Real(0) && !run.backwards())
    throw InputError("--step: expected a number > 0 beside the duration " + settings.time +
                     ", which goes forwards, got '" + settings.step + "'; a run backwards has a --time < 0");
  run.step = towards(run.time, run.step);
  if (towards(Real(1), run.step) > towards(Real(1), run.time))
    throw InputError("--step: expected at most the duration " + settings.time + ", got '" + settings.step +
                     "'");
  const double ratio = (run.time / run.step).value();
  if (!(ratio <= static_cast<double>(settings.step_budget)))
    throw InputError("--step: " + settings.step + " is too small for a duration of " + settings.time +
                     ": that takes " + to_string(Quad(ratio), 3) + " steps; expected at most " +
                     std::to_string(settings.step_budget) + " (--max-steps)");
  if (settings.precision == Precision::quad) {
    check_times(run, Quad(run.step), settings.step, "--step");
  } else {
    check_times(run, double(run.step), settings.step, "--step");
  }
  // A run has a whole number of steps; a duration that is not a multiple of the step is shortened to one.
  const double nearest = std::round(ratio);
  run.steps =
      static_cast<std::int64_t>(std::abs(ratio - nearest) < 1e-9 * nearest ? nearest : std::floor(ratio));
  // Every state that is kept costs a processed method its processor.
  const std::int64_t states = run.method->processed() ? 200 : 1000;
  run.every =
      settings.every > 0 ? settings.every : std::max<std::int64_t>(1, (run.steps + states - 1) / states);
}
}  // namespace

Real towards(const Real& duration, const Real& step) {
  return (step < Real(0)) == (duration < Real(0)) ? step : -step;
}

std::string other_duration(const ResolvedRun& run) {
  if (run.adaptive()) return {};
  const Quad end = run.step.quad() * Quad(static_cast<double>(run.steps)), time = run.time.quad();
  const Quad round_off = Quad(4 * std::numeric_limits<double>::epsilon()) * abs(time);
  if (abs(end - time) <= Quad(1e-9) * abs(run.step.quad()) + round_off) return {};
  return "the run lasts " + to_string(end, 15) + ", not " + to_string(time, 15) + ": " +
         std::to_string(run.steps) + (run.steps == 1 ? " step" : " whole steps") + " of " +
         to_string(run.step) + ", and none is shortened";
}

void resolve_steps(ResolvedRun& run) {
  if (run.adaptive()) {
    resolve_tolerance(run);
  } else if (!run.settings.absolute.empty()) {
    throw InputError("--absolute goes with --tolerance, which is missing");
  } else {
    resolve_fixed_steps(run);
  }
}

}  // namespace pfaff
