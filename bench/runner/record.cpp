#include <pfaff/bench/runner/record.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

#include <pfaff/bench/measure/constraints.hpp>

namespace pfaff {

namespace {

// A structure residual takes Jacobians, whose cost grows as the cube of the dimension: beyond this one it
// would be most of a run.
constexpr int most_differentiated = 64;

// Observes a run of scalar T as it goes.
template <class T>
class Observer {
 public:
  Observer(const ResolvedRun& run, const ReferenceSolution* reference, RunRecord& record)
      : run_(run),
        reference_(reference),
        record_(record),
        problem_(run.model),
        constraints_(*run.model),
        values_(run.model->invariants().size()) {
    if (run.structure_residuals && StructureResidual<T>::applies(*run.model) && !run.adaptive() &&
        run.model->dimension() <= most_differentiated)
      residual_.emplace(*run.method, run.model);
    drift_.resize(values_.size());
    constraint_drift_.resize(constraint_residual_names(*run.model).size());
    lowest_.assign(values_.size(), std::numeric_limits<T>::infinity());
    record_.rise.assign(values_.size(), 0.0);
  }

  // Drift sees every step; `keep` adds a row to the series, `structure` a residual to the row.
  void observe(const T& t, const std::vector<T>& z, bool keep, bool structure) {
    if (!values_.empty()) problem_.invariants(t, z, values_);
    if (initial_.empty()) initial_ = values_;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      drift_[i].add(static_cast<double>(t), static_cast<double>(values_[i] - initial_[i]));
      lowest_[i] = std::min(lowest_[i], values_[i]);
      record_.rise[i] = std::max(record_.rise[i], static_cast<double>(values_[i] - lowest_[i]));
    }
    constraints_(t, z, residuals_);
    for (std::size_t i = 0; i < residuals_.size(); ++i)
      constraint_drift_[i].add(static_cast<double>(t), static_cast<double>(residuals_[i]));
    if (!keep) return;
    Sample sample{Quad(t),
                  {z.begin(), z.end()},
                  {values_.begin(), values_.end()},
                  {residuals_.begin(), residuals_.end()},
                  {},
                  {}};
    if (reference_ != nullptr) sample.error = relative_error(sample);
    if (structure && residual_) {
      const T r = (*residual_)(t, T(run_.step), z);
      if (isfinite(r)) sample.structure = Quad(r);
      if (isfinite(r)) worst(record_.structure_residual, static_cast<double>(r));
    }
    if (sample.error) {
      worst(record_.error_max, static_cast<double>(*sample.error));
      record_.error_final = static_cast<double>(*sample.error);
    }
    record_.samples.push_back(std::move(sample));
  }

  void finish() {
    for (const DriftAccumulator& d : drift_) record_.drift.push_back(d.result());
    for (const DriftAccumulator& d : constraint_drift_) record_.constraints.push_back(d.result());
    std::vector<double> times, values;
    for (const Sample& sample : record_.samples)
      times.push_back(static_cast<double>(sample.t - run_.t0.quad()));
    for (std::size_t i = 0; i < constraint_drift_.size(); ++i) {
      values.clear();
      for (const Sample& sample : record_.samples)
        values.push_back(static_cast<double>(sample.constraints[i]));
      record_.growth.push_back(growth(times, values));
    }
  }

 private:
  static void worst(std::optional<double>& slot, double value) {
    if (!slot || value > *slot || std::isnan(value)) slot = value;
  }
  [[nodiscard]] Quad relative_error(const Sample& sample) const {
    const std::vector<Quad> exact = reference_->at(sample.t);
    Quad distance(0), norm(0);
    for (std::size_t k = 0; k < exact.size(); ++k) {
      const Quad d = sample.state[k] - exact[k];
      distance += d * d;
      norm += exact[k] * exact[k];
    }
    return sqrt(distance / norm);
  }

  const ResolvedRun& run_;
  const ReferenceSolution* reference_;
  RunRecord& record_;
  Problem<T> problem_;
  std::optional<StructureResidual<T>> residual_;
  ConstraintResiduals<T> constraints_;
  std::vector<T> values_, initial_, lowest_, residuals_;
  std::vector<DriftAccumulator> drift_, constraint_drift_;
};

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

// What a smaller step does at (t, z), where one of size h failed: the largest that still works, to a few
// percent.
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
void execute_fixed(const ResolvedRun& run, Observer<T>& observer, RunRecord& record,
                   const Progress& progress) {
  const auto stepper = run.method->stepper(run.model, T());
  std::vector<T> z;
  for (const Real& x : run.initial) z.push_back(T(x));
  const T t0(run.t0), h(run.step);
  const auto time = [&](std::int64_t k) { return t0 + T(static_cast<double>(k)) * h; };
  // Drift is watched at every step up to two million, evenly beyond that.
  const std::int64_t stride = std::min(run.every, std::max<std::int64_t>(1, run.steps / 2000000));
  const std::int64_t rows = run.steps / run.every + 1;
  const std::int64_t structure_rows = std::max<std::int64_t>(1, rows / 50);
  observer.observe(time(0), z, true, true);
  std::int64_t row = 0;
  for (std::int64_t k = 0; k < run.steps;) {
    const std::int64_t next_row = std::min(run.steps, (k / run.every + 1) * run.every);
    const std::int64_t count = std::min(stride, next_row - k);
    std::int64_t completed = 0;
    const Status status = stepper->advance(t0, k, h, count, z, completed);
    record.completed = k + completed;
    if (status != Status::converged) {
      record.status = status;
      const T reached = time(k + completed);
      record.message =
          failure(status, "at t = " + to_string(Quad(reached), 10)) + smaller_step(run, reached, h, z);
      break;
    }
    k += count;
    const bool keep = k % run.every == 0 || k == run.steps;
    if (keep) ++row;
    observer.observe(time(k), z, keep, keep && (row % structure_rows == 0 || k == run.steps));
    if (progress && keep) progress(static_cast<double>(k) / static_cast<double>(run.steps));
  }
  record.counters = stepper->counters();
}

// Samples at even times shorten steps. A run without any counts those that the method takes by itself; one
// sample in eight of them hardly matters.
int sample_intervals(const ResolvedRun& run) {
  const auto stepper = run.method->stepper(run.model, double());
  std::vector<double> z;
  for (const Real& x : run.initial) z.push_back(x.value());
  double t = run.t0.value();
  (void)stepper->advance_to(t, t + run.time.value(), run.tolerance.value(), z);
  return static_cast<int>(std::clamp<std::int64_t>(stepper->counters().steps / 8, 32, 200));
}

void execute_adaptive(const ResolvedRun& run, Observer<double>& observer, RunRecord& record,
                      const Progress& progress) {
  const int intervals = sample_intervals(run);
  const auto stepper = run.method->stepper(run.model, double());
  std::vector<double> z;
  for (const Real& x : run.initial) z.push_back(x.value());
  double t = run.t0.value();
  observer.observe(t, z, true, false);
  for (int k = 1; k <= intervals; ++k) {
    const double end = run.t0.value() + run.time.value() * k / intervals;
    const Status status = stepper->advance_to(t, end, run.tolerance.value(), z);
    if (status != Status::converged) {
      record.status = status;
      record.message = "the step control gave up at t = " + to_string(Quad(t), 10);
      break;
    }
    observer.observe(t, z, true, false);
    if (progress) progress(static_cast<double>(k) / intervals);
  }
  record.counters = stepper->counters();
  record.completed = record.counters.steps;
}

}  // namespace

RunRecord execute(const ResolvedRun& run, const ReferenceSolution* reference, const Progress& progress) {
  RunRecord record;
  if (run.settings.precision == Precision::quad) {
    Observer<Quad> observer(run, reference, record);
    execute_fixed(run, observer, record, progress);
    observer.finish();
  } else {
    Observer<double> observer(run, reference, record);
    if (run.adaptive()) {
      execute_adaptive(run, observer, record, progress);
    } else {
      execute_fixed(run, observer, record, progress);
    }
    observer.finish();
  }
  return record;
}

namespace {
template <class T>
StepTime time_in(const ResolvedRun& run, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto stepper = run.method->stepper(run.model, T());
  // Seconds a step over the first `count` steps, or over a tenth of a run that chooses its steps.
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
      (void)stepper->advance_to(t, end, T(run.tolerance), z);
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
