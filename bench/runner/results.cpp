#include <pfaff/bench/runner/results.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <sstream>

#include <sys/wait.h>

#include <pfaff/bench/runner/files.hpp>

namespace pfaff {

namespace fs = std::filesystem;

namespace {
std::string number(double x, const char* format = "%.17g") {
  std::array<char, 40> text{};
  const int length = std::snprintf(text.data(), text.size(), format, x);
  return {text.data(), static_cast<std::size_t>(length)};
}
std::string cell(const nlohmann::json& value) {
  if (value.is_null()) return {};
  if (value.is_string()) return value.get<std::string>();
  return number(value.get<double>());
}
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + '"';
}
std::string parameters_of(const ExperimentRun& run) {
  std::string text;
  for (const auto& [key, value] : run.resolved.method->parameters())
    text += (text.empty() ? "" : " ") + key + "=" + value;
  return text;
}

// cost.csv is keyed by run; times are comparable only within one machine and build.
struct CostRow {
  std::string text;
  double median = 0;
};
std::string cost_key(const ExperimentRun& run) {
  return quoted(run.which->name) + "," + quoted(run.method->label) + "," + quoted(run.step);
}

// Rows of the runs asked for.
std::map<std::string, CostRow> read_costs(const fs::path& path, const std::vector<ExperimentRun>& runs) {
  std::map<std::string, CostRow> rows;
  std::error_code error;
  if (!fs::exists(path, error)) return rows;
  std::istringstream stream(read_file(path));
  std::string line;
  std::getline(stream, line);
  while (std::getline(stream, line))
    for (const ExperimentRun& run : runs)
      if (const std::string key = cost_key(run); line.starts_with(key + ","))
        rows[key] = {line, std::atof(line.c_str() + key.size() + 1)};
  return rows;
}
std::string costs_csv(const std::vector<ExperimentRun>& runs, const std::map<std::string, CostRow>& rows) {
  std::string text = "case,method,step,ns_per_step,ns_per_step_min,ns_per_step_max,repetitions,seconds\n";
  for (const ExperimentRun& run : runs)
    if (const auto row = rows.find(cost_key(run)); row != rows.end()) text += row->second.text + "\n";
  return text;
}
}  // namespace

std::vector<nlohmann::json> read_summaries(const fs::path& directory,
                                           const std::vector<ExperimentRun>& runs) {
  std::vector<nlohmann::json> summaries;
  for (const ExperimentRun& run : runs)
    summaries.push_back(nlohmann::json::parse(read_file(directory / "runs" / run.slug / "summary.json")));
  return summaries;
}

std::string results_csv(const std::vector<ExperimentRun>& runs,
                        const std::vector<nlohmann::json>& summaries) {
  std::vector<std::string> invariants;
  for (const nlohmann::json& s : summaries)
    for (const nlohmann::json& i : s["invariants"])
      if (i["expected"] != "free" &&
          std::find(invariants.begin(), invariants.end(), i["name"]) == invariants.end())
        invariants.push_back(i["name"]);
  std::ostringstream text;
  text << "case,system,method,integrator,parameters,step,time,steps,precision,status,message,error_max,error_"
          "final,"
          "structure_residual,rhs_per_step,jacobians_per_step,iterations_per_step,factorisations_per_step";
  for (const std::string& name : invariants)
    for (const char* m :
         {"max", "rms", "final", "slope", "slope_low", "slope_high", "oscillation", "exponent", "class"})
      text << ',' << name << ':' << m;
  text << ",run\n";
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const ExperimentRun& run = runs[k];
    const nlohmann::json& s = summaries[k];
    const double steps = std::max(1.0, s["counts"]["steps"].get<double>());
    text << quoted(run.which->name) << ',' << run.which->system << ',' << quoted(run.method->label) << ','
         << run.method->integrator << ',' << quoted(parameters_of(run)) << ',' << quoted(run.step) << ','
         << to_string(run.resolved.time) << ',' << s["completed"] << ',' << s["precision"].get<std::string>()
         << ',' << s["status"].get<std::string>() << ',' << quoted(s["message"]) << ','
         << cell(s["error_max"]) << ',' << cell(s["error_final"]) << ',' << cell(s["structure_residual"]);
    for (const char* count : {"right_hand_sides", "jacobians", "iterations", "factorisations"})
      text << ',' << number(s["counts"][count].get<double>() / steps, "%.6g");
    for (const std::string& name : invariants) {
      const nlohmann::json* found = nullptr;
      for (const nlohmann::json& i : s["invariants"])
        if (i["name"] == name && i.contains("max")) found = &i;
      for (const char* m : {"max", "rms", "final", "slope"}) text << ',' << (found ? cell((*found)[m]) : "");
      text << ',' << (found ? cell((*found)["slope_interval"][0]) : "") << ','
           << (found ? cell((*found)["slope_interval"][1]) : "");
      for (const char* m : {"oscillation", "exponent", "class"})
        text << ',' << (found ? cell((*found)[m]) : "");
    }
    text << ',' << run.slug << '\n';
  }
  return text.str();
}

void write_costs(const fs::path& directory, const Experiment& experiment,
                 const std::vector<ExperimentRun>& runs, const ExperimentProgress& progress) {
  const fs::path path = directory / "cost.csv";
  auto rows = read_costs(path, runs);
  std::size_t done = 0;
  for (const ExperimentRun& run : runs) {
    if (progress)
      progress("timing " + run.which->name + ", " + run.method->label + ", h = " + run.step, done,
               runs.size());
    ++done;
    if (rows.contains(cost_key(run))) continue;
    const StepTime time = time_steps(run.resolved, experiment.quick ? 0.05 : 0.3);
    rows[cost_key(run)].text = cost_key(run) + "," + number(time.median, "%.6g") + "," +
                               number(time.minimum, "%.6g") + "," + number(time.maximum, "%.6g") + "," +
                               std::to_string(time.repetitions) + "," + number(time.seconds, "%.4g");
    write_file(path, costs_csv(runs, rows));  // after each, so that none is lost with the process
  }
  write_file(path, costs_csv(runs, rows));  // rows of runs that are no longer asked for go
}

namespace {
// A trend that is there, but slower than one unit of round-off of the initial value a step.
bool below_round_off(const nlohmann::json& invariant, const nlohmann::json& summary) {
  const std::string kind = invariant["class"];
  if (kind != "random_walk" && kind != "linear" && kind != "polynomial" && kind != "exponential")
    return false;
  const auto text = [](const nlohmann::json& x) { return x.is_string() ? x.get<std::string>() : x.dump(); };
  const auto initial = Real::parse(text(invariant["initial"])), step = Real::parse(text(summary["step"]));
  const double unit = summary["precision"] == "quad" ? 9.6e-35 : 1.1e-16;
  return initial && step &&
         std::abs(invariant["slope"].get<double>() * step->value()) < unit * std::abs(initial->value());
}
}  // namespace

std::string results_table(const fs::path& directory, const Experiment& experiment,
                          const std::vector<ExperimentRun>& runs,
                          const std::vector<nlohmann::json>& summaries) {
  const auto costs = read_costs(directory / "cost.csv", runs);
  std::ostringstream text;
  bool marked = false;
  const auto scientific = [](const nlohmann::json& value) {
    return value.is_null() ? std::string("-") : number(value.get<double>(), "%.1e");
  };
  for (const ExperimentCase& c : experiment.cases) {
    std::array<char, 160> line{};
    const auto run =
        std::find_if(runs.begin(), runs.end(), [&](const ExperimentRun& r) { return r.which == &c; });
    const std::string time = run == runs.end() ? c.time : to_string(run->resolved.time);
    text << '\n' << c.title << "  (" << c.system << ", T = " << time << ")\n";
    const std::string drift = c.conserved.empty() ? "drift" : "drift of " + c.conserved;
    std::snprintf(line.data(), line.size(), "%-23s %19s  %-34s %9s %9s\n", "", "error", drift.c_str(),
                  "structure", "cost");
    text << line.data();
    std::snprintf(line.data(), line.size(), "%-16s %6s %9s %9s  %-9s %-10s %-13s %9s %9s\n", "method", "h",
                  "max", "final", "max", "slope", "class", "residual", "ns/step");
    text << line.data();
    for (std::size_t k = 0; k < runs.size(); ++k) {
      if (runs[k].which != &c) continue;
      const nlohmann::json& s = summaries[k];
      if (s["status"] != "converged") {
        std::snprintf(line.data(), line.size(), "%-16.16s %6s  %s: %.60s\n", runs[k].method->label.c_str(),
                      runs[k].step.c_str(), s["status"].get<std::string>().c_str(),
                      s["message"].get<std::string>().c_str());
        text << line.data();
        continue;
      }
      std::string measured = "-";
      for (const nlohmann::json& i : s["invariants"])
        if (i["name"] == c.conserved && i.contains("max")) {
          const bool mark = below_round_off(i, s);
          marked = marked || mark;
          measured = scientific(i["max"]) + "   " + number(i["slope"].get<double>(), "%+.1e") + "   " +
                     i["class"].get<std::string>() + (mark ? "*" : "");
        } else if (i["name"] == c.conserved && i.contains("largest_rise")) {
          measured =
              i["largest_rise"] == 0.0 ? "never rises" : "largest rise " + scientific(i["largest_rise"]);
        }
      const auto cost = costs.find(cost_key(runs[k]));
      std::snprintf(line.data(), line.size(), "%-16.16s %6s %9s %9s  %-34s %9s %9s\n",
                    runs[k].method->label.c_str(), runs[k].step.c_str(), scientific(s["error_max"]).c_str(),
                    scientific(s["error_final"]).c_str(), measured.c_str(),
                    scientific(s["structure_residual"]).c_str(),
                    cost == costs.end() ? "-" : number(cost->second.median, "%.0f").c_str());
      text << line.data();
    }
  }
  if (marked) text << "\n* slower than one unit of round-off a step\n";
  return text.str();
}

fs::path make_report(const fs::path& directory) {
  const fs::path script = data_directory() / "report" / "report.py";
  // The system's Python is the one that has matplotlib's package.
  std::error_code error;
  const std::string python = fs::exists("/usr/bin/python3", error) ? "/usr/bin/python3" : "python3";
  const auto shell_quoted = [](const std::string& path) {
    std::string text = "'";
    for (const char c : path) text += c == '\'' ? "'\\''" : std::string(1, c);
    return text + "'";
  };
  const std::string command =
      python + " " + shell_quoted(script.string()) + " " + shell_quoted(directory.string()) + " 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw RunError("cannot start " + python + " for the report");
  std::string output;
  std::array<char, 256> buffer{};
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr) output += buffer.data();
  const int status = pclose(pipe);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    while (!output.empty() && output.back() == '\n') output.pop_back();
    const std::size_t newline = output.rfind('\n');
    throw RunError("the report could not be made (results.csv and cost.csv are complete): " +
                   (newline == std::string::npos ? output : output.substr(newline + 1)));
  }
  return directory / "report.html";
}

}  // namespace pfaff
