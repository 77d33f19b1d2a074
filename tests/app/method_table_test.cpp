// Tables of coefficients on the command line: --integrator FILE.toml, and wherever else an integrator is
// named.
#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

const std::string shipped = std::string(PFAFF_GOLDEN) + "/../../examples/tables/";

std::string verlet(const std::string& drift) {
  return "name = \"my-verlet\"\nkind = \"splitting\"\norder = 2\ndrift = [" + drift + "]\nkick = [1]\n";
}
Arguments table_run_to(const std::string& out, const std::string& table) {
  return {"run", "--out", out, "--system", "pendulum", "--integrator", table, "--step", "0.1", "--time", "2"};
}

TEST(MethodTable, RunsLikeARegisteredIntegrator) {
  const TemporaryDirectory files;
  write(files / "table.toml", verlet("0.5, 0.5"));
  const Outcome table = run_pfaff(table_run_to("-", files / "table.toml")),
                cpp = run_pfaff(table_run_to("-", "verlet"));
  EXPECT_EQ(table.status, 0) << table.err;
  EXPECT_EQ(table.out, cpp.out);
}

TEST(MethodTable, ItsContentIsAPartOfTheRun) {
  const TemporaryDirectory files;
  write(files / "table.toml", verlet("0.5, 0.5"));
  const Outcome first = run_pfaff(table_run_to(files / "run", files / "table.toml"));
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_NE(text_of(files / "run/config.toml").find("table.toml"), std::string::npos);
  const Arguments again{"run", "--out", files / "new", "--config", files / "run/config.toml"};
  EXPECT_EQ(run_pfaff(again).status, 0);
  EXPECT_EQ(text_of(files / "run/series.csv"), text_of(files / "new/series.csv"));
  write(files / "table.toml", "# other bytes\n" + verlet("0.5, 0.5"));
  for (const Arguments& run :
       {table_run_to(files / "run", files / "table.toml"),
        Arguments{"run", "--out", files / "newer", "--config", files / "run/config.toml"}})
    expect_complaint(run_pfaff(run), 2, {"table.toml has changed", "--force"}, joined(run));
}

TEST(MethodTable, IsDescribedWithItsConditions) {
  const Outcome outcome = run_pfaff({"describe", shipped + "pefrl.toml", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto j = json_of(outcome.out);
  EXPECT_EQ(j["name"], "pefrl");
  EXPECT_NE(j["order_conditions"].get<std::string>().find("8 by words up to order 4"), std::string::npos);
}

TEST(MethodTable, IsLoadedAsAPluginAndListed) {
  const Outcome outcome = run_pfaff({"list", "integrators", "--plugin", shipped + "ruth-3.toml"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("  ruth-3 "), std::string::npos) << outcome.out;
  EXPECT_EQ(run_pfaff({"run", "--out", "-", "--system", "pendulum", "--integrator", "ruth-3", "--step", "0.1",
                       "--time", "1", "--plugin", shipped + "ruth-3.toml"})
                .status,
            0);
}

// A table may be based on a method of a shared object, wherever that one is given.
TEST(MethodTable, IsReadAfterAllSharedObjects) {
  const TemporaryDirectory files;
  const Arguments command{"list", "--plugin", files / "none.toml"};
  expect_complaint(run_pfaff(command + Arguments{"--plugin", files / "missing.so"}), 2, {"missing.so"},
                   "a shared object behind the table");
  setenv("PFAFF_PLUGIN_PATH", (files / "nowhere").c_str(), 1);
  expect_complaint(run_pfaff(command), 2, {"PFAFF_PLUGIN_PATH", "nowhere"}, "a directory of shared objects");
  unsetenv("PFAFF_PLUGIN_PATH");
  expect_complaint(run_pfaff(command), 2, {"none.toml"}, "the table alone");
}

TEST(MethodTable, ItsClaimsAreVerifiedAndFalsified) {
  const Outcome verified = run_pfaff({"verify", shipped + "ruth-3.toml", "--json"});
  EXPECT_EQ(verified.status, 0) << verified.err;
  const auto j = json_of(verified.out);
  EXPECT_TRUE(j["ok"].get<bool>());
  int by_words = 0;
  for (const auto& check : j["checks"]) by_words += check["scope"] == "its coefficients, by words";
  EXPECT_EQ(by_words, 7);  // the conditions and a control for each of the six coefficients
  const Outcome falsified = run_pfaff({"falsify", shipped + "ruth-3.toml", "--systems", "20"});
  EXPECT_EQ(falsified.status, 0) << falsified.out << falsified.err;
}

TEST(MethodTable, IsComparedInExperiments) {
  const TemporaryDirectory files;
  write(files / "experiment.toml",
        "schema = 1\ntitle = \"a table\"\n[[method]]\nlabel = \"table\"\nintegrator = \"" + shipped +
            "pefrl.toml\"\n[[case]]\nname = \"pendulum\"\nsystem = \"pendulum\"\ntime = 1\nsteps = [0.1]\n");
  const Outcome outcome =
      run_pfaff({"compare", files / "experiment.toml", "--quick", "--no-report", "--out", files / "out"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(text_of(files / "out/results.csv").find("pefrl.toml"), std::string::npos);
}

TEST(MethodTable, OfAnExperimentIsFoundBesideItsFile) {
  const TemporaryDirectory files;
  fs::create_directories(files.path() / "tables");
  write(files / "tables/table.toml", verlet("0.5, 0.5"));
  write(files / "experiment.toml",
        "schema = 1\ntitle = \"a table\"\n[[method]]\nlabel = \"table\"\nintegrator = \"tables/table.toml\"\n"
        "[[case]]\nname = \"pendulum\"\nsystem = \"pendulum\"\ntime = 1\nsteps = [0.1]\n");
  const Outcome outcome =
      run_pfaff({"compare", files / "experiment.toml", "--quick", "--no-report", "--out", files / "out"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

// One line, and below it the value with a caret under its wrong part.
TEST(MethodTable, AFileThatIsWrongIsRefusedWithItsPlace) {
  const TemporaryDirectory files;
  write(files / "table.toml", verlet("0.5, 0.500000001"));
  for (const Arguments& command :
       {table_run_to("-", files / "table.toml"), Arguments{"describe", files / "table.toml"},
        Arguments{"verify", files / "table.toml"}, Arguments{"falsify", files / "table.toml"},
        Arguments{"list", "--plugin", files / "table.toml"}}) {
    Outcome outcome = run_pfaff(command);
    const std::size_t line = outcome.err.find('\n') + 1;
    EXPECT_EQ(outcome.err.substr(line), "  2\n  ^\n") << joined(command);
    outcome.err.resize(line);
    expect_complaint(outcome, 2, {"table.toml:3", "the Lie word drift = 1", "is off by 1.00e-09"},
                     joined(command));
  }
  expect_complaint(run_pfaff(table_run_to("-", files / "none.toml")), 2, {"cannot read", "none.toml"},
                   "a file that is not there");
}

}  // namespace
