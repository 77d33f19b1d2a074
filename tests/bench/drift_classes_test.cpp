// The classes of drift come from one list with each name once, and files, findings and documentation all
// agree with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include <pfaff/bench/experiment/results.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/core/errors/errors.hpp>
#include <pfaff/runs/support/drift_class.hpp>

#include "../temporary_directory.hpp"

namespace {

using namespace pfaff;

std::string label_of(const DriftClassEntry& entry) {
  return "method-" + std::to_string(static_cast<int>(entry.drift_class));
}

// As many methods as classes, all the same; the summaries of their runs are given one class each.
class Classified : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string text = "schema = 1\ntitle = \"Classes\"\nreference = [\"su-qin\"]\n";
    for (const DriftClassEntry& entry : drift_classes())
      text += "[[method]]\nlabel = \"" + label_of(entry) + "\"\nintegrator = \"rk4\"\n";
    text += R"([[case]]
name = "oscillator"
system = "harmonic-oscillator"
conserved = "energy"
time = 1.0
steps = [0.5]
)";
    write_file(files / "classes.toml", text);
    experiment = read_experiment(files / "classes.toml", true);
    (void)run_experiment(experiment, directory, {}, {.report = false});
    runs = expand(experiment);
    summaries = read_summaries(directory, runs);
    for (std::size_t k = 0; k < runs.size(); ++k) classify(k, drift_classes()[k].name);
  }
  void classify(std::size_t run, std::string_view name) {
    for (nlohmann::json& invariant : summaries[run]["invariants"]) invariant["class"] = name;
  }
  /// The finding on drift in the report made of the summaries: its items, as HTML.
  std::vector<std::string> items() {
    write_file(directory / "results.csv", results_csv(runs, summaries, runs));
    const std::string page = read_file(make_report(directory));
    const std::size_t begin = page.find("<ul>", page.find("<li><strong>Drift.</strong>"));
    if (begin == std::string::npos) return {};
    std::stringstream list(page.substr(begin, page.find("</ul>", begin) - begin));
    std::vector<std::string> found;
    const std::string open = "<li>", close = "</li>";
    const std::string text = list.str();
    for (std::size_t at = text.find(open); at != std::string::npos; at = text.find(open, at + 1))
      found.push_back(text.substr(at + open.size(), text.find(close, at) - at - open.size()));
    return found;
  }

  pfaff::testing::TemporaryDirectory files;
  std::filesystem::path directory = files / "out";
  Experiment experiment;
  std::vector<ExperimentRun> runs;
  std::vector<nlohmann::json> summaries;
};

TEST_F(Classified, EveryMethodStandsInItsClassAndInNoOther) {
  const auto found = items();
  ASSERT_EQ(found.size(), drift_classes().size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    const DriftClassEntry& entry = drift_classes()[k];
    EXPECT_TRUE(found[k].starts_with(std::string(entry.name) + ": " + label_of(entry))) << found[k];
    const auto holding = std::count_if(found.begin(), found.end(), [&](const std::string& item) {
      return item.find(label_of(entry)) != std::string::npos;
    });
    EXPECT_EQ(holding, 1) << entry.name;
  }
}

TEST_F(Classified, AnUnknownClassIsAnErrorThatNamesIt) {
  classify(4, "random_walk");  // as it was spelt once
  try {
    (void)items();
    FAIL() << "expected an error";
  } catch (const RunError& error) {
    const std::string told = error.what();
    EXPECT_NE(told.find("energy:class: unknown drift class 'random_walk'; did you mean 'random-walk'?"),
              std::string::npos)
        << told;
  }
}

TEST_F(Classified, TheTerminalKnowsEveryClassToo) {
  experiment.cases[0].conserved = "energy";
  const std::string table = results_table(directory, experiment, runs, summaries);
  for (const DriftClassEntry& entry : drift_classes())
    EXPECT_NE(table.find(" " + std::string(entry.name)), std::string::npos) << entry.name;
  // In narrow terminals too, where the longest class has its mark beside it.
  for (const std::size_t columns : {80U, 60U}) {
    setenv("COLUMNS", std::to_string(columns).c_str(), 1);
    std::istringstream lines(results_table(directory, experiment, runs, summaries));
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), columns) << line;
  }
  unsetenv("COLUMNS");
  classify(0, "random_walk");
  EXPECT_THROW((void)results_table(directory, experiment, runs, summaries), RunError);
}

TEST_F(Classified, RunsUnderOtherNamesAreNotResumed) {
  auto head = nlohmann::json::parse(read_file(directory / "experiment.json"));
  EXPECT_EQ(run_experiment(experiment, directory, {}, {.report = false}).resumed, runs.size());
  head["drift_classes"][4]["name"] = "random_walk";
  write_file(directory / "experiment.json", head.dump());
  try {
    (void)run_experiment(experiment, directory, {}, {.report = false});
    FAIL() << "expected an error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("other drift classes"), std::string::npos) << error.what();
  }
}

TEST(DriftClasses, AreListedOnceEachInKebabCase) {
  std::set<std::string> names;
  for (const DriftClassEntry& entry : drift_classes()) {
    const std::string name(entry.name);
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz-"), std::string::npos) << name;
    EXPECT_FALSE(entry.meaning.empty() || entry.meaning.ends_with('.')) << name;
    EXPECT_EQ(to_string(entry.drift_class), name);
    EXPECT_EQ(drift_class_named(name).drift_class, entry.drift_class);
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(DriftClass::undetermined) + 1) << "undetermined is last";
}

// The first table of the page lists the classes as `name`: meaning, in the order of the list.
TEST(DriftClasses, AreThoseOfTheDocs) {
  std::ifstream in(PFAFF_GOLDEN "/../../docs/drift-and-cost.md");
  ASSERT_TRUE(in);
  std::vector<std::string> rows, expected;
  for (std::string line; std::getline(in, line) && (rows.empty() || !line.empty());)
    if (line.starts_with("| `")) rows.push_back(line);
  for (const DriftClassEntry& entry : drift_classes())
    expected.push_back("| `" + std::string(entry.name) + "` | " + std::string(entry.meaning) + " |");
  EXPECT_EQ(rows, expected);
}

}  // namespace
