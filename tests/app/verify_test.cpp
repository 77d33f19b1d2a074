// pfaff verify and pfaff reproduce: their formats, and that nothing claimed goes untested.
#include <algorithm>
#include <fstream>
#include <map>
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
std::set<std::string> keys_of(const nlohmann::json& object) {
  std::set<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.insert(key);
  return keys;
}
bool of_structure(const std::string& claim) {
  return claim == "K-symplectic" || claim == "symplectic" || claim == "constrained-symplectic";
}

TEST(Verify, EveryClaimOfEveryMethod) {
  const auto j = passed({"verify"});
  EXPECT_EQ(keys_of(j), (std::set<std::string>{"schema", "ok", "counts", "checks"}));
  std::map<std::string, int> counts{
      {"pass", 0}, {"fail", 0}, {"measured", 0}, {"rejected", 0}, {"skipped", 0}};
  std::map<std::string, std::set<std::string>> ordered, structured, measured, passed_structure;
  int controls = 0;
  for (const auto& c : j["checks"]) {
    for (const char* key : {"plugin", "claim", "scope", "system", "precision", "parameters", "measured",
                            "expected", "tolerance", "in_scope", "control", "result"})
      EXPECT_TRUE(c.contains(key)) << key;
    const std::string result = c["result"], claim = c["claim"], plugin = c["plugin"];
    ++counts[result];
    controls += c["control"].get<bool>();
    EXPECT_EQ(result == "rejected", c["control"].get<bool>()) << c;
    EXPECT_EQ(result == "measured" || result == "skipped", !c["in_scope"].get<bool>()) << c;
    if (result == "skipped") {
      EXPECT_FALSE(c.value("reason", "").empty()) << c;
      EXPECT_TRUE(plugin.starts_with("odeint-")) << c;
    }
    if (c["control"]) continue;
    if (claim == "order" && result == "pass") ordered[plugin].insert(c["system"]);
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
      // many coordinates, orders and Jacobians are left to smaller systems.
      if (system.contains("formulation") && name != "spherical-pendulum") continue;
      const auto whole = json_of(run_pfaff({"describe", name, "--json"}).out);
      if (whole.contains("constraints") && whole["dimension"] > 16) continue;
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
  for (const char* control : {"rk4: symplectic", "rk4: K-symplectic", "su-qin (105) as printed: K-symplectic",
                              "su-qin (105) as printed: order"})
    EXPECT_TRUE(rejected.contains(control)) << control;
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

TEST(Verify, Text) {
  const Outcome outcome = run_pfaff({"verify", "verlet"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_TRUE(outcome.out.ends_with(": ok\n"));
  for (const char* shown : {"claim", "worst in scope", "symplectic", "controls rejected", "0 fail"})
    EXPECT_NE(outcome.out.find(shown), std::string::npos) << shown << '\n' << outcome.out;
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
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
    } else if (status == "erratum") {
      EXPECT_GT(row["difference"].get<double>(), 1e-6) << row;
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

TEST(Reproduce, NguyenTurski) {
  const auto equations = expect_rows("nguyen-turski", "Nguyen & Turski", 15);
  for (const char* needed :
       {"(1.2)",         "(2.1)",          "(3.2)",  "(3.3)",  "(3.5)",    "(3.6), (3.7)",    "(3.8)-(3.10)",
        "(3.11)-(3.14)", "(3.15), (3.16)", "(3.17)", "(3.18)", "(3.19)",   "(3.20)",          "(3.21)",
        "Example 3.1",   "Proposition 6",  "(C.2)",  "(4.1)",  "(4.2)",    "(4.7), (A.5)",    "(A.1)-(A.5)",
        "(B.4)",         "(B.5)",          "(C.3)",  "(C.17)", "figure 2", "metric potential"})
    EXPECT_TRUE(equations.contains(needed)) << needed;
}
TEST(Reproduce, PitangaRodrigues) {
  const auto equations = expect_rows("pitanga-rodrigues", "Pitanga & Rodrigues", 3);
  for (const char* needed : {"(13)", "(15)", "(17)", "after (17)"})
    EXPECT_TRUE(equations.contains(needed)) << needed;
}

TEST(Reproduce, SuQin) {
  const auto equations = expect_rows("su-qin", "Su & Qin", 20);
  for (const char* needed : {"(8)", "(38)", "(52)", "(59)", "(75)", "(78)", "(82)"})
    EXPECT_TRUE(equations.contains(needed)) << needed;
  for (int k = 93; k <= 107; ++k) {
    const std::string number = "(" + std::to_string(k);
    EXPECT_TRUE(std::any_of(equations.begin(), equations.end(), [&](const std::string& e) {
      return e.starts_with(number);
    })) << number;
  }
}

TEST(Reproduce, Text) {
  const Outcome outcome = run_pfaff({"reproduce"});
  EXPECT_EQ(outcome.status, 0);
  for (const char* shown : {"su-qin\n", "reproduced", "erratum", "qualitative", "difference"})
    EXPECT_NE(outcome.out.find(shown), std::string::npos) << shown;
  EXPECT_EQ(outcome.out.find("FAILED"), std::string::npos);
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
  EXPECT_EQ(run_pfaff({"reproduce", "nguyen-turski", "--section", "brackets"}).status, 0);
  EXPECT_EQ(run_pfaff({"reproduce", "pitanga-rodrigues", "--section", "transverse"}).status, 0);
  for (const char* section : {"2", "3", "4", "5"})
    EXPECT_EQ(run_pfaff({"reproduce", "su-qin", "--section", section}).status, 0);
}

}  // namespace
