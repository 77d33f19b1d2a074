#include <pfaff/bench/experiment/equal_cost.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include <pfaff/bench/experiment/costs.hpp>
#include <pfaff/bench/experiment/error_measure.hpp>
#include <pfaff/bench/experiment/results.hpp>
#include <pfaff/bench/runner/config_file.hpp>
#include <pfaff/bench/runner/csv_cells.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/bench/runner/parallel.hpp>
#include <pfaff/bench/runner/run_directory.hpp>
#include <pfaff/core/process/checksum.hpp>

namespace pfaff {

namespace fs = std::filesystem;

namespace {

constexpr double target = 1e-6;
constexpr const char* made_in = "equal-cost";

// The least cost of the error `target`, straight between neighbouring runs in logarithms; infinite if never.
double cost_of_target(const PricedRuns& runs) {
  double least = std::numeric_limits<double>::infinity();
  if (!runs.empty() && runs.front().error <= target) return runs.front().cost;
  for (std::size_t k = 1; k < runs.size(); ++k) {
    const PricedRun &coarse = runs[k - 1], &fine = runs[k];
    if (!(coarse.error > target && target >= fine.error)) continue;
    if (!(fine.error > 0)) return fine.cost;
    const double part = std::log(coarse.error / target) / std::log(coarse.error / fine.error);
    least = std::min(least, std::pow(coarse.cost, 1 - part) * std::pow(fine.cost, part));
  }
  return least;
}

double size_of(const ExperimentRun& run) {
  return std::abs((run.tolerance.empty() ? run.resolved.step : run.resolved.tolerance).value());
}

// A step that divides the duration into whole steps, with digits enough to be read as such.
std::string step_text(const ExperimentRun& like, double step) {
  const double time = std::abs(like.resolved.time.value());
  return formatted("%.12g", time / std::max(1.0, std::round(time / step)));
}

struct Chosen {
  double level = 0;
  ExperimentRun run;
};

// The runs that a case needs at equal cost.
std::vector<Chosen> chosen_runs(const Experiment& experiment, const ExperimentCase& one,
                                const std::vector<ExperimentRun>& runs,
                                const std::vector<nlohmann::json>& summaries, const Costs& costs) {
  std::vector<PricedRuns> priced;
  std::vector<const ExperimentRun*> first;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const ExperimentRun& run = runs[k];
    const auto ns = cost_of(run, costs, runs, Repetition::fastest);
    if (run.which != &one || run.seed > 0 || !ns || summaries[k]["status"] != "converged") continue;
    if (first.empty() || first.back()->method != run.method) {
      first.push_back(&run);
      priced.emplace_back();
    }
    priced.back().push_back(
        {size_of(run), *ns * summaries[k]["completed"].get<double>(), error_of(one, summaries[k])});
  }
  for (PricedRuns& method : priced) settle(method);
  std::vector<Chosen> chosen;
  const double level = cost_level(priced);
  for (std::size_t m = 0; level > 0 && m < priced.size(); ++m) {
    const double size = size_at_cost(priced[m], level);
    if (size > 0)
      chosen.push_back({level, at_size(experiment, *first[m],
                                       first[m]->tolerance.empty() ? step_text(*first[m], size)
                                                                   : formatted("%.6g", size))});
  }
  return chosen;
}

}  // namespace

void settle(PricedRuns& runs) {
  std::sort(runs.begin(), runs.end(), [](const PricedRun& a, const PricedRun& b) { return a.size > b.size; });
  for (std::size_t k = runs.size(); k-- > 1;) runs[k - 1].cost = std::min(runs[k - 1].cost, runs[k].cost);
}

double cost_level(const std::vector<PricedRuns>& methods) {
  double low = std::numeric_limits<double>::infinity(), high = 0, goal = low;
  for (const PricedRuns& runs : methods) {
    if (runs.empty()) continue;
    low = std::min(low, runs.front().cost);
    high = std::max(high, runs.back().cost);
    goal = std::min(goal, cost_of_target(runs));
  }
  if (!(low > 0) || !(high >= low)) return 0;
  if (!std::isfinite(goal)) goal = std::sqrt(low * high);
  double best = 0;
  std::size_t most = 1;
  for (double power = std::floor(std::log10(low)); power <= std::ceil(std::log10(high)); ++power)
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double level = digit * std::pow(10, power);
      const auto spans =
          std::size_t(std::count_if(methods.begin(), methods.end(), [&](const PricedRuns& runs) {
            return !runs.empty() && runs.front().cost <= level && level <= runs.back().cost;
          }));
      const bool nearer = best > 0 && std::abs(std::log(level / goal)) < std::abs(std::log(best / goal));
      if (spans > most || (spans == most && nearer)) {
        best = level;
        most = spans;
      }
    }
  return best;
}

double size_at_cost(const PricedRuns& runs, double level) {
  for (std::size_t k = 1; k < runs.size(); ++k) {
    const PricedRun &coarse = runs[k - 1], &fine = runs[k];
    if (coarse.cost > level || level > fine.cost || !(coarse.cost < fine.cost)) continue;
    const double part = std::log(level / coarse.cost) / std::log(fine.cost / coarse.cost);
    return std::pow(coarse.size, 1 - part) * std::pow(fine.size, part);
  }
  return 0;
}

void tell_apart(std::vector<ExperimentRun>& runs) {
  std::vector<std::string> settings;
  std::map<std::string, std::set<std::string>> sharing;
  for (const ExperimentRun& run : runs) {
    settings.push_back(settings_text(run.resolved));
    sharing[run.slug].insert(settings.back());
  }
  constexpr std::size_t digits = 10;
  for (std::size_t k = 0; k < runs.size(); ++k)
    if (sharing.at(runs[k].slug).size() > 1) runs[k].slug += "-" + sha1_of(settings[k]).substr(0, digits);
}

Columns equal_cost_columns(const std::vector<ExperimentRun>& runs) {
  Columns columns = results_columns(runs);
  columns.insert(columns.begin(), {"level_ns", "ns"});
  return columns;
}

void write_equal_cost(const fs::path& directory, const Experiment& experiment,
                      const std::vector<ExperimentRun>& runs, const std::vector<nlohmann::json>& summaries,
                      References& references, const ExperimentProgress& progress) {
  const Costs costs = read_costs(directory / costs_file, runs);
  std::vector<Chosen> chosen;
  for (const ExperimentCase& one : experiment.cases)
    for (Chosen& c : chosen_runs(experiment, one, runs, summaries, costs)) chosen.push_back(std::move(c));
  std::vector<const ExperimentRun*> open;
  std::vector<ExperimentRun> all;
  for (const Chosen& c : chosen) all.push_back(c.run);
  tell_apart(all);
  std::set<std::string> seen;
  for (const ExperimentRun& run : all)
    if (seen.insert(run.slug).second && !kept_run(directory / made_in / run.slug, run.resolved).current())
      open.push_back(&run);
  std::error_code error;
  fs::create_directories(directory / made_in, error);
  if (progress && !open.empty()) progress({2, "runs at equal cost", 0, open.size()});
  in_parallel(open.size(), [&](std::size_t k) {
    const ExperimentRun& run = *open[k];
    if (!make_run(directory / made_in / run.slug, run.resolved, references.of(run))) spend(0, 0);
  });
  const fs::path path = directory / equal_cost_file;
  if (all.empty()) {
    fs::remove(path, error);
    return;
  }
  std::istringstream lines(results_csv(all, read_summaries(directory, all, made_in), runs));
  std::string text = head_of(equal_cost_columns(runs)) + "\n", line;
  std::getline(lines, line);
  for (std::size_t k = 0; std::getline(lines, line); ++k)
    text += formatted("%.6g", chosen[k].level) + "," + line + "\n";
  write_file(path, text);
}

}  // namespace pfaff
