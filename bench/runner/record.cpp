#include <pfaff/bench/runner/record.hpp>

#include <algorithm>
#include <chrono>

#include <pfaff/bench/runner/motion.hpp>
#include <pfaff/bench/runner/observer.hpp>
#include <pfaff/bench/runner/steps.hpp>

namespace pfaff {

namespace {

// Where a run has ended, for messages.
template <class T>
std::string at(const T& t, std::int64_t step) {
  return "at t = " + to_string(Quad(t), 10) + " (step " + std::to_string(step) + ")";
}

// Ends a run at which something measured is not finite; true where there is such a thing.
template <class T>
bool ended_by(const std::string& not_finite, const T& t, std::int64_t step, RunRecord& record) {
  if (not_finite.empty()) return false;
  record.status = Status::non_finite;
  record.message = not_finite + " " + at(t, step);
  return true;
}

// Ends a run that has been asked to stop; true where it has.
template <class T>
bool interrupted(const std::atomic<bool>* stop, const T& t, std::int64_t step, RunRecord& record) {
  if (stop == nullptr || !stop->load(std::memory_order_relaxed)) return false;
  record.interrupted = true;
  record.message = "it was interrupted " + at(t, step);
  return true;
}

std::string failure(Status status, const std::string& when) {
  switch (status) {
    case Status::not_converged:
      return "the implicit solve did not converge " + when;
    case Status::singular:
      return "a linear system was singular " + when;
    case Status::non_finite:
      return "the state or the structure left the range of numbers " + when;
    case Status::converged:
      break;
  }
  return {};
}

// For a step of size h that failed at (t, z): a phrase that names the largest smaller step that still works,
// to a few percent.
template <class T>
std::string smaller_step(const ResolvedRun& run, const T& t, const T& h, const std::vector<T>& z) {
  const auto works = [&](const T& step) {
    std::vector<T> copy = z;
    std::int64_t completed = 0;
    const Status status = run.method->stepper(run.model, T())->advance(t, 0, step, 1, copy, completed);
    return status == Status::converged;
  };
  T good = h / T(2), bad = h;
  for (int halvings = 0; !works(good); good = good / T(2), ++halvings) {
    if (halvings == 20) return "; nor does any smaller step work from there";
    bad = good;
  }
  for (int k = 0; k < 5; ++k) {
    const T middle = (good + bad) / T(2);
    (works(middle) ? good : bad) = middle;
  }
  return "; from there a step of " + to_string(Quad(good), 3) + " works";
}

template <class T>
void execute_fixed(const ResolvedRun& run, Observer<T>& observer, RunRecord& record, const Progress& progress,
                   const std::atomic<bool>* stop) {
  const auto stepper = run.method->stepper(run.model, T());
  std::vector<T> z;
  for (const Real& x : run.initial) z.push_back(T(x));
  const T t0(run.t0), h(run.step);
  const auto time = [&](std::int64_t k) { return t0 + T(static_cast<double>(k)) * h; };
  const auto exact = [&](std::int64_t k) { return Quad(t0) + Quad(static_cast<double>(k)) * Quad(h); };
  // Drift is measured at every step in runs of up to two million steps, and at evenly spaced ones in longer
  // runs. A processed method is looked at where states are kept alone, since every look takes its processor.
  const std::int64_t stride = run.method->processed()
                                  ? run.every
                                  : std::min(run.every, std::max<std::int64_t>(1, run.steps / 2000000));
  const std::int64_t rows = run.steps / run.every + 1;
  const std::int64_t structure_rows = std::max<std::int64_t>(1, rows / 50);
  std::int64_t row = 0;
  bool ended = ended_by(observer.observe(time(0), exact(0), z, true, true), time(0), 0, record);
  for (std::int64_t k = 0; k < run.steps && !ended;) {
    const std::int64_t next_row = std::min(run.steps, (k / run.every + 1) * run.every);
    const std::int64_t count = std::min(stride, next_row - k);
    std::int64_t completed = 0;
    const Status status = stepper->advance(t0, k, h, count, z, completed);
    record.completed = k + completed;
    if (status != Status::converged) {
      record.status = status;
      const T reached = time(k + completed);
      record.message = failure(status, at(reached, k + completed)) + smaller_step(run, reached, h, z);
      break;
    }
    k += count;
    const bool keep = k % run.every == 0 || k == run.steps;
    if (keep) ++row;
    const bool structure = keep && (row % structure_rows == 0 || k == run.steps);
    const bool bad = ended_by(observer.observe(time(k), exact(k), z, keep, structure), time(k), k, record);
    if (bad) record.completed = k - count;  // the steps behind which all was finite
    ended = bad || (k < run.steps && interrupted(stop, time(k), k, record));
    if (progress && keep) progress(static_cast<double>(k) / static_cast<double>(run.steps));
  }
  record.counters = stepper->counters();
}

// The number of intervals between evenly spaced samples of a run whose method chooses its steps. Every sample
// forces a step to end there and so shortens it. A trial run without samples counts the steps that the method
// takes by itself; with one sample for every eight of them the shortening hardly matters.
template <class T>
int sample_intervals(const ResolvedRun& run) {
  const auto stepper = run.method->stepper(run.model, T());
  std::vector<T> z;
  for (const Real& x : run.initial) z.push_back(T(x));
  T t(run.t0);
  const std::vector<T> absolute = absolute_tolerances<T>(run);
  (void)stepper->advance_to(t, t + T(run.time), {T(run.tolerance), absolute}, z);
  return static_cast<int>(std::clamp<std::int64_t>(stepper->counters().steps / 8, 32, most_intervals));
}

// Ends a run that has taken more steps than it may; true where it has.
template <class T>
bool beyond_budget(const ResolvedRun& run, const T& t, std::int64_t steps, RunRecord& record) {
  if (steps <= run.settings.step_budget) return false;
  record.status = Status::not_converged;
  record.message = "more than " + std::to_string(run.settings.step_budget) +
                   " steps (--max-steps) were taken " + at(t, steps);
  return true;
}

template <class T>
void execute_adaptive(const ResolvedRun& run, Observer<T>& observer, RunRecord& record,
                      const Progress& progress, const std::atomic<bool>* stop) {
  const int intervals = sample_intervals<T>(run);
  const auto stepper = run.method->stepper(run.model, T());
  std::vector<T> z;
  for (const Real& x : run.initial) z.push_back(T(x));
  const std::vector<T> absolute = absolute_tolerances<T>(run);
  T t(run.t0);
  bool ended = ended_by(observer.observe(t, Quad(t), z, true, false), t, 0, record);
  for (int k = 1; k <= intervals && !ended; ++k) {
    const T end = T(run.t0) + T(run.time) * T(k) / T(intervals);
    const Status status = stepper->advance_to(t, end, {T(run.tolerance), absolute}, z);
    if (status != Status::converged) {
      record.status = status;
      record.message = "the step control gave up " + at(t, stepper->counters().steps) +
                       ": no step meets the tolerance in every coordinate (what counts in small ones, "
                       "--absolute says)";
      break;
    }
    const std::int64_t steps = stepper->counters().steps;
    ended = ended_by(observer.observe(t, Quad(t), z, true, false), t, steps, record) ||
            (k < intervals && (beyond_budget(run, t, steps, record) || interrupted(stop, t, steps, record)));
    if (progress) progress(static_cast<double>(k) / intervals);
  }
  record.counters = stepper->counters();
  record.completed = record.counters.steps;
}

}  // namespace

std::unique_ptr<ReferenceSolution> reference_of(const ResolvedRun& run) {
  std::vector<Quad> initial;
  for (const Real& x : run.initial) initial.push_back(x.quad());
  // A method that steps on the constraints runs on a model without a vector field. The Taylor reference needs
  // one, so it is computed from the motion of that model.
  const bool exact = run.model->facets().has(Facet::exact_solution);
  return std::make_unique<ReferenceSolution>(exact ? run.model : motion_of(run.model), run.t0.quad(), initial,
                                             run.time.quad());
}

std::unique_ptr<ReferenceSolution> reference_asked_for(const ResolvedRun& run) {
  const ErrorsAgainst against = run.settings.reference;
  const bool exact = run.model->facets().has(Facet::exact_solution);
  const bool wanted = against == ErrorsAgainst::solution || (against == ErrorsAgainst::exact && exact);
  if (!wanted) return nullptr;
  return reference_of(run);
}

namespace {
// Makes of what a step or a formula throws, which is a fault of its plug-in, an error that names the method,
// the system and the time from which the run did not go on. To be called in a catch clause.
[[noreturn]] void report_thrown(const ResolvedRun& run, const RunRecord& record) {
  const std::string words = words_of_current_exception();
  const Quad reached = run.adaptive()
                           ? (record.samples.empty() ? run.t0.quad() : record.samples.back().t)
                           : run.t0.quad() + Quad(static_cast<double>(record.completed)) * run.step.quad();
  throw RunError("integrator " + run.settings.integrator + " on system " + run.model->name() +
                 ": thrown after t = " + to_string(reached, 10) + ": " + words);
}

template <class T>
void execute_in(const ResolvedRun& run, const ReferenceSolution* reference, const Progress& progress,
                const std::atomic<bool>* stop, RunRecord& record) {
  Observer<T> observer(run, reference, record);
  if (run.adaptive()) {
    execute_adaptive(run, observer, record, progress, stop);
  } else {
    execute_fixed(run, observer, record, progress, stop);
  }
  observer.finish();
}

void execute_into(const ResolvedRun& run, const ReferenceSolution* reference, const Progress& progress,
                  const std::atomic<bool>* stop, RunRecord& record) {
  if (run.settings.precision == Precision::quad) {
    execute_in<Quad>(run, reference, progress, stop, record);
  } else {
    execute_in<double>(run, reference, progress, stop, record);
  }
}
}  // namespace

RunRecord execute(const ResolvedRun& run, const ReferenceSolution* reference, const Progress& progress,
                  const std::atomic<bool>* stop) {
  RunRecord record;
  try {
    execute_into(run, reference, progress, stop, record);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const RunError&) {
    throw;
  } catch (const InputError&) {
    if (record.samples.empty()) throw;  // what a method refuses before its first step
    report_thrown(run, record);
  } catch (...) {
    report_thrown(run, record);
  }
  return record;
}

namespace {
template <class T>
StepTime time_in(const ResolvedRun& run, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto stepper = run.method->stepper(run.model, T());
  const std::vector<T> absolute = absolute_tolerances<T>(run);
  // Seconds per step over the first `count` steps, or, for a run that chooses its steps, over a tenth of the
  // run.
  const auto elapsed = [&](std::int64_t count) {
    std::vector<T> z;
    for (const Real& x : run.initial) z.push_back(T(x));
    stepper->forget();
    std::int64_t completed = 0;
    const std::int64_t before = stepper->counters().steps;
    const auto begin = Clock::now();
    if (run.adaptive()) {
      T t(run.t0);
      const T end = t + T(run.time) / T(10);
      (void)stepper->advance_to(t, end, {T(run.tolerance), absolute}, z);
    } else {
      (void)stepper->advance(T(run.t0), 0, T(run.step), count, z, completed);
    }
    const std::chrono::duration<double> time = Clock::now() - begin;
    if (run.adaptive()) completed = stepper->counters().steps - before;
    return completed > 0 ? time.count() / static_cast<double>(completed) : 0.0;
  };
  std::int64_t count = std::min<std::int64_t>(run.steps, 200);
  const double rough = elapsed(count);  // warm-up
  constexpr int repetitions = 7;
  if (rough > 0 && !run.adaptive())
    count = std::clamp<std::int64_t>(static_cast<std::int64_t>(seconds / repetitions / rough), 1, run.steps);
  StepTime result;
  result.repetitions = repetitions;
  std::vector<double> times;
  const auto begin = Clock::now();
  for (int k = 0; k < repetitions; ++k) times.push_back(elapsed(count) * 1e9);
  result.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  std::sort(times.begin(), times.end());
  result.median = times[repetitions / 2];
  result.minimum = times.front();
  result.maximum = times.back();
  return result;
}
}  // namespace

StepTime time_steps(const ResolvedRun& run, double seconds) {
  return run.settings.precision == Precision::quad ? time_in<Quad>(run, seconds)
                                                   : time_in<double>(run, seconds);
}

}  // namespace pfaff
