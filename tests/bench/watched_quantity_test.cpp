// The numbers that are left of a watched quantity: the one list, what is made of it, and its table in the
// docs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include <pfaff/bench/experiment/experiment_findings.hpp>
#include <pfaff/bench/experiment/results.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/runs/support/watched_quantity.hpp>

#include "../temporary_directory.hpp"

namespace {
using namespace pfaff;

TEST(WatchedQuantity, TheDocsHaveARowForEachNumber) {
  const std::string page = read_file(PFAFF_GOLDEN "/../../docs/drift-and-cost.md");
  std::string table = "| Number | Unit | What it is | Of | In `results.csv` |\n|---|---|---|---|---|\n";
  for (const QuantityField& field : quantity_fields()) {
    const char* const of = field.of == QuantityField::Of::both        ? "both"
                           : field.of == QuantityField::Of::conserved ? "conserved quantities"
                                                                      : "residuals";
    table += "| `" + field.name + "` | " + (field.unit.empty() ? "1" : field.unit) + " | " + field.meaning +
             " | " + of + " | " + (field.column ? "yes" : "no") + " |\n";
  }
  EXPECT_NE(page.find(table + "\n"), std::string::npos) << table;
}

TEST(WatchedQuantity, UnitsAreThoseOfTheQuantityAndOfTime) {
  const auto unit = [](const char* name, const char* quantity, const char* time) {
    const auto found = std::find_if(quantity_fields().begin(), quantity_fields().end(),
                                    [&](const QuantityField& field) { return field.name == name; });
    return unit_of(*found, quantity, time);
  };
  EXPECT_EQ(unit("max", "J", "s"), "J");
  EXPECT_EQ(unit("slope", "J", "s"), "J/s");
  EXPECT_EQ(unit("slope", "", "s"), "1/s");
  EXPECT_EQ(unit("slope", "J", ""), "J/1");
  EXPECT_EQ(unit("growth_rate", "J", "s"), "1/s");
  EXPECT_EQ(unit("exponent", "J", "s"), "");
  EXPECT_EQ(unit("slope", "", ""), "");
}

// What experiment.json says of each table is what its file has.
TEST(Tables, HaveTheColumnsThatExperimentJsonNames) {
  const pfaff::testing::TemporaryDirectory files;
  write_file(files / "test.toml", R"(schema = 1
title = "Tables"
[[method]]
label = "RATTLE"
integrator = "rattle"
[[method]]
label = "midpoint"
integrator = "implicit-midpoint"
[[case]]
name = "pendulum"
system = "n-pendulum"
set = { bobs = "2" }
time = 2
steps = [0.05, 0.1]
[[case]]
name = "many"
system = "quartic-nonholonomic"
methods = ["midpoint"]
time = 2
steps = [0.1]
seeds = 2
[[finding]]
case = "pendulum"
measure = "constraint:max"
method = "RATTLE"
relation = "stays-below"
bound = 1
)");
  const Experiment experiment = read_experiment(files / "test.toml", false);
  const std::filesystem::path directory = files.path() / "out";
  const ExperimentOutcome outcome =
      run_experiment(experiment, directory, {}, {.report = false, .timing = 0.001});
  EXPECT_EQ(outcome.failed, 0U) << outcome.table;
  const nlohmann::json head = nlohmann::json::parse(read_file(directory / "experiment.json"));
  EXPECT_EQ(head["schema"], schema_of_runs);
  std::size_t found = 0;
  for (const nlohmann::json& table : head["tables"]) {
    const auto text = text_in(directory / table["file"].get<std::string>());
    if (!text) continue;
    ++found;
    Columns columns;
    for (const nlohmann::json& column : table["columns"]) columns.push_back({column["name"]});
    EXPECT_EQ(text->substr(0, text->find('\n')), head_of(columns)) << table["file"];
  }
  EXPECT_GE(found, 5U);  // results, timings, spreads, findings, and a measure at least
  const std::string results = read_file(directory / results_file);
  for (const nlohmann::json& quantity : head["quantities"])
    for (const nlohmann::json& field : head["fields"]) {
      const std::string column = quantity["name"].get<std::string>() + ":" + field["name"].get<std::string>();
      EXPECT_EQ(results.find("," + column + ",") != std::string::npos,
                quantity["residual"] || !field["residuals_alone"])
          << column;
    }
}

// An experiment that an older program left is not resumed: its tables are others.
TEST(Tables, OfAnotherSchemaAreRefused) {
  const pfaff::testing::TemporaryDirectory files;
  write_file(files / "test.toml", R"(schema = 1
title = "Old"
[[method]]
label = "Verlet"
integrator = "verlet"
[[case]]
name = "swing"
system = "pendulum"
time = 1
steps = [0.1]
)");
  const Experiment experiment = read_experiment(files / "test.toml", false);
  const std::filesystem::path directory = files.path() / "out";
  const ExperimentOptions options{.report = false, .timing = 0.001};
  (void)run_experiment(experiment, directory, {}, options);
  EXPECT_EQ(run_experiment(experiment, directory, {}, options).resumed, 1U);
  for (const auto& path :
       {directory / "experiment.json", directory / "runs/swing-verlet-h0.1/summary.json"}) {
    nlohmann::json old = nlohmann::json::parse(read_file(path));
    old["schema"] = 1;
    write_file(path, old.dump(1) + "\n");
  }
  try {
    (void)run_experiment(experiment, directory, {}, options);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("holds an experiment of schema 1"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("--force"));
  }
  ExperimentOptions anew{.force = true, .report = false, .timing = 0.001};
  EXPECT_EQ(run_experiment(experiment, directory, {}, anew).resumed, 0U);
  EXPECT_EQ(run_experiment(experiment, directory, {}, options).resumed, 1U);
}

}  // namespace
