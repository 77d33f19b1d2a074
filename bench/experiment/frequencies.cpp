#include <pfaff/bench/experiment/frequencies.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include <pfaff/bench/runner/csv_cells.hpp>
#include <pfaff/bench/runner/parallel.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/core/text/scope.hpp>
#include <pfaff/runs/measure.hpp>

namespace pfaff {

namespace {

constexpr int largest_steps = 1000;
constexpr int looks_at_vectors = 4000;
constexpr double largest_turn = 2 * std::numbers::pi / 3;  // between two looks
constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

// The vectors of a case at a state, one after the other.
class VectorTracks {
 public:
  explicit VectorTracks(const ExperimentRun& run) {
    for (const FrequencyVector& vector : run.which->frequencies)
      replays_.emplace_back(vector_tape(vector, *run.resolved.model));
  }
  void append(double t, const std::vector<double>& z, std::vector<std::vector<TurningVector>>& tracks) {
    tracks.resize(replays_.size());
    for (std::size_t k = 0; k < replays_.size(); ++k) {
      std::array<double, 2> components{};
      replays_[k](t, z.data(), components.data());
      tracks[k].push_back({components[0], components[1]});
    }
  }

 private:
  std::vector<Replay<double>> replays_;
};

// What the runs of one problem are compared with, and for how long.
struct ComparedMotion {
  Real time;
  std::unique_ptr<ReferenceSolution> solution;
};

bool has_frequencies(const ExperimentRun& run) {
  return run.seed == 0 && !run.resolved.adaptive() && !run.which->frequencies.empty();
}

}  // namespace

std::shared_ptr<const Tape> vector_tape(const FrequencyVector& vector, const Model& model) {
  Recorder recorder(static_cast<int>(model.dimension()));
  text::Scope scope;
  scope.define("t", recorder.time());
  for (const auto& [name, value] : model.parameters())
    if (const auto number = Real::parse(value)) scope.define(name, Recorded(*number));
  const std::vector<Recorded> inputs = recorder.inputs();
  for (std::size_t k = 0; k < inputs.size(); ++k) scope.define(model.coordinates()[k].name, inputs[k]);
  const std::string where = "frequency '" + vector.name + "', component ";
  for (const auto& [name, expression] : vector.definitions)
    scope.define(name, text::Expression({expression, "frequency '" + vector.name + "', '" + name + "'"}));
  const std::vector<Recorded> components{scope.evaluate(text::Expression({vector.x, where + "x"})),
                                         scope.evaluate(text::Expression({vector.y, where + "y"}))};
  return std::make_shared<const Tape>(recorder.finish(components));
}

Real time_of_frequencies(const std::vector<const ExperimentRun*>& of_case) {
  const ExperimentRun& largest =
      **std::max_element(of_case.begin(), of_case.end(), [](const ExperimentRun* a, const ExperimentRun* b) {
        return std::abs(a->resolved.step.value()) < std::abs(b->resolved.step.value());
      });
  const Real some = Real(largest_steps) * largest.resolved.step;
  return std::abs(some.value()) < std::abs(largest.resolved.time.value()) ? some : largest.resolved.time;
}

std::vector<FoundFrequency> frequencies_of(const ExperimentRun& run, const ReferenceSolution& solution,
                                           const Real& time) {
  const ResolvedRun& resolved = run.resolved;
  const double h = resolved.step.value(), t0 = resolved.t0.value();
  const auto steps = static_cast<std::int64_t>(time.value() / h * (1 + 1e-12));
  VectorTracks vectors(run);
  std::vector<double> times;
  std::vector<std::vector<TurningVector>> of_method, of_solution;
  Integration<double> carried(start_of<double>(resolved));
  for (const std::int64_t step : evenly(steps, looks_at_vectors)) {
    const Quad at = resolved.t0.quad() + Quad(static_cast<double>(step)) * resolved.step.quad();
    if (!carried_to(step, carried) || !solution.covers(at)) break;
    const double elapsed = static_cast<double>(step) * h;
    times.push_back(elapsed);
    vectors.append(t0 + elapsed, {carried.state().begin(), carried.state().end()}, of_method);
    std::vector<double> exact;
    for (const Quad& x : solution.at(at)) exact.push_back(static_cast<double>(x));
    vectors.append(t0 + elapsed, exact, of_solution);
  }
  const bool whole = !times.empty() && times.back() / h >= static_cast<double>(steps) * (1 - 1e-9);
  std::vector<FoundFrequency> found;
  for (std::size_t k = 0; k < of_method.size(); ++k) {
    const std::vector<double> angles = angles_of(of_solution[k]);
    bool followed = whole;
    for (std::size_t i = 1; i < angles.size(); ++i)
      followed = followed && std::abs(angles[i] - angles[i - 1]) <= largest_turn;
    const TurningRate error = turning_rate(times, angles_ahead(of_method[k], of_solution[k]));
    found.push_back(followed ? FoundFrequency{turning_rate(times, angles).rate, error.rate, error.change}
                             : FoundFrequency{undefined, undefined, undefined});
  }
  return found;
}

std::string frequencies_csv(const std::vector<ExperimentRun>& runs,
                            const std::vector<nlohmann::json>& summaries) {
  std::vector<const ExperimentRun*> compared;
  for (std::size_t k = 0; k < runs.size(); ++k)
    if (has_frequencies(runs[k]) && summaries[k]["status"] == "converged") compared.push_back(&runs[k]);
  std::map<ProblemKey, ComparedMotion> problems;
  for (const ExperimentRun* run : compared) {
    ComparedMotion& problem = problems[problem_of(*run)];
    if (problem.solution != nullptr) continue;
    std::vector<const ExperimentRun*> of_case;
    for (const ExperimentRun* other : compared)
      if (other->which == run->which) of_case.push_back(other);
    ResolvedRun shorter = run->resolved;
    shorter.time = problem.time = time_of_frequencies(of_case);
    problem.solution = reference_of(shorter);
  }
  std::vector<std::string> rows(compared.size());
  in_parallel(compared.size(), [&](std::size_t m) {
    const ExperimentRun& run = *compared[m];
    const ComparedMotion& problem = problems.at(problem_of(run));
    const std::vector<FoundFrequency> found = frequencies_of(run, *problem.solution, problem.time);
    for (std::size_t k = 0; k < found.size(); ++k)
      rows[m] += csv_quoted(run.which->name) + "," + csv_quoted(run.method->label) + "," +
                 csv_quoted(run.step) + "," + csv_quoted(run.which->frequencies[k].name) + "," +
                 formatted("%.12g", found[k].of_reference) + "," + formatted("%.6g", found[k].error) + "," +
                 formatted("%.3g", found[k].change) + "\n";
  });
  std::string text;
  for (const std::string& row : rows) text += row;
  return text.empty() ? "" : "case,method,step,vector,frequency,error,change\n" + text;
}

}  // namespace pfaff
