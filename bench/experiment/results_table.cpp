// The terminal's table of an experiment, at most 100 columns.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <sstream>

#include <pfaff/bench/experiment/cells.hpp>
#include <pfaff/bench/experiment/costs.hpp>
#include <pfaff/bench/experiment/experiment_findings.hpp>
#include <pfaff/bench/experiment/results.hpp>
#include <pfaff/bench/measure/constraints.hpp>

namespace pfaff {

namespace fs = std::filesystem;

namespace {
template <class... A>
std::string formatted(const char* format, A... arguments) {
  std::array<char, 200> line{};
  std::snprintf(line.data(), line.size(), format, arguments...);
  return line.data();
}

std::string scientific(const nlohmann::json& value) {
  return value.is_null() ? "-" : as_text(value.get<double>(), "%.1e");
}

// True for an invariant whose drift is classed as growing although its slope is less, per step, than one unit
// of round-off of the invariant's initial value.
bool below_round_off(const nlohmann::json& invariant, const nlohmann::json& summary) {
  if (!drift_class_named(invariant["class"].get<std::string>()).grows) return false;
  if (!summary.contains("step")) return false;
  const auto text = [](const nlohmann::json& x) { return x.is_string() ? x.get<std::string>() : x.dump(); };
  const auto initial = Real::parse(text(invariant["initial"])), step = Real::parse(text(summary["step"]));
  const double unit = summary["precision"] == "quad" ? 9.6e-35 : 1.1e-16;
  return initial && step &&
         std::abs(invariant["slope"].get<double>() * step->value()) < unit * std::abs(initial->value());
}

// The runs of one case, their summaries, and what their steps cost.
struct Rows {
  const ExperimentCase& which;
  const std::vector<ExperimentRun>& runs;
  const std::vector<nlohmann::json>& summaries;
  const Costs& costs;
  bool marked = false;

  [[nodiscard]] std::string size_of(const ExperimentRun& run) const {
    return run.tolerance.empty() ? run.step : "~" + run.tolerance;
  }
  [[nodiscard]] std::string cost(const ExperimentRun& run) const {
    const auto nanoseconds = cost_of(run, costs, runs);
    return nanoseconds ? as_text(*nanoseconds, "%.0f") : "-";
  }
  void failure(std::ostream& text, const ExperimentRun& run, const nlohmann::json& s) const {
    text << formatted("%-16.16s %6s  %s: %.60s\n", run.method->label.c_str(), size_of(run).c_str(),
                      s["status"].get<std::string>().c_str(), s["message"].get<std::string>().c_str());
  }

  void free_motion(std::ostream& text);
  void constrained_motion(std::ostream& text);
  void ensemble(std::ostream& text) const;
};

void Rows::free_motion(std::ostream& text) {
  const std::string drift = which.conserved.empty() ? "drift" : "drift of " + which.conserved;
  text << formatted("%-23s %19s  %-34s %9s %9s\n", "", "error", drift.c_str(), "structure", "cost");
  text << formatted("%-16s %6s %9s %9s  %-9s %-10s %-13s %9s %9s\n", "method", "h", "max", "final", "max",
                    "slope", "class", "residual", "ns/step");
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (runs[k].which != &which) continue;
    const nlohmann::json& s = summaries[k];
    if (s["status"] != "converged") {
      failure(text, runs[k], s);
      continue;
    }
    std::string shown = "-";
    for (const nlohmann::json& i : s["invariants"])
      if (i["name"] == which.conserved && i.contains("max")) {
        const bool mark = below_round_off(i, s);
        marked = marked || mark;
        shown = scientific(i["max"]) + "   " + as_text(i["slope"].get<double>(), "%+.1e") + "   " +
                i["class"].get<std::string>() + (mark ? "*" : "");
      } else if (const auto setback = setback_in(i); i["name"] == which.conserved && setback) {
        shown = setback->size == 0.0 ? "never " + setback->move + "s"
                                     : "largest " + setback->move + " " + scientific(setback->size);
      }
    text << formatted("%-16.16s %6s %9s %9s  %-34s %9s %9s\n", runs[k].method->label.c_str(),
                      size_of(runs[k]).c_str(), scientific(s["error_max"]).c_str(),
                      scientific(s["error_final"]).c_str(), shown.c_str(),
                      scientific(s["structure_residual"]).c_str(), cost(runs[k]).c_str());
  }
}

// The residual of a level of constraints, and the exponent of time with which it grows; dashes where the
// motion of a run has no such level.
std::string residual(const nlohmann::json& summary, std::size_t level) {
  if (!summary.contains("constraints") || summary["constraints"].size() <= level)
    return formatted("%8s %5s", "-", "-");
  const nlohmann::json& c = summary["constraints"][level];
  return formatted("%8s %5s", scientific(c["max"]).c_str(),
                   c["growth"].is_null() ? "-" : as_text(c["growth"].get<double>(), "%.1f").c_str());
}

void Rows::constrained_motion(std::ostream& text) {
  const std::string drift = which.conserved.empty() ? "drift" : "drift of " + which.conserved;
  text << formatted("%-25s %8s %-21.21s %14s %14s %9s\n", "", "error", drift.c_str(), "constraints",
                    "hidden ones", "cost");
  text << formatted("%-16s %8s %8s %8s %-12s %8s %5s %8s %5s %9s\n", "method", "h", "max", "max", "class",
                    "max", "~t^", "max", "~t^", "ns/step");
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (runs[k].which != &which) continue;
    const nlohmann::json& s = summaries[k];
    if (s["status"] != "converged") {
      failure(text, runs[k], s);
      continue;
    }
    std::string largest = "-", kind = "-";
    for (const nlohmann::json& i : s["invariants"])
      if (i["name"] == which.conserved && i.contains("max")) {
        const bool mark = below_round_off(i, s);
        marked = marked || mark;
        largest = scientific(i["max"]);
        kind = i["class"].get<std::string>() + (mark ? "*" : "");
      } else if (const auto setback = setback_in(i); i["name"] == which.conserved && setback) {
        largest = scientific(setback->size);
        kind = "largest " + setback->move;
      }
    text << formatted("%-16.16s %8s %8s %8s %-12s %s %s %9s\n", runs[k].method->label.c_str(),
                      size_of(runs[k]).c_str(), scientific(s["error_max"]).c_str(), largest.c_str(),
                      kind.c_str(), residual(s, 0).c_str(), residual(s, 1).c_str(), cost(runs[k]).c_str());
  }
}

// Medians and ranges over the seeds, a column of 22 characters for each measure.
void Rows::ensemble(std::ostream& text) const {
  std::vector<std::string> measures, heads, levels;
  for (const ExperimentRun& run : runs)
    if (run.which == &which && run.resolved.model->restricted())
      levels = constraint_residual_names(*run.resolved.model);
  if (!which.conserved.empty()) {
    measures.push_back(which.conserved + ":max");
    heads.push_back("drift of " + which.conserved);
  } else if (which.reference) {
    measures.emplace_back("error_max");
    heads.emplace_back("largest error");
  }
  for (const std::string& level : levels) {
    measures.push_back(level + ":max");
    heads.push_back(level);
  }
  measures.resize(std::min<std::size_t>(measures.size(), 3));
  text << formatted("%-14s %6s", "method", "h");
  for (std::size_t k = 0; k < measures.size(); ++k) text << formatted(" %-22.22s", heads[k].c_str());
  text << formatted(" %8s\n", "ns/step");
  std::size_t lost = 0;
  std::ostringstream growing;
  for (const ExperimentRun& run : runs) {
    if (run.which != &which || run.seed != 1) continue;
    text << formatted("%-14.14s %6s", run.method->label.c_str(), size_of(run).c_str());
    for (const std::string& measure : measures) {
      const Spread s = spread_over_seeds(run, measure, runs, summaries);
      lost += &measure == &measures.front() ? s.runs - s.finished : 0;
      text << formatted(
          " %-22s", s.measured == 0 ? "-" : formatted("%.1e (%.0e..%.0e)", s.median, s.low, s.high).c_str());
    }
    text << formatted(" %8s\n", cost(run).c_str());
    for (const std::string& level : levels) {
      const Spread s = spread_over_seeds(run, level + ":growth", runs, summaries);
      if (&level == &levels.front())
        growing << formatted("%-14.14s %6s", run.method->label.c_str(), size_of(run).c_str());
      growing << formatted(
          "  %-22s", s.measured == 0 ? "-" : formatted("%.2f (%.2f..%.2f)", s.median, s.low, s.high).c_str());
      if (&level == &levels.back()) growing << '\n';
    }
  }
  text << "median and range over " << which.seeds << " seeds";
  if (lost > 0) text << "; " << lost << " runs ended early";
  text << '\n';
  if (levels.empty()) return;
  text << "\ngrowth of the largest residual so far, as a power of time\n"
       << formatted("%-14s %6s", "method", "h");
  for (const std::string& level : levels) text << formatted("  %-22s", level.c_str());
  text << '\n' << growing.str();
}
}  // namespace

std::string results_table(const fs::path& directory, const Experiment& experiment,
                          const std::vector<ExperimentRun>& runs,
                          const std::vector<nlohmann::json>& summaries) {
  const Costs costs = read_costs(directory / "cost.csv", runs);
  std::ostringstream text;
  bool marked = false;
  for (const ExperimentCase& c : experiment.cases) {
    Rows rows{c, runs, summaries, costs};
    const auto run =
        std::find_if(runs.begin(), runs.end(), [&](const ExperimentRun& r) { return r.which == &c; });
    const bool restricted = std::any_of(runs.begin(), runs.end(), [&](const ExperimentRun& r) {
      return r.which == &c && r.resolved.model->restricted();
    });
    text << '\n'
         << c.title << "  (" << c.system << ", T = " << to_string(run->resolved.time)
         << (c.seeds > 0 ? ", " + std::to_string(c.seeds) + " seeds" : "") << ")\n";
    if (c.seeds > 0) {
      rows.ensemble(text);
    } else if (restricted) {
      rows.constrained_motion(text);
    } else {
      rows.free_motion(text);
    }
    marked = marked || rows.marked;
  }
  if (marked) text << "\n* slower than one unit of round-off a step\n";
  if (std::any_of(runs.begin(), runs.end(), [](const ExperimentRun& r) { return !r.tolerance.empty(); }))
    text << "\n~ tolerance of a method that chooses its steps\n";
  return text.str();
}

}  // namespace pfaff
