// Reading and keeping experiments: TOML numbers keep their digits, claims must be in scope, and timings
// survive when the program is killed.
#include <gtest/gtest.h>

#include <filesystem>

#include <unistd.h>

#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/experiment/results.hpp>
#include <pfaff/bench/experiment/stage_text.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/core/bracket.hpp>
#include <pfaff/core/text/source.hpp>

namespace {

using namespace pfaff;
namespace fs = std::filesystem;

class Experiments : public ::testing::Test {
 protected:
  fs::path directory;
  void SetUp() override {
    std::string name = ::testing::TempDir() + "pfaff-experiment-XXXXXX";
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    directory = name;
  }
  void TearDown() override { fs::remove_all(directory); }
  Experiment read(const std::string& text) {
    write_file(directory / "test.toml", "schema = 1\ntitle = \"A test\"\nreference = [\"su-qin\"]\n" + text);
    return read_experiment((directory / "test.toml").string(), true);
  }
};

TEST_F(Experiments, NumbersKeepTheDigitsTheyAreWrittenWith) {
  const Experiment e = read(R"([[method]]
label = "Størmer–Verlet" # ν, before numbers on other lines
integrator = "verlet"
[[case]]
name = "ü"
system = "harmonic-oscillator"
time = 12.345678901234567890123456789
initial = [ 0.1, # π ≈
  -1.2345678901234567890123456789e-3, 7, "1/3",
  +0.5 ]
steps = [0.1, 1_000.000_000_000_000_000_001,
         2.5e-1]
set = { "ω₀" = "ω", omega = 0.123456789012345678901234567890, other = 1.0 }
precision = "quad"
)");
  const ExperimentCase& c = e.cases.at(0);
  EXPECT_EQ(c.time, "12.345678901234567890123456789");
  EXPECT_EQ(c.initial,
            (std::vector<std::string>{"0.1", "-1.2345678901234567890123456789e-3", "7", "1/3", "+0.5"}));
  EXPECT_EQ(c.steps, (std::vector<std::string>{"0.1", "1000.000000000000000001", "2.5e-1"}));
  for (const auto& [key, value] : c.set) {
    if (key == "omega") {
      EXPECT_EQ(value, "0.123456789012345678901234567890");
    } else if (key == "other") {
      EXPECT_EQ(value, "1.0");
    }
  }
  EXPECT_EQ(c.set.size(), 3U);
}

const char* const two_systems = R"([[method]]
label = "Gauss 4"
integrator = "gauss"
[[method]]
label = "RK4"
integrator = "rk4"
[[case]]
name = "damped"
system = "damped-oscillator"
time = 1.0
steps = [0.5, 0.25]
[[case]]
name = "canonical"
system = "harmonic-oscillator"
time = 1.0
steps = [0.5]
)";

TEST_F(Experiments, ClaimsAreThoseInScopeOfEachSystem) {
  (void)run_experiment(read(two_systems), directory / "out", {}, {.report = false});
  const auto j = nlohmann::json::parse(read_file(directory / "out/experiment.json"));
  const nlohmann::json gauss{
      {{"name", "damped-oscillator"}, {"order", 4}, {"preserves", {"symmetric"}}},
      {{"name", "harmonic-oscillator"},
       {"order", 4},
       {"preserves", {"symmetric", "reversible", "symplectic", "quadratic-invariants"}}}};
  EXPECT_EQ(j["methods"][0]["systems"], gauss);
  EXPECT_EQ(j["methods"][1]["systems"][0]["preserves"], nlohmann::json{"none"});
}

TEST_F(Experiments, ErrorsOfTextModelsKeepTheirExcerpt) {
  const std::string model = (directory / "model.toml").string();
  write_file(model, "coordinates = [\"q\", \"p\"]\nkinetic = \"p^2/2\"\npotential = \"mass*q\"\n");
  try {
    (void)expand(
        read("[[method]]\nlabel = \"RK4\"\nintegrator = \"rk4\"\n"
             "[[case]]\nname = \"spring\"\nsystem = \"" +
             model + "\"\ntime = 1\ninitial = [1, 0]\nsteps = [0.5]\n"));
    FAIL() << "accepted";
  } catch (const text::TextError& error) {
    EXPECT_NE(std::string(error.what()).find("case spring, method RK4: "), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("model.toml:3:14: unknown name 'mass'"), std::string::npos)
        << error.what();
    EXPECT_EQ(error.excerpt(), "  mass*q\n  ^");
  }
}

TEST_F(Experiments, TimingsAreKeptAsTheyCome) {
  const Experiment experiment = read(two_systems);
  const fs::path costs = directory / "out/cost.csv";
  std::size_t timed = 0;
  const auto stop_at = [&](std::size_t row) {
    timed = 0;
    return [&timed, row](const ExperimentStage& stage) {
      if (stage.phase == 2 && timed++ == row) throw RunError("stopped");
    };
  };
  const auto rows = [&] {
    std::vector<std::string> lines;
    std::istringstream text(read_file(costs));
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  };
  EXPECT_THROW((void)run_experiment(experiment, directory / "out", stop_at(2)), RunError);
  const auto first = rows();
  ASSERT_EQ(first.size(), 3U);  // a header and two runs
  EXPECT_TRUE(first[1].starts_with("damped,Gauss 4,0.5,"));
  EXPECT_TRUE(first[2].starts_with("damped,Gauss 4,0.25,"));

  // A row that is missing in front of known ones: what is known stays while it is timed again.
  write_file(costs, first[0] + "\n" + first[2] + "\n");
  EXPECT_THROW((void)run_experiment(experiment, directory / "out", stop_at(1)), RunError);
  ASSERT_EQ(rows().size(), 3U);
  EXPECT_EQ(rows()[2], first[2]);

  (void)run_experiment(experiment, directory / "out", {}, {.report = false});
  ASSERT_EQ(rows().size(), 7U);
  EXPECT_EQ(rows()[2], first[2]);
}

const char* const oscillator_case = R"([[case]]
name = "damped"
system = "damped-oscillator"
time = 1.0
steps = [0.5]
)";
std::vector<std::string> labels_of(const std::vector<ExperimentRun>& runs) {
  std::vector<std::string> labels;
  for (const ExperimentRun& run : runs) labels.push_back(run.method->label);
  return labels;
}

// The methods of the registry that fit a system, found here by asking each of them.
std::vector<std::string> fitting(const std::string& system) {
  const auto model = systems().get(system, "system").make({});
  std::vector<std::string> names;
  for (const MethodPlugin* plugin : integrators().all())
    if (plugin->make({})->refuses(*model).empty()) names.push_back(plugin->name());
  return names;
}

TEST_F(Experiments, AllMethodsAreThoseThatFit) {
  std::vector<LeftOut> left_out;
  const auto taken = labels_of(expand(read(std::string("methods = \"all\"\n") + oscillator_case), &left_out));
  EXPECT_EQ(taken, fitting("damped-oscillator"));
  EXPECT_EQ(taken.size() + left_out.size(), integrators().all().size());
  const auto rattle = std::find_if(left_out.begin(), left_out.end(),
                                   [](const LeftOut& one) { return one.method == "rattle"; });
  ASSERT_NE(rattle, left_out.end());
  EXPECT_EQ(rattle->of_case, "damped");
  EXPECT_NE(rattle->reason.find("rattle needs "), std::string::npos) << rattle->reason;
}

TEST_F(Experiments, MethodsAreSelectedByClaimsNeedsAndOrders) {
  const auto selected = [&](const std::string& selection, const std::string& system) {
    std::string text = "methods = " + selection + "\n" + oscillator_case;
    text.replace(text.find("damped-oscillator"), 17, system);
    return labels_of(expand(read(text)));
  };
  // RK4 is of order 4 and keeps nothing, Stoermer-Verlet is symplectic and of order 2.
  const auto symplectic = selected("{ keeps = \"symplectic\", order = \">= 4\" }", "henon-heiles");
  EXPECT_EQ(std::count(symplectic.begin(), symplectic.end(), "gauss"), 1);
  for (const char* name : {"rk4", "verlet"})
    EXPECT_EQ(std::count(symplectic.begin(), symplectic.end(), name), 0) << name;
  const auto explicit_ones =
      selected("{ needs = [\"separable\"], order = [\">= 1\", \"< 3\"] }", "henon-heiles");
  EXPECT_EQ(std::count(explicit_ones.begin(), explicit_ones.end(), "verlet"), 1);
  for (const char* name : {"rk4", "gauss"})
    EXPECT_EQ(std::count(explicit_ones.begin(), explicit_ones.end(), name), 0) << name;
  // Claims are those on the system: Gauss is K-symplectic in no chart of its own making.
  for (const std::string& name : selected("{ keeps = \"K-symplectic\" }", "damped-oscillator"))
    EXPECT_NE(name, "gauss");
  // A grid of parameters goes to the methods that have them.
  const auto grid =
      selected("{ keeps = \"symplectic\", order = 6, set = { stages = [2, 3] } }", "henon-heiles");
  EXPECT_EQ(std::count(grid.begin(), grid.end(), "gauss stages=3"), 1);
  EXPECT_EQ(std::count(grid.begin(), grid.end(), "gauss stages=2"), 0);
}

TEST_F(Experiments, ASelectionStandsBesideMethodsByName) {
  const Experiment experiment = read(
      std::string(
          "methods = { keeps = \"K-symplectic\" }\n[[method]]\nlabel = \"RK4\"\nintegrator = \"rk4\"\n") +
      oscillator_case);
  const auto runs = expand(experiment);
  EXPECT_EQ(runs.front().method->label, "RK4");
  EXPECT_GT(runs.size(), 1U);
}

TEST_F(Experiments, ListsOfValuesAreGrids) {
  const Experiment e = read(R"([[method]]
label = "Gauss"
integrator = "gauss"
set = { stages = [1, 2] }
[[method]]
label = "RK4"
integrator = "rk4"
[[case]]
name = "damped"
title = "Damped"
system = "damped-oscillator"
set = { nu = [0.10, 1, 10] }
time = 1.0
steps = [0.5, 0.25]
methods = ["Gauss"]
)");
  const auto runs = expand(e);
  ASSERT_EQ(runs.size(), 12U);
  EXPECT_EQ(runs[0].which->name, "damped, nu = 0.10");
  EXPECT_EQ(runs[0].which->title, "Damped, nu = 0.10");
  EXPECT_EQ(runs[0].method->label, "Gauss, stages = 1");
  EXPECT_EQ(runs[0].slug, "damped-nu-0.10-gauss-stages-1-h0.5");
  EXPECT_EQ(runs[11].slug, "damped-nu-10-gauss-stages-2-h0.25");
  EXPECT_EQ(runs[11].resolved.method->order(*runs[11].resolved.model), 4);
}

TEST_F(Experiments, IncludedFilesGiveTheirTables) {
  fs::create_directory(directory / "common");
  write_file(directory / "common/methods.toml",
             "schema = 1\nnotes = [\"from the file\"]\ninclude = \"more.toml\"\n"
             "[[method]]\nlabel = \"RK4\"\nintegrator = \"rk4\"\n");
  write_file(
      directory / "common/more.toml",
      "schema = 1\ntitle = \"not this one\"\n[[method]]\nlabel = \"a table\"\nintegrator = \"mine.toml\"\n");
  const Experiment e =
      read(std::string("include = [\"common/methods.toml\", \"common/more.toml\"]\n") + oscillator_case);
  EXPECT_EQ(e.title, "A test");
  EXPECT_EQ(e.notes, std::vector<std::string>{"from the file"});
  ASSERT_EQ(e.methods.size(), 2U);  // each file once
  EXPECT_EQ(fs::path(e.methods[0].integrator), directory / "common/mine.toml");
  EXPECT_EQ(e.methods[1].label, "RK4");
}

TEST(ExperimentNames, AreTakenInWhateverLetters) {
  EXPECT_EQ(read_experiment("Kepler", true).name, "kepler");
  EXPECT_EQ(read_experiment("DAMPED-Oscillator", true).name, "damped-oscillator");
}

// No title or description of a quick experiment speaks of what only the full one has.
TEST(QuickExperiments, DoNotPromiseMoreThanTheyDo) {
  for (const std::string& name : experiment_names()) {
    const Experiment full = read_experiment(name, false), quick = read_experiment(name, true);
    std::vector<std::string> texts{quick.title, quick.description};
    texts.insert(texts.end(), quick.notes.begin(), quick.notes.end());
    for (std::size_t k = 0; k < full.cases.size(); ++k) {
      texts.push_back(quick.cases[k].title);
      if (full.cases[k].seeds == quick.cases[k].seeds) continue;
      for (const std::string& text : texts)
        for (const char* what : {" seeds", " initial states"})
          EXPECT_EQ(text.find(std::to_string(full.cases[k].seeds) + what), std::string::npos)
              << name << ": " << text;
    }
    for (const std::string& text : texts)
      EXPECT_EQ(text.find("million"), std::string::npos) << name << ": " << text;
  }
}

TEST(StageText, CountsPhasesAndEstimatesWhatIsLeft) {
  StageText text;
  EXPECT_EQ(text.at({1, "a", 5, 25}, 100), "1/3: a");
  EXPECT_EQ(text.at({1, "b", 10, 25}, 110), "1/3, about 30 s left: b");  // 5 runs in 10 s, 15 to come
  EXPECT_EQ(text.at({1, "c", 24, 25}, 100 + 19 * 3600.0), "1/3, about 60 min left: c");
  EXPECT_EQ(text.at({2, "d", 0, 25}, 1e5), "2/3: d");
  EXPECT_EQ(text.at({2, "e", 1, 25}, 1e5 + 600), "2/3, about 4 h left: e");
  EXPECT_EQ(text.at({3, "f", 25, 25}, 2e5), "3/3: f");
}

// Runs that are there already when counting begins say nothing about the pace.
TEST(StageText, EstimatesAnewWhereOtherThingsAreCounted) {
  StageText text;
  EXPECT_EQ(text.at({1, "choosing", 0, 4}, 100), "1/3: choosing");
  EXPECT_EQ(text.at({1, "a", 20, 30}, 110), "1/3: a");
  EXPECT_EQ(text.at({1, "b", 22, 30}, 120), "1/3, about 40 s left: b");
}

TEST_F(Experiments, AnInterruptedOneIsResumed) {
  const Experiment experiment = read(two_systems);
  std::atomic<bool> stop = false;
  const auto at_the_first_run = [&](const ExperimentStage& stage) { stop = stop || stage.done == 1; };
  const auto first = run_experiment(experiment, directory / "out", at_the_first_run, {.stop = &stop});
  EXPECT_TRUE(first.interrupted);
  EXPECT_GE(first.resumed, 1U);
  EXPECT_FALSE(fs::exists(directory / "out/results.csv"));
  // Resumed, it makes the other runs alone; it is stopped once more before the report, which takes long.
  std::size_t kept = 0;
  const auto up_to_the_report = [&](const ExperimentStage& stage) {
    if (kept == 0) kept = stage.done;
    if (stage.phase == ExperimentStage::phases) throw RunError("stopped");
  };
  EXPECT_THROW((void)run_experiment(experiment, directory / "out", up_to_the_report), RunError);
  EXPECT_EQ(kept, first.resumed);
  EXPECT_TRUE(fs::exists(directory / "out/results.csv"));
}

}  // namespace
