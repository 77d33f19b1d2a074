// What the terminal shows: no line is longer than the terminal is wide, whatever the command; short command
// lines, help, quiet, and the few names that are offered for one that is not there.
#include <algorithm>
#include <regex>
#include <set>

#include <pfaff/bench/runner/text_table.hpp>

#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

/// The programs that are started meanwhile find a terminal of so many columns.
class Columns {
 public:
  explicit Columns(std::size_t columns) { setenv("COLUMNS", std::to_string(columns).c_str(), 1); }
  ~Columns() { unsetenv("COLUMNS"); }
  Columns(const Columns&) = delete;
  Columns& operator=(const Columns&) = delete;
};

std::size_t width(const std::string& line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}
// The lines of a text that are longer; the paths of files, which are not broken, are not counted.
Arguments too_long(const std::string& text, std::size_t columns) {
  static const std::regex path(R"(\S*/\S{20,})");
  Arguments found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (width(std::regex_replace(line, path, "")) > columns) found.push_back(line);
  return found;
}

// Every command that prints a table, on what has the widest of them. That of experiments is looked at by
// bench/Classified.TheTerminalKnowsEveryClassToo, because an experiment takes seconds.
std::vector<Arguments> commands_with_tables(const TemporaryDirectory& files) {
  std::vector<Arguments> commands{
      {"--help"},
      {"list"},
      {"list", "facets"},
      {"reproduce", "su-qin", "--section", "5"},
      {"reproduce", "--coverage"},
      {"verify", "verlet"},
      {"falsify", "verlet", "--claim", "symplectic", "--system", "pendulum"},
      {"derive", "n-pendulum", "--method", "lmm"},
      {"run", "n-pendulum", "rattle", "--step", "0.01", "--time", "0.1", "--out", files / "run"}};
  for (const char* command : {"list", "describe", "cite", "run", "evaluate", "compare", "reproduce", "verify",
                              "falsify", "derive", "help", "completion"})
    commands.push_back({"help", command});
  for (const char* name : {"damped-oscillator", "n-pendulum", "sleigh", "gauss", "composition", "lie-poisson",
                           "dirac", "formulations", "bead-rod", "generating-function"})
    commands.push_back({"describe", name});
  for (const char* system : {"damped-pendulum", "n-pendulum", "sleigh", "magnetic-induction", "heavy-top"})
    commands.push_back({"evaluate", system});
  return commands;
}

TEST(Terminal, NoLineIsLongerThanTheTerminalIsWide) {
  const TemporaryDirectory files;
  for (const std::size_t columns : {80U, 60U}) {
    const Columns narrow(columns);
    for (const Arguments& command : commands_with_tables(files)) {
      const Outcome outcome = run_pfaff(command);
      EXPECT_EQ(outcome.status, 0) << joined(command) << outcome.err;
      EXPECT_EQ(too_long(outcome.out, columns), Arguments()) << joined(command) << " at " << columns;
      EXPECT_GT(outcome.out.size(), 100U) << joined(command);
    }
  }
  // Controls: the same table in a wide terminal has longer lines, which are found.
  const Columns wide(200);
  EXPECT_GT(too_long(run_pfaff({"list", "integrators"}).out, 80).size(), 20U);
  EXPECT_EQ(too_long("short\n" + std::string(61, 'x') + "\n", 60).size(), 1U);
}

TEST(Terminal, WithoutATerminalTablesTakeAHundredColumns) {
  unsetenv("COLUMNS");
  const std::string text = run_pfaff({"list"}).out;
  EXPECT_EQ(too_long(text, 100), Arguments());
  EXPECT_FALSE(too_long(text, 90).empty());
  setenv("COLUMNS", "many", 1);  // as if it were not there
  EXPECT_EQ(run_pfaff({"list"}).out, text);
  unsetenv("COLUMNS");
}

TEST(Terminal, ATableWrapsThenLeavesOutThenBreaksNamesThenMakesBlocks) {
  const pfaff::TableRows rows{{"method", "final", "class", "structure"},
                              {"symplectic Euler", "1.2e-05", "biased-round-off*", "1.0e-16"}};
  EXPECT_EQ(pfaff::table(rows, {"final"}, 60),
            "method            final    class              structure\n"
            "symplectic Euler  1.2e-05  biased-round-off*  1.0e-16\n");
  EXPECT_EQ(pfaff::table(rows, {"final"}, 50),
            "method      final    class              structure\n"
            "symplectic  1.2e-05  biased-round-off*  1.0e-16\n"
            "Euler\n");
  EXPECT_EQ(pfaff::table(rows, {"final"}, 42),
            "method      class              structure\n"
            "symplectic  biased-round-off*  1.0e-16\n"
            "Euler\n"
            "(42 columns leave no room for: final)\n");
  EXPECT_EQ(pfaff::table(rows, {}, 42),
            "method      final    class       structure\n"
            "symplectic  1.2e-05  biased-     1.0e-16\n"
            "Euler                round-off*\n");
  EXPECT_EQ(pfaff::table(rows, {}, 30),
            "symplectic Euler\n"
            "    final      1.2e-05\n"
            "    class      biased-round-off*\n"
            "    structure  1.0e-16\n");
  EXPECT_EQ(pfaff::facts({{"written", "/a/path/that/is/not/broken/anywhere"}, {"status", "it ran"}}, 24),
            "written  /a/path/that/is/not/broken/anywhere\nstatus   it ran\n");
}

TEST(Terminal, SystemAndIntegratorNeedNoOptions) {
  const Arguments rest{"--step", "0.1", "--time", "1", "--out", "-"};
  const Outcome shortened = run_pfaff(Arguments{"run", "kepler", "gauss"} + rest);
  EXPECT_EQ(shortened.status, 0) << shortened.err;
  EXPECT_EQ(shortened.out,
            run_pfaff(Arguments{"run", "--system", "kepler", "--integrator", "gauss"} + rest).out);
  EXPECT_EQ(run_pfaff(Arguments{"run", "--system", "kepler", "gauss"} + rest).out, shortened.out);
  EXPECT_EQ(run_pfaff({"evaluate", "kepler"}).out, run_pfaff({"evaluate", "--system", "kepler"}).out);
  expect_refused(Arguments{"run", "kepler", "gauss", "verlet"} + rest, {"verlet"});
  expect_refused(Arguments{"run", "kepler", "guass"} + rest, {"did you mean 'gauss'?"});
  expect_refused(Arguments{"run", "kepler"} + rest, {"missing: --integrator"});
}

TEST(Terminal, ARunSaysWhatItDoesWithTheLastStep) {
  const Arguments run{"run", "kepler", "verlet", "--out", "-", "--step"};
  EXPECT_EQ(run_pfaff(run + Arguments{"0.3", "--time", "1"}).err,
            "pfaff: the run lasts 0.9, not 1: 3 whole steps of 0.3, and none is shortened\n");
  EXPECT_EQ(run_pfaff(run + Arguments{"0.3", "--time", "1", "--quiet"}).err, "");
  // Multiples of the step, also where doubles do not divide: 0.3 / 0.1 is below 3.
  EXPECT_EQ(run_pfaff(run + Arguments{"0.1", "--time", "0.3"}).err, "");
  EXPECT_EQ(run_pfaff(run + Arguments{"1/3", "--time", "1"}).err, "");
  EXPECT_EQ(run_pfaff(run + Arguments{"0.031415926535897934", "--time", "3.141592653589793"}).err, "");
  // The summary says it, too, and of many steps it is not lost that the last one ends beside the duration.
  EXPECT_EQ(json_of(run_pfaff(run + Arguments{"0.3", "--time", "-1", "--json"}).out)["duration"],
            "the run lasts -0.9, not -1: 3 whole steps of -0.3, and none is shortened");
  EXPECT_FALSE(
      json_of(run_pfaff(run + Arguments{"0.1", "--time", "0.3", "--json"}).out).contains("duration"));
  EXPECT_EQ(run_pfaff(run + Arguments{"0.10000000005", "--time", "100"}).err,
            "pfaff: the run lasts 100.00000005, not 100: 1000 whole steps of 0.10000000005, and none "
            "is shortened\n");
}

TEST(Terminal, QuietLeavesResultsAndErrors) {
  const TemporaryDirectory files;
  const Arguments run{"run", "kepler", "verlet", "--step", "0.1", "--time", "1"};
  const Outcome quiet = run_pfaff(run + Arguments{"--quiet", "--out", files / "run"});
  EXPECT_EQ(quiet.status, 0);
  EXPECT_EQ(quiet.out + quiet.err, "");
  EXPECT_TRUE(fs::exists(files / "run/series.csv"));
  EXPECT_FALSE(run_pfaff(run + Arguments{"--quiet", "--out", "-"}).out.empty());
  EXPECT_EQ(run_pfaff({"verify", "verlet", "--quiet"}).out, "");
  EXPECT_EQ(run_pfaff({"falsify", "rk4", "--claim", "symplectic", "--systems", "3", "--quiet"}).status, 1);
  expect_refused(run + Arguments{"--quiet", "--out", "-", "--sett", "a=1"}, {"unknown option '--sett'"});
  expect_refused({"verify", "verlet", "--quiet", "--json"}, {"--quiet", "--json"});
}

TEST(Terminal, HelpIsAsking) {
  EXPECT_EQ(run_pfaff({"help"}).out, run_pfaff({"--help"}).out);
  EXPECT_EQ(run_pfaff({"help", "run"}).out, run_pfaff({"run", "--help"}).out);
  expect_refused({"help", "rum"}, {"unknown command 'rum'", "did you mean 'run'?"});
}

// Where no name is near, three of many are offered, those that share most with it.
TEST(Terminal, ThreeSuggestionsAreEnough) {
  const Outcome outcome = run_pfaff({"describe", "kepler-problem-in-three-dimensions"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("such as kepler, "), std::string::npos) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), ','), 3) << outcome.err;
  EXPECT_LT(outcome.err.size(), 200U);
}

TEST(Terminal, ListsShowFamiliesOrdersAndWhatIsKept) {
  const std::string text = run_pfaff({"list", "integrators"}).out;
  EXPECT_LT(text.find("\n runge-kutta\n"), text.find("\n  gauss "));
  EXPECT_LT(text.find("\n  gauss "), text.find("\n splitting\n"));
  EXPECT_TRUE(std::regex_search(text, std::regex("\n  verlet +2 +symplectic"))) << text;
  EXPECT_LT(run_pfaff({"list", "systems"}).out.find("\n canonical\n"), 9000U);
  const auto gauss = json_of(run_pfaff({"list", "integrators", "--json"}).out)["integrators"];
  const auto found =
      std::find_if(gauss.begin(), gauss.end(), [](const auto& j) { return j["name"] == "gauss"; });
  ASSERT_NE(found, gauss.end());
  EXPECT_EQ((*found)["folder"], "runge-kutta");
  EXPECT_EQ((*found)["orders"], nlohmann::json({4}));
  // Names alone are those of the lists.
  std::istringstream names(run_pfaff({"list", "systems", "--names"}).out);
  std::set<std::string> one_a_line, listed;
  for (std::string name; std::getline(names, name);) one_a_line.insert(name);
  const auto systems = json_of(run_pfaff({"list", "systems", "--json"}).out);
  for (const auto& entry : systems["systems"]) listed.insert(entry["name"]);
  EXPECT_EQ(one_a_line, listed);
}

TEST(Terminal, ASystemsDescriptionSaysWhatMethodsKeep) {
  const auto described = json_of(run_pfaff({"describe", "kepler", "--json"}).out);
  std::set<std::string> names, fitting;
  for (const auto& method : described["methods"]) names.insert(method["name"]);
  for (const auto& name : described["integrators"]) fitting.insert(name);
  EXPECT_EQ(names, fitting);
  // The same of the method's own description.
  const auto verlet = json_of(run_pfaff({"describe", "verlet", "--json"}).out);
  for (const auto& system : verlet["systems"])
    if (system["name"] == "kepler")
      for (const auto& method : described["methods"])
        if (method["name"] == "verlet") {
          EXPECT_EQ(method["order"], system["order"]);
          EXPECT_EQ(method["preserves"], system["preserves"]);
          names.clear();
        }
  EXPECT_TRUE(names.empty()) << "not compared";
  const std::string text = run_pfaff({"describe", "n-pendulum"}).out;
  EXPECT_TRUE(std::regex_search(text, std::regex("\n  rattle +2 +- +constrained-symplectic"))) << text;
  EXPECT_TRUE(std::regex_search(text, std::regex("\n  rk4 +4 +dirac "))) << text;
}

}  // namespace
