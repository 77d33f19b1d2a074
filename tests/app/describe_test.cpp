// pfaff list, describe, cite and --help: what they print, as JSON and as text of at most 100 columns.
#include <algorithm>
#include <map>
#include <set>

#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

std::string printed(const Arguments& arguments) {
  const Outcome outcome = run_pfaff(arguments);
  EXPECT_EQ(outcome.status, 0) << joined(arguments) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  return outcome.out;
}
nlohmann::json asked(const Arguments& arguments) {
  const auto j = json_of(printed(arguments + Arguments{"--json"}));
  EXPECT_EQ(j["schema"], 1) << joined(arguments);
  return j;
}
std::set<std::string> names_of(const nlohmann::json& list) {
  std::set<std::string> names;
  for (const auto& item : list) names.insert(item["name"]);
  return names;
}
void expect_narrow(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; }), 100)
        << line;
    EXPECT_FALSE(line.ends_with(' ')) << "'" << line << "'";
  }
}

TEST(List, KindsAndNames) {
  const auto all = asked({"list"});
  EXPECT_EQ(keys_of(all), (std::set<std::string>{"schema", "systems", "integrators", "brackets",
                                                 "formulations", "measures", "experiments"}));
  for (const char* name : {"damped-oscillator", "damped-pendulum", "henon-heiles", "kepler"})
    EXPECT_TRUE(names_of(all["systems"]).contains(name)) << name;
  for (const char* name : {"generating-function", "gauss", "verlet", "rk4"})
    EXPECT_TRUE(names_of(all["integrators"]).contains(name)) << name;
  for (const char* name : {"dirac", "simplified-dirac", "lmm", "ggl"})
    EXPECT_TRUE(names_of(all["formulations"]).contains(name)) << name;
  for (const char* kind : {"systems", "integrators", "brackets", "formulations", "measures", "experiments"}) {
    EXPECT_EQ(asked({"list", kind})[kind], all[kind]);
    const std::string text = printed({"list", kind});
    for (const auto& item : all[kind]) {
      EXPECT_FALSE(item["title"].get<std::string>().empty());
      EXPECT_NE(text.find("  " + item["name"].get<std::string>() + " "), std::string::npos) << item["name"];
    }
  }
}

// Who offers a facet and who needs it is what `describe` says of each system and each integrator.
TEST(List, FacetsWithTheirFormulasAndWhoOffersAndNeedsThem) {
  const auto facets = asked({"list", "facets"})["facets"];
  const std::set<std::string> names = names_of(facets);
  EXPECT_TRUE(names.contains("vector-field") && names.contains("velocity-constraints"));
  std::set<std::string> in_use;
  const auto check = [&](const char* name, const char* key, const char* others) {
    const std::string said = asked({"describe", name})[key];
    for (const auto& facet : facets) {
      const auto& list = facet[others];
      const bool listed = std::find(list.begin(), list.end(), name) != list.end();
      const bool has = (", " + said + ",").find(", " + facet["name"].get<std::string>() + ",") != said.npos;
      EXPECT_EQ(listed, has) << name << " " << facet["name"];
      if (listed) in_use.insert(facet["name"]);
    }
  };
  for (const char* name : {"henon-heiles", "damped-oscillator", "spherical-pendulum", "free-rigid-body"})
    check(name, "facets", "offered_by");
  EXPECT_GE(in_use.size(), 6U);
  in_use.clear();
  for (const char* name : {"verlet", "rk4", "rattle", "gauss-darboux"}) check(name, "needs", "needed_by");
  EXPECT_GE(in_use.size(), 4U);
  for (const auto& facet : facets) {
    EXPECT_FALSE(facet["meaning"].get<std::string>().empty()) << facet["name"];
    EXPECT_FALSE(facet["formulas"].empty()) << facet["name"];
    if (facet["name"] == "separable") {
      EXPECT_EQ(names_of(facet["formulas"]),
                (std::set<std::string>{"kinetic", "potential", "force", "velocity"}));
      EXPECT_EQ(facet["formulas"][0]["written"], "kinetic(t, p)");
    }
  }
  for (const auto& facet : facets) {
    const auto& needed = facet["needed_by"];
    EXPECT_EQ(std::find(needed.begin(), needed.end(), "lmm") != needed.end(), facet["name"] == "holonomic");
  }
  const std::string text = printed({"list", "facets"});
  expect_narrow(text);
  for (const std::string& name : names) EXPECT_NE(text.find("\n  " + name + " "), std::string::npos) << name;
}

// Of formulas, `describe` says which are written and what the others come from.
TEST(Describe, Formulas) {
  std::map<std::string, std::string> origin;
  const auto described = asked({"describe", "damped-pendulum"});
  for (const auto& formula : described["formulas"]) origin[formula["name"]] = formula["origin"];
  EXPECT_EQ(origin["one_form"], "written, one_form(t, z, form)");
  EXPECT_EQ(origin["structure"], "derived from one_form");
  EXPECT_EQ(origin["field_jacobian"], "derived from field");
  EXPECT_FALSE(origin.contains("hamiltonian") || origin.contains("constraints"));
}

TEST(Describe, Systems) {
  const auto j = asked({"describe", "damped-pendulum"});
  EXPECT_EQ(j["kind"], "system");
  EXPECT_EQ(j["dimension"], 2);
  EXPECT_NE(j["facets"].get<std::string>().find("birkhoffian"), std::string::npos);
  const nlohmann::json r{{"name", "r"}, {"unit", "rad"}, {"initial", "1"}};
  EXPECT_EQ(j["coordinates"][0], r);
  EXPECT_EQ(j["invariants"][0]["name"], "energy");
  EXPECT_EQ(j["invariants"][0]["expected"], "decreasing");
  EXPECT_EQ(j["parameters"][0]["name"], "nu");
  EXPECT_EQ(j["parameters"][0]["default"], "0.3");
  EXPECT_EQ(j["parameters"][0]["range"], "0 .. 10 1/s");
  std::set<std::string> fitting;
  for (const auto& name : j["integrators"]) fitting.insert(name);
  EXPECT_TRUE(fitting.contains("generating-function"));
  EXPECT_FALSE(fitting.contains("verlet"));
}

TEST(Describe, ASystemAndTheExperimentOfItsName) {
  const auto j = asked({"describe", "damped-oscillator"});
  EXPECT_EQ(j["kind"], "system");
  ASSERT_EQ(j["also"].size(), 1U);
  EXPECT_EQ(j["also"][0]["kind"], "experiment");
  EXPECT_EQ(j["also"][0]["name"], "damped-oscillator");
  EXPECT_EQ(j["also"][0]["cases"][0]["name"], "weak-damping");
  const std::string text = printed({"describe", "damped-oscillator"});
  const std::size_t system = text.find("kind        system\n"),
                    experiment = text.find("kind       experiment\n");
  EXPECT_LT(system, experiment);
  EXPECT_NE(experiment, std::string::npos) << text;
  EXPECT_NE(text.find("reference  su-qin, "), std::string::npos) << "a list is not shown as JSON";
  EXPECT_FALSE(asked({"describe", "free-rigid-body"}).contains("also"));
}

TEST(Describe, Integrators) {
  const auto j = asked({"describe", "verlet"});
  EXPECT_EQ(j["kind"], "integrator");
  EXPECT_EQ(j["needs"], "separable");
  EXPECT_EQ(j["adaptive"], false);
  EXPECT_TRUE(names_of(j["systems"]).contains("kepler"));
  EXPECT_FALSE(names_of(j["systems"]).contains("damped-pendulum"));
  for (const auto& system : j["systems"]) EXPECT_EQ(system["order"], 2);
  // What is said to be kept is kept there: the midpoint rule's claim is about the canonical structure.
  const auto midpoint = asked({"describe", "implicit-midpoint"});
  for (const auto& system : midpoint["systems"]) {
    const auto& preserves = system["preserves"];
    const bool said = std::find(preserves.begin(), preserves.end(), "symplectic") != preserves.end();
    // Those with an energy and Darboux coordinates have the canonical bracket here, but for those of
    // Birkhoff's form; the rigid body and the top have none.
    const std::string name = system["name"];
    const std::string facets = asked({"describe", name})["facets"];
    const bool canonical =
        facets.find("hamiltonian") != std::string::npos && facets.find("darboux-chart") != std::string::npos;
    EXPECT_EQ(said, canonical) << system;
  }
}

TEST(Describe, ACompositionSaysWhichBasesThereAre) {
  const auto j = asked({"describe", "composition"});
  const nlohmann::json base{
      {"name", "base"},
      {"default", "midpoint-darboux(compensated=yes)"},
      {"range", "conformal-splitting|dla|implicit-midpoint|midpoint-darboux|rattle|verlet"},
      {"unit", ""},
      {"meaning", "the symmetric method of order 2 that takes the sub-steps"}};
  EXPECT_EQ(j["parameters"][2], base);
  EXPECT_EQ(j["parameters"][0]["range"], "yoshida|suzuki|kahan-li");
}

TEST(Describe, AliasesAreDescribedAndNotListed) {
  const auto j = asked({"describe", "kahan-li-verlet"});
  EXPECT_EQ(j["name"], "kahan-li-verlet");
  EXPECT_EQ(j["title"], "composition with scheme=kahan-li, base=verlet");
  EXPECT_EQ(j["needs"], "separable");
  ASSERT_EQ(j["parameters"].size(), 2U);
  EXPECT_EQ(j["parameters"][0]["default"], "6");
  EXPECT_EQ(j["parameters"][1]["name"], "compensated");
  EXPECT_EQ(j["parameters"][1]["range"], "yes|no");
  expect_narrow(printed({"describe", "kahan-li-verlet"}));
  EXPECT_FALSE(names_of(asked({"list"})["integrators"]).contains("kahan-li-verlet"));
}

// Why a text is no description of a plug-in; empty where it is one.
std::string fault_of(const std::string& description) {
  int sentences = 0;
  for (std::size_t k = 0; k < description.size(); ++k)
    sentences += description[k] == '.' && (k + 1 == description.size() || description[k + 1] == ' ');
  if (sentences < 2) return "fewer than two sentences";
  if (description.size() > 600) return "more than 600 characters";
  return description.ends_with('.') ? "" : "does not end with a sentence";
}
// Every plug-in says what it is and when to take it. What is printed is looked at in one test, since each
// description takes a process, and those are slow to start with the sanitizers.
TEST(Describe, EverythingThatIsListedWithin100Columns) {
  const auto all = asked({"list"});
  expect_narrow(printed({"list"}));
  for (const char* kind : {"systems", "integrators", "brackets", "formulations", "experiments"})
    for (const std::string& name : names_of(all[kind])) {
      const std::string text = printed({"describe", name});
      expect_narrow(text);
      const auto j = asked({"describe", name});
      EXPECT_EQ(j["name"], name);
      if (kind != std::string("experiments")) {
        EXPECT_EQ(j["kind"].get<std::string>() + "s", kind);
        EXPECT_EQ(fault_of(j.value("description", "")), "") << kind << ' ' << name;
      }
      EXPECT_FALSE(j["title"].get<std::string>().empty()) << name;
      for (const auto& key : j.value("parameters", nlohmann::json::array()))
        EXPECT_NE(text.find(key["name"].get<std::string>()), std::string::npos) << name << ' ' << key;
    }
}

TEST(Describe, Formulations) {
  const auto j = asked({"describe", "lmm"});
  EXPECT_EQ(j["kind"], "formulation");
  EXPECT_EQ(j["reactions"], "ideal");
  EXPECT_EQ(j["friction"], "stokes");
  EXPECT_EQ(j["keeps"], nlohmann::json({"tangent", "hidden-constraints"}));
  EXPECT_TRUE(names_of(j["systems"]).contains("n-pendulum"));
  EXPECT_FALSE(names_of(j["systems"]).contains("guiding-centre"));
  const auto dirac = asked({"describe", "dirac"});
  EXPECT_EQ(dirac["friction"], "metriplectic");
  EXPECT_TRUE(names_of(dirac["systems"]).contains("guiding-centre"));
}

TEST(Describe, TextsThatAreNoDescriptionAreTold) {
  for (const std::string& control : {std::string(), std::string("One sentence."), std::string("No sentence"),
                                     std::string("One. Two"), "One." + std::string(600, ' ') + "Two."})
    EXPECT_NE(fault_of(control), "") << control;
}
TEST(Describe, TheDescriptionIsAParagraphOf80Columns) {
  const std::string text = printed({"describe", "rk4"});
  const std::size_t begin = text.find("\n\n") + 2, end = text.find("\n\n", begin);
  std::istringstream lines(text.substr(begin, end - begin));
  std::string joined_again;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 80U) << line;
    joined_again += (joined_again.empty() ? "" : " ") + line;
  }
  EXPECT_EQ(joined_again, asked({"describe", "rk4"})["description"].get<std::string>());
}

TEST(Cite, PlugInsAndKeys) {
  const auto j = asked({"cite", "damped-pendulum", "su-qin"});
  ASSERT_EQ(j["entries"].size(), 1U) << "each key once";
  EXPECT_EQ(j["entries"][0]["key"], "su-qin");
  EXPECT_NE(j["entries"][0]["bibtex"].get<std::string>().find("{su-qin,"), std::string::npos);
  EXPECT_NE(j["entries"][0]["citation"].get<std::string>().find("Su"), std::string::npos);
  EXPECT_EQ(printed({"cite", "su-qin"}), j["entries"][0]["bibtex"].get<std::string>() + "\n");
}

// A name without a key would be an error of the whole command.
TEST(Cite, EverythingThatIsListedHasSomethingToCite) {
  const auto all = asked({"list"});
  Arguments command{"cite"};
  for (const char* kind : {"systems", "integrators", "brackets", "formulations", "experiments"})
    for (const std::string& name : names_of(all[kind])) command.push_back(name);
  EXPECT_GT(command.size(), 100U);
  EXPECT_GT(asked(command)["entries"].size(), 50U);
  command.emplace_back("no-such-name");  // control
  EXPECT_EQ(run_pfaff(command).status, 2);
}

TEST(Help, EveryCommand) {
  const std::string help = printed({"--help"});
  expect_narrow(help);
  EXPECT_NE(help.find("Exit status: 0 fine"), std::string::npos);
  EXPECT_TRUE(help.ends_with('\n'));
  for (const std::string command : {"list", "describe", "cite", "run", "compare", "reproduce", "verify",
                                    "falsify", "evaluate", "derive"}) {
    EXPECT_NE(help.find("\n  " + command + " "), std::string::npos) << command;
    const std::string text = printed({command, "--help"});
    expect_narrow(text);
    EXPECT_NE(text.find("--json"), std::string::npos);
    EXPECT_NE(text.find("--plugin FILE"), std::string::npos);
  }
  EXPECT_EQ(printed({"--version"}).substr(0, 6), "pfaff ");
}

}  // namespace
