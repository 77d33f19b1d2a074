// The terminal's table of an experiment.
#include <algorithm>
#include <cmath>

#include <pfaff/bench/experiment/costs.hpp>
#include <pfaff/bench/experiment/error_measure.hpp>
#include <pfaff/bench/experiment/experiment_findings.hpp>
#include <pfaff/bench/experiment/results.hpp>
#include <pfaff/bench/runner/csv_cells.hpp>
#include <pfaff/bench/runner/text_table.hpp>
#include <pfaff/core/numbers/formatted.hpp>
#include <pfaff/runs/support/constraints.hpp>

namespace pfaff {

namespace fs = std::filesystem;

namespace {
std::string scientific(const nlohmann::json& value) {
  return value.is_null() ? "-" : formatted("%.1e", value.get<double>());
}

// A step or a time of a table. Formulas such as 2*pi/20 have as many digits as quad has, of which six are
// shown.
std::string shown(const std::string& number) {
  const auto value = Real::parse(number);
  return number.size() <= 10 || !value ? number : to_string(value->quad(), 6);
}

// True for an invariant whose drift is classed as growing although its slope is less, per step, than one unit
// of round-off of what steps propagate; of the sum of its terms where that is not known.
bool below_round_off(const nlohmann::json& invariant, const nlohmann::json& summary) {
  if (!drift_class_named(invariant["class"].get<std::string>()).grows) return false;
  if (!summary.contains("step")) return false;
  const auto text = [](const nlohmann::json& x) { return x.is_string() ? x.get<std::string>() : x.dump(); };
  const auto step = Real::parse(text(summary["step"]));
  const double unit = summary["precision"] == "quad" ? 9.6e-35 : 1.1e-16;
  const bool known = invariant.contains("propagated") && invariant["propagated"].is_number();
  const double size = invariant[known ? "propagated" : "scale"].get<double>();
  return step && std::abs(invariant["slope"].get<double>() * step->value()) < unit * size;
}

// The runs of one case, their summaries, and what their steps cost.
struct Runs {
  const ExperimentCase& which;
  const std::vector<ExperimentRun>& runs;
  const std::vector<nlohmann::json>& summaries;
  const Costs& costs;
  bool marked = false;

  [[nodiscard]] std::string size_of(const ExperimentRun& run) const {
    return run.tolerance.empty() ? shown(run.step) : "~" + run.tolerance;
  }
  [[nodiscard]] std::string cost(const ExperimentRun& run) const {
    const auto nanoseconds = cost_of(run, costs, runs);
    return nanoseconds ? formatted("%.0f", *nanoseconds) : "-";
  }

  [[nodiscard]] std::vector<std::string> drift(const nlohmann::json& summary);
  [[nodiscard]] std::string motion(bool restricted);
  [[nodiscard]] std::string ensemble() const;
};

// What became of the invariant that is shown: size, slope and class, with a mark at a trend below round-off.
std::vector<std::string> Runs::drift(const nlohmann::json& summary) {
  for (const nlohmann::json& i : summary["invariants"]) {
    if (i["name"] != which.conserved) continue;
    if (i.contains("max")) {
      const bool mark = below_round_off(i, summary);
      marked = marked || mark;
      return {scientific(i["max"]), formatted("%+.1e", i["slope"].get<double>()),
              i["class"].get<std::string>() + (mark ? "*" : "")};
    }
    if (const auto setback = setback_in(i))
      return {setback->size == 0.0 ? "0" : scientific(setback->size), "-",
              setback->size == 0.0 ? "never " + setback->move + "s" : "largest " + setback->move};
  }
  return {"-", "-", "-"};
}

// The residual of a level of constraints, and the exponent of time with which it grows; dashes where the
// motion of a run has no such level.
std::vector<std::string> residual(const nlohmann::json& summary, std::size_t level) {
  if (!summary.contains("constraints") || summary["constraints"].size() <= level) return {"-", "-"};
  const nlohmann::json& c = summary["constraints"][level];
  return {scientific(c["max"]), c["growth"].is_null() ? "-" : formatted("%.1f", c["growth"].get<double>())};
}

// A row for each run. `restricted` where systems have constraints: then the residuals of these take the place
// of slope and structure. Why runs ended early stands below.
std::string Runs::motion(bool restricted) {
  TableRows rows{{"method", "h", "error"}};
  const auto add = [&](std::vector<std::string>& row, const std::vector<std::string>& cells) {
    row.insert(row.end(), cells.begin(), cells.end());
  };
  add(rows[0], restricted ? std::vector<std::string>{"drift", "class", "constraints", "~t^", "hidden", "~t^"}
                          : std::vector<std::string>{"final", "drift", "slope", "class", "structure"});
  rows[0].emplace_back("ns/step");
  std::string failures;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (runs[k].which != &which) continue;
    const nlohmann::json& s = summaries[k];
    rows.push_back({runs[k].method->label, size_of(runs[k])});
    std::vector<std::string>& row = rows.back();
    if (s["status"] != "converged") {
      const std::string status = s["status"];
      add(row, restricted ? std::vector<std::string>{"-", "-", status, "-", "-", "-", "-", "-"}
                          : std::vector<std::string>{"-", "-", "-", "-", status, "-", "-"});
      failures += paragraph(runs[k].method->label + " at h = " + size_of(runs[k]) +
                            " ended early: " + s["message"].get<std::string>());
      continue;
    }
    const std::vector<std::string> found = drift(s);
    add(row, {which.error.empty() ? scientific(s["error_max"]) : formatted("%.1e", error_of(which, s))});
    if (restricted) {
      add(row, {found[0], found[2]});
      add(row, residual(s, 0));
      add(row, residual(s, 1));
    } else {
      add(row, {which.error.empty() ? scientific(s["error_final"]) : "-"});
      add(row, found);
      add(row, {scientific(s["structure_residual"])});
    }
    add(row, {cost(runs[k])});
  }
  return table(rows, restricted ? std::vector<std::string>{"~t^", "hidden"}
                                : std::vector<std::string>{"final", "slope", "structure"}) +
         failures;
}

// Medians and ranges over the seeds, a column for each measure.
std::string Runs::ensemble() const {
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
  heads.resize(measures.size());
  TableRows rows{{"method", "h"}}, growing{{"method", "h"}};
  rows[0].insert(rows[0].end(), heads.begin(), heads.end());
  rows[0].emplace_back("ns/step");
  growing[0].insert(growing[0].end(), levels.begin(), levels.end());
  std::size_t lost = 0;
  for (const ExperimentRun& run : runs) {
    if (run.which != &which || run.seed != 1) continue;
    rows.push_back({run.method->label, size_of(run)});
    growing.push_back(rows.back());
    for (const std::string& measure : measures) {
      const Spread s = spread_over_seeds(run, measure, runs, summaries);
      lost += &measure == &measures.front() ? s.runs - s.finished : 0;
      rows.back().push_back(s.measured == 0 ? "-" : formatted("%.1e (%.0e..%.0e)", s.median, s.low, s.high));
    }
    rows.back().push_back(cost(run));
    for (const std::string& level : levels) {
      const Spread s = spread_over_seeds(run, level + ":growth", runs, summaries);
      growing.back().push_back(s.measured == 0 ? "-"
                                               : formatted("%.2f (%.2f..%.2f)", s.median, s.low, s.high));
    }
  }
  std::string text = table(rows) + "median and range over " + std::to_string(which.seeds) + " seeds" +
                     (lost > 0 ? "; " + std::to_string(lost) + " runs ended early" : "") + '\n';
  if (!levels.empty())
    text += '\n' + paragraph("growth of the largest residual so far, as a power of time") + table(growing);
  return text;
}
}  // namespace

std::string results_table(const fs::path& directory, const Experiment& experiment,
                          const std::vector<ExperimentRun>& runs,
                          const std::vector<nlohmann::json>& summaries) {
  const Costs costs = read_costs(directory / costs_file, runs);
  std::string text;
  bool marked = false;
  for (const ExperimentCase& c : experiment.cases) {
    Runs of_case{c, runs, summaries, costs};
    const auto run =
        std::find_if(runs.begin(), runs.end(), [&](const ExperimentRun& r) { return r.which == &c; });
    const bool restricted = std::any_of(runs.begin(), runs.end(), [&](const ExperimentRun& r) {
      return r.which == &c && r.resolved.model->restricted();
    });
    text += '\n' +
            paragraph(c.title + " (" + system_name(*run) + ", T = " + shown(to_string(run->resolved.time)) +
                      (c.seeds > 0 ? ", " + std::to_string(c.seeds) + " seeds" : "") + ")" +
                      (c.seeds > 0 || c.conserved.empty() ? "" : ", drift of " + c.conserved) +
                      (c.error.empty() ? "" : ", error: largest relative drift of " + c.error));
    text += c.seeds > 0 ? of_case.ensemble() : of_case.motion(restricted);
    marked = marked || of_case.marked;
  }
  if (marked) text += "\n* slower than one unit of round-off a step\n";
  if (std::any_of(runs.begin(), runs.end(), [](const ExperimentRun& r) { return !r.tolerance.empty(); }))
    text += "\n~ tolerance of a method that chooses its steps\n";
  return text;
}

}  // namespace pfaff
