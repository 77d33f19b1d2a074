#include <pfaff/bench/runner/record.hpp>

#include <algorithm>
#include <chrono>

#include <pfaff/bench/runner/observing.hpp>
#include <pfaff/bench/runner/steps.hpp>
#include <pfaff/core/errors/budget.hpp>
#include <pfaff/runs/integration.hpp>

namespace pfaff {

namespace {

// Ends a run whose budget has ended after `step` steps, at time t. A failure that is known by then stays.
template <class T>
void end_by(const BudgetSpent& spent, const T& t, std::int64_t step, RunRecord& record) {
  record.completed = step;
  if (record.status != Status::converged) return;
  record.interrupted = spent.stopped();
  if (!spent.stopped()) record.status = Status::not_converged;
  record.message =
      (spent.stopped() ? "it was interrupted" : std::string(spent.what())) + " " + place_of(Quad(t), step);
  if (spent.reason() == BudgetSpent::Reason::steps) record.message += "; --max-steps sets it";
}

// For a run that stands where a step failed: a phrase that names the largest smaller step that still works,
// to a few percent.
template <class T>
std::string smaller_step(const Integration<T>& run) {
  const std::vector<T> z(run.state().begin(), run.state().end());
  const auto works = [&](const T& step) { return run.beside(z, run.time(), step).steps(1).reached(); };
  T good = run.step() / T(2), bad = run.step();
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

// Drift is measured at every step in runs of up to four million steps, and at evenly spaced ones in longer
// runs. A processed method is looked at where states are kept alone, since every look takes its processor.
std::int64_t steps_between_looks(const ResolvedRun& run) {
  if (run.method->processed()) return run.every;
  std::int64_t stride = std::min(run.every, std::max<std::int64_t>(1, run.steps / 2000000));
  while (run.every % stride != 0) --stride;
  return stride;
}

// The work of so many steps and of one more that fails, where a block of steps has gone on behind that. A
// processed method takes its processor at every look again.
template <class T>
Counters counters_up_to(const ResolvedRun& run, std::int64_t steps, bool fails) {
  Integration<T> again(start_of<T>(run));
  const std::int64_t at_a_time = run.method->processed() ? steps_between_looks(run) : steps;
  while (again.steps_taken() < steps)
    if (!again.steps(std::min(at_a_time, steps - again.steps_taken())).reached()) break;
  if (fails) (void)again.steps(1);
  return again.counters();
}

// Takes the steps of a run, so many at a time that whoever watches sees progress.
template <class T>
Outcome all_steps(Integration<T>& integration, std::int64_t steps, std::int64_t stride) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds little{20}, much{200};
  std::int64_t rows = integration.method().processed() ? 1 : 16;  // all steps between two rows are one call
  while (true) {
    const auto begin = Clock::now();
    Outcome outcome = integration.steps(std::min(rows * stride, steps - integration.steps_taken()));
    if (!outcome.reached() || integration.steps_taken() == steps) return outcome;
    const auto elapsed = Clock::now() - begin;
    if (elapsed < little) rows = std::min<std::int64_t>(2 * rows, 65536);
    if (elapsed > much) rows = std::max<std::int64_t>(1, rows / 2);
  }
}

template <class T>
void execute_fixed(const ResolvedRun& run, Observing<T>& observing, RunRecord& record) {
  Integration<T> integration(start_of<T>(run));
  const std::int64_t stride = steps_between_looks(run);
  bool failed = false, counts = true;  // counts: no step was taken in vain
  try {
    integration.watch(observing, stride);
    if (!observing.ended()) {
      const Outcome outcome = all_steps(integration, run.steps, stride);
      if (outcome.reached() && run.steps % stride != 0) observing.last(integration);
      failed = outcome.end() == Outcome::End::failed;
      counts = outcome.reached() || (failed && outcome.status() != Status::non_finite);
      if (failed) {
        record.completed = integration.steps_taken();
        record.status = outcome.status();
        record.message = outcome.message() + smaller_step(integration);
      }
    }
  } catch (const BudgetSpent& spent) {
    end_by(spent, integration.time(), integration.steps_taken(), record);
  }
  record.counters =
      counts ? integration.counters() : counters_up_to<T>(run, integration.steps_taken(), failed);
}

// The number of intervals between evenly spaced samples of a run whose method chooses its steps. Every sample
// forces a step to end there and so shortens it. A trial run without samples counts the steps that the method
// takes by itself; with one sample for every eight of them the shortening hardly matters. A trial whose
// budget ends has taken more steps than any number of samples needs, or the run ends at once, too.
template <class T>
int sample_intervals(const ResolvedRun& run) {
  constexpr std::int64_t enough = 8 * (std::int64_t{most_intervals} + 1);
  const Budget budget({.steps = std::min(run.settings.step_budget, enough)});
  Integration<T> trial(start_of<T>(run));
  try {
    (void)trial.to(T(run.t0) + T(run.time));
  } catch (const BudgetSpent&) {
  }
  return static_cast<int>(std::clamp<std::int64_t>(trial.counters().steps / 8, 32, most_intervals));
}

template <class T>
void execute_adaptive(const ResolvedRun& run, Observing<T>& observing, RunRecord& record,
                      const Progress& progress) {
  const int intervals = sample_intervals<T>(run);
  const Budget budget({.steps = run.settings.step_budget});
  Integration<T> integration(start_of<T>(run));
  const auto steps = [&] { return integration.counters().steps; };
  try {
    bool ended = observing.chosen(integration);
    for (int k = 1; k <= intervals && !ended; ++k) {
      const Outcome outcome = integration.to(T(run.t0) + T(run.time) * T(k) / T(intervals));
      if (!outcome.reached()) {
        record.status = outcome.status();
        record.message = "the step control gave up " + place_of(Quad(integration.time()), steps()) +
                         ": no step meets the tolerance in every coordinate (what counts in small ones, "
                         "--absolute says)";
        break;
      }
      ended = observing.chosen(integration);
      if (progress) progress(static_cast<double>(k) / intervals);
    }
  } catch (const BudgetSpent& spent) {
    end_by(spent, integration.time(), steps(), record);
  }
  record.counters = integration.counters();
  record.completed = record.counters.steps;
}

}  // namespace

std::unique_ptr<SharedSolution> solution_of(const ResolvedRun& run) {
  std::vector<Quad> initial;
  for (const Real& x : run.initial) initial.push_back(x.quad());
  return std::make_unique<SharedSolution>(run.model, run.t0.quad(), std::move(initial));
}

std::shared_ptr<const ReferenceSolution> reference_of(const ResolvedRun& run) {
  return solution_of(run)->to(run.time.quad());
}

std::shared_ptr<const ReferenceSolution> reference_asked_for(const ResolvedRun& run) {
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
                           ? (record.sample_count == 0 ? run.t0.quad() : record.last_sample)
                           : run.t0.quad() + Quad(static_cast<double>(record.completed)) * run.step.quad();
  throw RunError("integrator " + run.settings.integrator + " on system " + run.model->name() +
                 ": thrown after t = " + to_string(reached, 10) + ": " + words);
}

template <class T>
void execute_in(const ResolvedRun& run, const ReferenceSolution* reference, const Progress& progress,
                SampleTaker* samples, RunRecord& record) {
  Observing<T> observing(run, reference, samples, progress, record);
  if (run.adaptive()) {
    execute_adaptive(run, observing, record, progress);
  } else {
    execute_fixed(run, observing, record);
  }
  observing.finish();
}

}  // namespace

RunRecord execute(const ResolvedRun& run, const ReferenceSolution* reference, const Progress& progress,
                  const std::atomic<bool>* stop, SampleTaker* samples) {
  RunRecord record;
  const Budget budget({}, stop);
  try {
    if (run.settings.precision == Precision::quad) {
      execute_in<Quad>(run, reference, progress, samples, record);
    } else {
      execute_in<double>(run, reference, progress, samples, record);
    }
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const RunError&) {
    throw;
  } catch (const InputError&) {
    if (record.sample_count == 0) throw;  // what a method refuses before its first step
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
  const Start<T> start = start_of<T>(run);
  Integration<T> timed(start);
  // Seconds per step over the first `count` steps, or, for a run that chooses its steps, over a tenth of the
  // run.
  const auto elapsed = [&](std::int64_t count) {
    timed.forget();
    timed.go_on_from(start.state, start.t0, start.h);
    const std::int64_t before = timed.counters().steps;
    const auto begin = Clock::now();
    const Outcome outcome = run.adaptive() ? timed.to(start.t0 + T(run.time) / T(10)) : timed.steps(count);
    const std::chrono::duration<double> time = Clock::now() - begin;
    if (outcome.status() == Status::non_finite) return 0.0;
    const std::int64_t completed = run.adaptive() ? timed.counters().steps - before : outcome.steps();
    return completed > 0 ? time.count() / static_cast<double>(completed) : 0.0;
  };
  // Nothing is timed where the steps leave the range of numbers; fewer of them may not.
  const auto shortened = [&](std::int64_t& count) {
    double time = elapsed(count);
    while (!(time > 0) && count > 1 && !run.adaptive()) time = elapsed(count /= 2);
    return time;
  };
  std::int64_t count = std::min<std::int64_t>(run.steps, 200);
  const double rough = shortened(count);  // warm-up
  constexpr int repetitions = 7;
  if (rough > 0 && !run.adaptive())
    count = std::clamp<std::int64_t>(static_cast<std::int64_t>(seconds / repetitions / rough), 1, run.steps);
  StepTime result;
  result.repetitions = repetitions;
  const auto begin = Clock::now();
  std::vector<double> times{shortened(count) * 1e9};
  while (times.size() < repetitions) times.push_back(elapsed(count) * 1e9);
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
