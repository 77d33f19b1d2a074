// pfaff compare: an experiment gives the same results when it is repeated, or killed and resumed, and writes
// all of its files.
#include <algorithm>
#include <chrono>
#include <regex>
#include <set>
#include <thread>

#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

// Two short cases, one of which no method survives, and one long run, so that a kill falls before the end.
const std::string short_and_long_runs = R"(schema = 1
title = "A test"
reference = ["su-qin"]
[[method]]
label = "GF 2, symmetric"
integrator = "generating-function"
set = { order = 2 }
[[method]]
label = "RK4"
integrator = "rk4"
[[case]]
name = "short"
system = "damped-oscillator"
time = "20"
steps = ["0.5", "0.1"]
conserved = "birkhoffian"
[[case]]
name = "range"
system = "damped-oscillator"
set = { nu = 10 }
time = "100"
steps = ["0.1"]
methods = ["GF 2, symmetric"]
conserved = "birkhoffian"
[[case]]
name = "long"
system = "damped-pendulum"
time = "1000"
steps = ["0.01"]
precision = "quad"
methods = ["RK4"]
conserved = "energy"
)";
constexpr std::size_t all_runs = 6;

Arguments compare(const TemporaryDirectory& files, const std::string& out) {
  return {"compare", files / "test.toml", "--quick", "--json", "--out", files / out};
}
// Figures, reports and timings take most of the time of a small experiment.
Arguments compare_without_report(const TemporaryDirectory& files, const std::string& out) {
  return compare(files, out) + Arguments{"--no-report", "--timing", "0.001"};
}
nlohmann::json completed(const Outcome& outcome) {
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const auto j = json_of(outcome.out);
  EXPECT_EQ(j["schema"], 1);
  EXPECT_EQ(j["experiments"][0]["runs"], all_runs);
  return j["experiments"][0];
}
std::set<std::string> runs_in(const fs::path& experiment_directory) {
  std::set<std::string> names;
  std::error_code error;
  for (const auto& run : fs::directory_iterator(experiment_directory / "runs", error))
    if (run.path().extension() != ".part") names.insert(run.path().filename());
  return names;
}

// Everything a page fetches is inside it.
void expect_self_contained(const std::string& page, std::size_t figures) {
  const std::regex attribute(
      R"re(<([a-zA-Z]+)[^<>]*?\s(?:src|href|xlink:href|srcset)\s*=\s*["']([^"']*)["'])re");
  for (std::sregex_iterator match(page.begin(), page.end(), attribute), end; match != end; ++match) {
    const std::string tag = (*match)[1], target = (*match)[2];
    EXPECT_TRUE(target.starts_with("#") || target.starts_with("data:") || tag == "a") << tag << ' ' << target;
  }
  for (const char* fetch : {"<link", "<script ", "<iframe", "@import", "url(http", "url(//"})
    EXPECT_EQ(page.find(fetch), std::string::npos) << fetch;
  EXPECT_EQ(page.find("<script>"), page.rfind("<script>"));  // one, which sorts tables, and nothing to fetch
  std::size_t drawings = 0;
  for (std::size_t at = page.find("<svg "); at != std::string::npos; at = page.find("<svg ", at + 1))
    ++drawings;
  EXPECT_GE(drawings, figures);  // some in two shapes, for wide screens and narrow ones
}

TEST(Experiment, KilledAndResumedItGivesTheSameResults) {
  const TemporaryDirectory files;
  write(files / "test.toml", short_and_long_runs);
  {
    Program program(compare_without_report(files, "killed"));
    while (!program.ended() && runs_in(files.path() / "killed").empty())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    program.kill();
    EXPECT_EQ(program.wait().status, 128 + SIGKILL);
  }
  const auto done = runs_in(files.path() / "killed");
  EXPECT_FALSE(done.empty());
  EXPECT_LT(done.size(), all_runs);
  EXPECT_FALSE(done.contains("long-rk4-h0.01"));
  EXPECT_FALSE(fs::exists(files.path() / "killed/results.csv"));
  for (const std::string& run : done) {  // what counts as done is whole
    const fs::path directory = files.path() / "killed/runs" / run;
    EXPECT_EQ(json_of(text_of(directory / "summary.json"))["schema"], 2);
    EXPECT_TRUE(text_of(directory / "series.csv").ends_with('\n'));
  }
  const auto resumed = completed(run_pfaff(compare_without_report(files, "killed")));
  EXPECT_EQ(resumed["resumed"], done.size());
  EXPECT_EQ(resumed["failed"], 1);
  EXPECT_FALSE(resumed.contains("report"));
  for (const char* name : {"report.html", "figures"})
    EXPECT_FALSE(fs::exists(files.path() / "killed" / name)) << name;
  const auto whole = completed(run_pfaff(compare(files, "whole")));
  EXPECT_EQ(whole["resumed"], 0);
  const std::string results = text_of(files / "whole/results.csv");
  EXPECT_EQ(results, text_of(files / "killed/results.csv"));
  EXPECT_EQ(runs_in(files.path() / "whole"), runs_in(files.path() / "killed"));
  for (const std::string& run : runs_in(files.path() / "whole"))
    for (const char* name : {"config.toml", "series.csv", "summary.json"})
      EXPECT_EQ(text_of(files.path() / "whole/runs" / run / name),
                text_of(files.path() / "killed/runs" / run / name));

  // The failed run is in the table, with its class.
  const std::size_t failed = results.find("\nrange,");
  ASSERT_NE(failed, std::string::npos);
  const std::string line = results.substr(failed + 1, results.find('\n', failed + 1) - failed - 1);
  EXPECT_NE(line.find(",non_finite,"), std::string::npos) << line;
  EXPECT_NE(line.find("birkhoffian is not finite at t = 71"), std::string::npos) << line;
  EXPECT_EQ(std::count(results.begin(), results.end(), '\n'), static_cast<std::ptrdiff_t>(all_runs) + 1);
  EXPECT_NE(results.find("short,damped-oscillator,\"GF 2, symmetric\",generating-function,"),
            std::string::npos);

  const std::string cost = text_of(files / "whole/cost.csv");
  EXPECT_TRUE(cost.starts_with("case,method,step,ns_per_step,"));
  EXPECT_EQ(std::count(cost.begin(), cost.end(), '\n'), static_cast<std::ptrdiff_t>(all_runs) + 1);
  EXPECT_NE(cost.find("\nshort,\"GF 2, symmetric\",0.5,"), std::string::npos);

  std::size_t figures = 0;
  for (const auto& figure : fs::directory_iterator(files.path() / "whole/figures")) {
    figures += figure.path().extension() == ".svg";
    EXPECT_GT(fs::file_size(figure.path()), 1000U);
  }
  EXPECT_GT(figures, 2U);
  expect_self_contained(text_of(files / "whole/report.html"), figures);

  // The verdict of the report: a sentence and a row for each method of a case, the same in verdict.csv.
  ASSERT_EQ(whole["verdict"].size(), 3U);
  std::size_t rows = 1;
  for (const auto& one : whole["verdict"]) {
    EXPECT_TRUE(one["sentence"].get<std::string>().ends_with('.')) << one["sentence"];
    EXPECT_FALSE(one.contains("assertions"));
    rows += one["methods"].size();
  }
  const std::string verdict = text_of(files / "whole/verdict.csv");
  EXPECT_EQ(std::count(verdict.begin(), verdict.end(), '\n'), static_cast<std::ptrdiff_t>(rows));
  EXPECT_NE(verdict.find("\nlong,RK4,explicit,"), std::string::npos) << verdict;

  // A run whose summary is damaged is run again; the rest, costs included, stays.
  const fs::path damaged = files.path() / "whole/runs" / *done.begin() / "summary.json";
  write(damaged, text_of(damaged).substr(0, 100));
  EXPECT_EQ(completed(run_pfaff(compare_without_report(files, "whole")))["resumed"], all_runs - 1);
  for (const char* name : {"report.html", "verdict.csv"})
    EXPECT_FALSE(fs::exists(files.path() / "whole" / name)) << name << " of other runs is left";
  EXPECT_EQ(text_of(files / "whole/results.csv"), results);
  EXPECT_EQ(text_of(files / "whole/cost.csv"), cost);

  // The directory is this experiment's: another one is refused and changes nothing.
  std::string other = short_and_long_runs;
  other.replace(other.find("time = \"20\""), 11, "time = \"30\"");
  write(files / "test.toml", other);
  expect_complaint(run_pfaff(compare(files, "whole")), 2,
                   {"whole' holds another experiment of the same name; expected a new directory, or --force"},
                   "compare");
  EXPECT_EQ(text_of(files / "whole/results.csv"), results);
}

// What an experiment of the same name left is replaced where that is asked for. One of another name is not.
TEST(Experiment, AnotherOneOfTheSameNameIsReplacedByForce) {
  const TemporaryDirectory files;
  const auto with = [](std::string text, const std::string& old, const std::string& changed) {
    return text.replace(text.find(old), old.size(), changed);
  };
  const std::string two = R"(schema = 1
title = "A test"
[[method]]
label = "RK4"
integrator = "rk4"
[[case]]
name = "short"
system = "damped-oscillator"
time = "2"
steps = ["0.5", "0.1"]
conserved = "birkhoffian"
)";
  const Arguments plain = compare_without_report(files, "out"), forced = plain + Arguments{"--force"};
  write(files / "test.toml", two);
  ASSERT_EQ(run_pfaff(plain).status, 0);
  const std::string kept = text_of(files / "out/runs/short-rk4-h0.1/summary.json");
  write(files / "out/report.html", "of the first one");
  write(files / "test.toml", with(with(two, "\"0.5\"", "\"0.25\""), "A test", "Another"));
  expect_complaint(run_pfaff(plain), 2, {"out' holds another experiment of the same name"}, "compare");
  const Outcome outcome = run_pfaff(forced);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(json_of(outcome.out)["experiments"][0]["resumed"], 1);
  EXPECT_EQ(runs_in(files.path() / "out"), (std::set<std::string>{"short-rk4-h0.1", "short-rk4-h0.25"}));
  EXPECT_EQ(text_of(files / "out/runs/short-rk4-h0.1/summary.json"), kept);
  EXPECT_FALSE(fs::exists(files.path() / "out/report.html")) << "the report of other runs is left";
  for (const char* table : {"out/results.csv", "out/cost.csv"})
    EXPECT_EQ(text_of(files / table).find(",0.5,"), std::string::npos) << table;
  // It is the experiment of the directory from now on.
  EXPECT_EQ(run_pfaff(plain).status, 0);
  write(files / "other.toml", two);
  Arguments other = forced;
  other[1] = files / "other.toml";
  expect_complaint(run_pfaff(other), 2, {"out' holds another experiment; expected a new directory"},
                   "compare");
  EXPECT_EQ(runs_in(files.path() / "out").size(), 2U);
  // A file of that name that describes no experiment is somebody else's, where there are no runs beside it.
  fs::create_directory(files.path() / "theirs");
  for (const char* text : {"{}", "[]", "notes", "{\"name\": \"test\"}", "{\"schema\": 2}"}) {
    write(files / "theirs/experiment.json", text);
    for (const Arguments& arguments : {compare_without_report(files, "theirs"),
                                       compare_without_report(files, "theirs") + Arguments{"--force"}})
      expect_complaint(run_pfaff(arguments), 2, {"theirs' holds a file experiment.json that describes no"},
                       text);
    EXPECT_EQ(text_of(files / "theirs/experiment.json"), text);
  }
  // With runs it is taken up again, and described anew.
  write(files / "out/experiment.json", "{\"schema\": 2");
  EXPECT_EQ(run_pfaff(plain).status, 0);
  EXPECT_EQ(json_of(text_of(files / "out/experiment.json"))["name"], "test");
}

// An ensemble of two formulations: medians, and findings of which one is wrong on purpose.
const std::string ensemble = R"(schema = 1
title = "An ensemble"
[[method]]
label = "Dirac"
integrator = "odeint-dopri5"
formulation = "dirac"
tolerance = "1e-6"
[[method]]
label = "LMM"
integrator = "odeint-dopri5"
formulation = "lmm"
tolerance = ["1e-6"]
[[method]]
label = "RATTLE"
integrator = "rattle"
[[case]]
name = "pendula"
system = "n-pendulum"
set = { bobs = 2 }
time = "5"
steps = ["0.01"]
seeds = 3
reference = "none"
conserved = "energy"
[[finding]]
case = "pendula"
measure = "constraint:max"
method = "RATTLE"
relation = "stays-below"
bound = "1e-13"
)";

TEST(Experiment, EnsembleWithFindings) {
  const TemporaryDirectory files;
  write(files / "test.toml", ensemble);
  const Outcome outcome = run_pfaff({"compare", files / "test.toml", "--out", files / "out"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  for (const char* shown : {"3 seeds", "~1e-6", "median and range", "growth of the largest residual",
                            "holds  constraint:max of RATTLE stays below 1e-13 in 3 of 3 runs", "9 runs"})
    EXPECT_NE(outcome.out.find(shown), std::string::npos) << shown;
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
  const std::string results = text_of(files / "out/results.csv");
  EXPECT_EQ(std::count(results.begin(), results.end(), '\n'), 10);
  for (const char* column : {"hidden-constraint:growth", ",tolerance,seed,formulation,run\n"})
    EXPECT_NE(results.find(column), std::string::npos) << column;
  const std::string spreads = text_of(files / "out/ensembles.csv");
  EXPECT_NE(spreads.find("pendula,LMM,,1e-6,3,3,constraint:max,3,"), std::string::npos) << spreads;
  EXPECT_TRUE(fs::exists(files.path() / "out/figures/constraints_pendula.svg"));
  expect_self_contained(text_of(files / "out/report.html"), 1);

  // Resumed it takes every run from the disk and says the same.
  const auto again = json_of(
      run_pfaff({"compare", files / "test.toml", "--json", "--no-report", "--out", files / "out"}).out);
  EXPECT_EQ(again["experiments"][0]["resumed"], 9);
  EXPECT_EQ(again["experiments"][0]["findings"][0]["holding"], 3);
  EXPECT_EQ(text_of(files / "out/results.csv"), results);
  EXPECT_TRUE(fs::exists(files.path() / "out/report.html")) << "it is of the same runs";

  // A claim that is wrong: one line, exit status 1, everything written.
  std::string wrong = ensemble;
  wrong.replace(wrong.find("stays-below"), 11, "exceeds");
  write(files / "wrong.toml", wrong);
  const Outcome failed = run_pfaff({"compare", files / "wrong.toml", "--out", files / "wrong"});
  EXPECT_EQ(failed.status, 1);
  EXPECT_EQ(failed.err,
            "pfaff: wrong: a finding does not hold: constraint:max of RATTLE exceeds 1e-13 in 0 of 3 runs, "
            "expected in 3\n");
  EXPECT_TRUE(fs::exists(files.path() / "wrong/report.html"));
}

TEST(Experiment, QuickRunOfOneThatShips) {
  const TemporaryDirectory files;
  Circumstances here;
  here.directory = files.path();
  const Outcome outcome = run_pfaff({"compare", "--quick", "damped-oscillator"}, here);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(outcome.out.find("52 runs (0 resumed, 0 ended early)"), std::string::npos);
  for (const char* shown : {"GF 8", "Euler centre", "RK4", "ns/step", "drift of birkhoffian", "report.html",
                            "\nweak-damping: ", "\nstrong-damping: "})
    EXPECT_NE(outcome.out.find(shown), std::string::npos) << shown;
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
  for (const char* name : {"experiment.json", "results.csv", "cost.csv", "report.html", "figures", "runs"})
    EXPECT_TRUE(fs::exists(files.path() / "pfaff-out/damped-oscillator-quick" / name)) << name;
  EXPECT_EQ(runs_in(files.path() / "pfaff-out/damped-oscillator-quick").size(), 52U);
  // What the paper is about: the structure stays at round-off for its schemes, and beside them for Gauss
  // collocation in Darboux coordinates alone.
  for (const auto& run : runs_in(files.path() / "pfaff-out/damped-oscillator-quick")) {
    const auto j =
        json_of(text_of(files.path() / "pfaff-out/damped-oscillator-quick/runs" / run / "summary.json"));
    const double residual = j["structure_residual"];
    if (run.find("-gf-") != std::string::npos || run.find("darboux") != std::string::npos) {
      EXPECT_LT(residual, 1e-14) << run;
    }
    if (run.find("rk4") != std::string::npos) {
      EXPECT_GT(residual, 1e-7) << run;
    }
  }
}

}  // namespace
