// pfaff verify and pfaff reproduce: the format of their output, and that every claim made is also tested.
#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <set>

#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

nlohmann::json passed(const Arguments& arguments) {
  const Outcome outcome = run_pfaff(arguments + Arguments{"--json"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const auto j = json_of(outcome.out);
  EXPECT_EQ(j["schema"], 1);
  EXPECT_EQ(j["ok"], true);
  return j;
}
bool of_structure(const std::string& claim) {
  return claim == "K-symplectic" || claim == "symplectic" || claim == "constrained-symplectic";
}

TEST(Verify, EveryClaimOfEveryMethod) {
  const auto j = passed({"verify"});
  EXPECT_EQ(keys_of(j), (std::set<std::string>{"schema", "ok", "verdict", "counts", "checks"}));
  std::map<std::string, int> counts{{"pass", 0},     {"fail", 0},    {"measured", 0},
                                    {"rejected", 0}, {"skipped", 0}, {"not_judged", 0}};
  std::map<std::string, std::set<std::string>> ordered, structured, measured, passed_structure;
  int controls = 0;
  for (const auto& c : j["checks"]) {
    for (const char* key : {"plugin", "claim", "scope", "system", "precision", "parameters", "measured",
                            "expected", "tolerance", "in_scope", "control", "result"})
      EXPECT_TRUE(c.contains(key)) << key;
    const std::string result = c["result"], claim = c["claim"], plugin = c["plugin"];
    ++counts[result];
    counts["not_judged"] += c["reason"].get<std::string>().starts_with("not judged: ");
    controls += c["control"].get<bool>();
    EXPECT_EQ(result == "rejected", c["control"].get<bool>()) << c;
    EXPECT_EQ(result == "measured" || result == "skipped", !c["in_scope"].get<bool>()) << c;
    if (result == "skipped") {
      EXPECT_FALSE(c.value("reason", "").empty()) << c;
      const std::string reason = c["reason"];
      EXPECT_TRUE(plugin.starts_with("odeint-") || reason.starts_with("not judged: ") ||
                  reason.find("remembers earlier steps") != std::string::npos)
          << c;
    }
    if (c["control"]) continue;
    // An order that could not be judged on a system was looked for there; one that is judged nowhere fails.
    if (claim == "order") ordered[plugin].insert(c["system"]);
    if (!of_structure(claim)) continue;
    structured[plugin].insert(c["system"]);
    if (result == "measured") measured[plugin].insert(c["system"]);
    if (result == "pass")
      passed_structure[plugin].insert(c["system"].get<std::string>() + " " +
                                      c["precision"].get<std::string>());
  }
  EXPECT_EQ(j["counts"], nlohmann::json(counts));
  EXPECT_EQ(counts["fail"], 0);
  EXPECT_GT(controls, 20);
  const auto listed = json_of(run_pfaff({"list", "integrators", "--json"}).out);
  for (const auto& item : listed["integrators"]) {
    const std::string method = item["name"];
    const auto described = json_of(run_pfaff({"describe", method, "--json"}).out);
    for (const auto& system : described["systems"]) {
      const std::string name = system["name"];
      // Methods for vector fields are shown on one system with constraints, in passing; and where there are
      // many coordinates, orders and Jacobians are left to smaller systems: verification differentiates steps
      // in 32 coordinates at the most.
      if (system.contains("formulation") && name != "spherical-pendulum") continue;
      const auto whole = json_of(run_pfaff({"describe", name, "--json"}).out);
      if (whole["dimension"] > (whole.contains("constraints") ? 16 : 32)) continue;
      EXPECT_TRUE(ordered[method].contains(name)) << method << ": no order on " << name;
      const bool claims = std::any_of(system["preserves"].begin(), system["preserves"].end(),
                                      [](const auto& c) { return of_structure(c); });
      if (claims) {
        EXPECT_TRUE(passed_structure[method].contains(name + " double")) << method << ' ' << name;
        if (method.find("odeint") == std::string::npos) {
          EXPECT_TRUE(passed_structure[method].contains(name + " quad")) << method << ' ' << name;
        }
      }
    }
    // Nonholonomic motion has no symplectic structure that its methods could keep or lose.
    if (described["needs"].get<std::string>().find("velocity-constraints") != std::string::npos) continue;
    EXPECT_FALSE(structured[method].empty()) << method << " has no claim of structure, nor its lack measured";
  }
}

TEST(Verify, Controls) {
  const auto j = passed({"verify", "controls"});
  std::set<std::string> rejected;
  for (const auto& c : j["checks"]) {
    EXPECT_EQ(c["control"], true);
    EXPECT_EQ(c["result"], "rejected");
    rejected.insert(c["plugin"].get<std::string>() + ": " + c["claim"].get<std::string>());
  }
  for (const char* control : {"su-qin (105) as printed: K-symplectic", "su-qin (105) as printed: order",
                              "momenta reversed and stretched by 1e-6: reversal is an involution",
                              "the identity as a reversal: reversal turns the field",
                              "|z|^2 with 1e-6 of a component added: Casimirs"})
    EXPECT_TRUE(rejected.contains(control)) << control;
  for (const char* claim : {"symplectic", "K-symplectic", "poisson", "constrained-symplectic", "conformal",
                            "volume", "symmetric", "reversible", "quadratic-invariants", "momentum-maps",
                            "energy", "casimirs", "entropy", "constraints", "velocity-constraints"})
    EXPECT_TRUE(rejected.contains("rk4: " + std::string(claim))) << claim;
}

TEST(Verify, ChangedCoefficientsAreRejected) {
  for (const std::string method : {"rk4", "verlet", "implicit-midpoint"}) {
    int changed = 0;
    const auto j = passed({"verify", method});
    for (const auto& c : j["checks"])
      if (c["plugin"] == method && c["claim"].get<std::string>().find("changed by 1e-6") != std::string::npos)
        ++changed;
    EXPECT_GT(changed, 0) << method;
  }
}

TEST(Verify, Formulations) {
  for (const std::string formulation : {"lmm", "dirac"}) {
    const auto j = passed({"verify", formulation});
    std::set<std::string> defined;
    int reversed = 0;
    for (const auto& c : j["checks"]) {
      if (c["claim"] != "field is its definition") continue;
      if (c["result"] == "pass")
        defined.insert(c["system"].get<std::string>() + " " + c["scope"].get<std::string>() + " " +
                       c["precision"].get<std::string>());
      reversed += c["control"].get<bool>();
    }
    for (const std::string system : {"spherical-pendulum", "shaken-pendulum", "n-pendulum", "random rods"})
      for (const std::string where : {" on the surface ", " off the surface "})
        for (const std::string precision : {"double", "quad"})
          EXPECT_TRUE(defined.contains(system + where + precision)) << formulation << ' ' << system;
    EXPECT_GT(reversed, 10);
  }
}

TEST(Verify, Text) {
  const Outcome outcome = run_pfaff({"verify", "verlet"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_TRUE(outcome.out.starts_with("ok: "));
  for (const char* shown : {"claim", "worst", "symplectic", "false claims rejected"})
    EXPECT_NE(outcome.out.find(shown), std::string::npos) << shown << '\n' << outcome.out;
  std::istringstream lines(outcome.out);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) EXPECT_LE(line.size(), 100U) << line;
  EXPECT_LE(count, 24);  // a screen
  const Outcome all = run_pfaff({"verify", "verlet", "--verbose"});
  EXPECT_NE(all.out.find("controls, false claims that must be rejected"), std::string::npos) << all.out;
}

TEST(Verify, NothingCheckedIsNotOk) {
  const TemporaryDirectory files;
  const std::string file = files / "map.toml";
  std::ofstream(file) << "name = \"map-of-nothing\"\nkind = \"map\"\norder = 1\nsystem = \"no-such-system\"\n"
                         "coordinates = [\"q\", \"p\"]\nstep = [\"q = q + h*p\", \"p = p - h*q\"]\n";
  const Outcome outcome = run_pfaff({"verify", file});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(outcome.out.starts_with("NOT OK: nothing could be checked, because"))
      << outcome.out << outcome.err;
}

// The rows of a paper are in order, and the misprints among them those that the documentation lists under a
// heading. Returns the equations that have rows.
std::set<std::string> expect_rows(const std::string& paper, const std::string& heading, int misprints) {
  const auto j = passed({"reproduce", paper});
  EXPECT_EQ(keys_of(j), (std::set<std::string>{"schema", "paper", "ok", "rows"}));
  EXPECT_EQ(j["paper"], paper);
  std::set<std::string> equations;
  int errata = 0;
  for (const auto& row : j["rows"]) {
    EXPECT_EQ(keys_of(row), (std::set<std::string>{"id", "section", "equation", "printed", "ours",
                                                   "difference", "tolerance", "status", "erratum"}));
    const std::string status = row["status"], equation = row["equation"];
    equations.insert(equation);
    EXPECT_FALSE(row["printed"].get<std::string>().empty()) << row;
    EXPECT_FALSE(row["ours"].get<std::string>().empty()) << row;
    if (status == "reproduced") {
      EXPECT_LE(row["difference"].get<double>(), row["tolerance"].get<double>()) << row;
      EXPECT_TRUE(row["erratum"].is_null()) << row;
    } else if (status == "improved") {
      EXPECT_GT(row["difference"].get<double>(), row["tolerance"].get<double>()) << row;
      EXPECT_TRUE(row["erratum"].is_null()) << row;
    } else if (status == "erratum") {
      EXPECT_TRUE(row["erratum"].get<std::string>().starts_with(equation)) << row;
      ++errata;
    } else {
      EXPECT_EQ(status, "qualitative") << row;
      EXPECT_FALSE(row["erratum"].get<std::string>().empty()) << row;
    }
  }
  EXPECT_EQ(errata, misprints);
  // Every misprint that the documentation lists has its row, and every row that is one is listed there.
  std::ifstream page(PFAFF_GOLDEN "/../../docs/errata.md");
  std::set<std::string> listed;
  bool here = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("## ")) here = line.find(heading) != std::string::npos;
    if (here && line.starts_with("| ") && !line.starts_with("| equation"))
      listed.insert(line.substr(2, line.find(" |", 2) - 2));
  }
  EXPECT_FALSE(listed.empty());
  for (const std::string& entry : listed) EXPECT_TRUE(equations.contains(entry)) << entry;
  for (const auto& row : j["rows"]) {
    if (row["status"] == "erratum") {
      EXPECT_TRUE(listed.contains(row["equation"].get<std::string>())) << row;
    }
  }
  return equations;
}

TEST(Reproduce, NguyenTurski) { expect_rows("nguyen-turski", "Nguyen & Turski", 14); }
TEST(Reproduce, PitangaRodrigues) { expect_rows("pitanga-rodrigues", "Pitanga & Rodrigues", 24); }
TEST(Reproduce, SuQin) { expect_rows("su-qin", "Su & Qin", 17); }

// Without a paper the output is one JSON value.
TEST(Reproduce, AllPapersTogether) {
  const auto j = passed({"reproduce"});
  EXPECT_EQ(keys_of(j), (std::set<std::string>{"schema", "ok", "papers"}));
  std::vector<std::string> papers;
  for (const auto& paper : j["papers"]) {
    EXPECT_EQ(keys_of(paper), (std::set<std::string>{"paper", "ok", "rows"}));
    EXPECT_FALSE(paper["rows"].empty());
    papers.push_back(paper["paper"]);
  }
  EXPECT_EQ(papers, (std::vector<std::string>{"su-qin", "nguyen-turski", "pitanga-rodrigues", "others"}));
}

// Published numbers of other works: at least twelve, each with the key of its source, which has an entry.
TEST(Reproduce, OtherWorks) {
  const auto j = passed({"reproduce", "others"});
  EXPECT_GE(j["rows"].size(), 12U);
  for (const auto& row : j["rows"]) {
    const std::string equation = row["equation"];
    const Outcome cited = run_pfaff({"cite", equation.substr(0, equation.find(' '))});
    EXPECT_EQ(cited.status, 0) << cited.err;
  }
}

// What there is, without computing it; wide values in full, in a block of lines.
TEST(Reproduce, ListAndWideValues) {
  EXPECT_EQ(json_of(run_pfaff({"reproduce", "--list", "--json"}).out)["papers"].size(), 4U);
  const Outcome list = run_pfaff({"reproduce", "others", "--list"});
  EXPECT_EQ(list.status, 0) << list.err;
  for (const char* shown : {"enright-pryce1987 D5", "number", "rows", "pending: "})
    EXPECT_NE(list.out.find(shown), std::string::npos) << shown;
  const Outcome rows = run_pfaff({"reproduce", "others", "--section", "solutions"});
  EXPECT_EQ(rows.status, 0) << rows.err;
  for (const char* shown : {"enright-pryce1987 D5 Kepler, e = 0.9, at t = 20\n", "  printed ",
                            "-1.295266250987574 0.4003938963792321 -0.6775390924707566"})
    EXPECT_NE(rows.out.find(shown), std::string::npos) << shown << '\n' << rows.out;
  expect_refused({"reproduce", "--list", "--coverage"},
                 {"--list", "expected neither --coverage nor --section"});
}

TEST(Reproduce, Coverage) {
  const auto j = passed({"reproduce", "su-qin", "--coverage"});
  EXPECT_EQ(keys_of(j), (std::set<std::string>{"schema", "paper", "ok", "counts", "items", "faults"}));
  EXPECT_EQ(j["counts"]["pending"], 0);
  EXPECT_EQ(j["counts"]["rows"].get<int>() + j["counts"]["reason"].get<int>(), j["items"].size());
  for (const auto& item : j["items"]) {
    EXPECT_EQ(keys_of(item), (std::set<std::string>{"item", "kind", "cover", "rows", "note"}));
    EXPECT_EQ(item["cover"] == "rows", !item["rows"].empty()) << item;
    EXPECT_EQ(item["cover"] == "rows", item["note"].is_null()) << item;
  }
  const Outcome text = run_pfaff({"reproduce", "--coverage"});
  EXPECT_EQ(text.status, 0) << text.err;
  for (const char* shown :
       {"su-qin", "nguyen-turski", "pitanga-rodrigues", "equation", "pending", "definition of matrices"})
    EXPECT_NE(text.out.find(shown), std::string::npos) << shown;
  std::istringstream lines(text.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
}

TEST(Reproduce, Refusals) {
  expect_refused({"reproduce", "--section", "2"}, {"--section 2", "expected a paper"});
  expect_refused({"reproduce", "su-qin", "--section", "2", "--coverage"}, {"--section and --coverage"});
  expect_refused({"reproduce", "su-qn", "--coverage"}, {"unknown paper 'su-qn'", "did you mean 'su-qin'?"});
}

// Rows stand in the order of the paper's items, whatever their width.
TEST(Reproduce, RowsStandInTheOrderOfThePaper) {
  for (const std::string paper : {"su-qin", "nguyen-turski", "pitanga-rodrigues"}) {
    const nlohmann::json coverage = passed({"reproduce", paper, "--coverage"});
    const nlohmann::json reproduced = passed({"reproduce", paper});
    std::map<std::string, std::size_t> place;
    for (const auto& item : coverage["items"]) place.emplace(item["item"], place.size());
    std::size_t before = 0;
    for (const auto& row : reproduced["rows"]) {
      const std::string equation = row["equation"];
      std::size_t first = std::string::npos;  // the longest item that the name of the row begins with
      std::size_t longest = 0;
      for (const auto& [item, at] : place)
        if (equation.starts_with(item) && item.size() > longest) first = at, longest = item.size();
      ASSERT_NE(first, std::string::npos) << equation;
      EXPECT_GE(first, before) << paper << ": " << row["id"];
      before = first;
    }
  }
}

TEST(Reproduce, Text) {
  const Outcome outcome = run_pfaff({"reproduce"});
  EXPECT_EQ(outcome.status, 0);
  for (const char* shown : {"su-qin\n", "reproduced", "improved", "erratum", "qualitative", "difference"})
    EXPECT_NE(outcome.out.find(shown), std::string::npos) << shown;
  EXPECT_EQ(outcome.out.find("FAILED"), std::string::npos);
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
  EXPECT_NE(outcome.out.find("which scheme is best: (105), corrected"), std::string::npos);
  // Rounding noise, which is 1e-33 in quad, is shown as no number.
  EXPECT_FALSE(std::regex_search(outcome.out, std::regex("e-3[0-9]")));
  EXPECT_EQ(run_pfaff({"reproduce", "nguyen-turski", "--section", "brackets"}).status, 0);
  EXPECT_EQ(run_pfaff({"reproduce", "pitanga-rodrigues", "--section", "transverse"}).status, 0);
  for (const char* section : {"2", "3", "4", "5"})
    EXPECT_EQ(run_pfaff({"reproduce", "su-qin", "--section", section}).status, 0);
}

}  // namespace
