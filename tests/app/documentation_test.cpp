// The documentation agrees with the program. A block of code on a page stands, unchanged, in a file of
// examples/templates, which other tests build and run, so that code shown is code that compiles. The page of
// plug-ins and the table of facets are what the program prints. Files that pages name or link to exist.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <pfaff/bench/runner/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <vector>

#include "command.hpp"

namespace {

const std::string source = PFAFF_GOLDEN "/../..";

std::string contents(const std::string& file) {
  std::ifstream in(source + "/" + file);
  EXPECT_TRUE(in) << file;
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}
std::vector<std::string> blocks(const std::string& page) {
  const std::string open = "```cpp\n", close = "```";
  std::vector<std::string> found;
  for (std::size_t at = page.find(open); at != std::string::npos; at = page.find(open, at)) {
    at += open.size();
    const std::size_t end = page.find(close, at);
    found.push_back(page.substr(at, end - at));
    at = end + close.size();
  }
  return found;
}

TEST(Documentation, CodeOfGeneratingFunctionsIsCompiled) {
  const std::string compiled =
      contents("examples/templates/birkhoffian_system.cpp") + contents("examples/templates/alpha.hpp");
  const auto shown = blocks(contents("docs/generating-functions.md"));
  ASSERT_EQ(shown.size(), 2U);
  for (const std::string& block : shown) {
    EXPECT_GT(block.size(), 200U);
    EXPECT_NE(compiled.find(block), std::string::npos) << block;
  }
  std::string changed = shown[0];  // control: one character
  changed[changed.find('4')] = '5';
  EXPECT_EQ(compiled.find(changed), std::string::npos);
}

// What verification leaves out is said on its page, with the numbers of the code; no page promises more.
TEST(Documentation, LimitsOfVerificationAreThoseOfTheCode) {
  const auto number = [](const std::string& file, const std::string& name) {
    const std::string text = contents(file);
    std::smatch match;
    EXPECT_TRUE(std::regex_search(text, match, std::regex("[ ]" + name + " = ([0-9]+)")))
        << file << ' ' << name;
    return match[1].str();
  };
  const auto one_line = [](const std::string& file) {
    return std::regex_replace(contents(file), std::regex("\\s+"), " ");
  };
  const std::string of_methods = "verify/method_on_model.cpp", page = one_line("docs/verification.md");
  EXPECT_NE(page.find("systems of more than " + number(of_methods, "most_differentiated") + " coordinates"),
            std::string::npos);
  EXPECT_NE(page.find("or more than " + number(of_methods, "most_differentiated_in_formulations") +
                      " where the method runs in a formulation"),
            std::string::npos);
  EXPECT_NE(
      one_line("docs/drift-and-cost.md")
          .find("nor beyond " + number("runs/measures/structure.cpp", "most_coordinates") + " coordinates"),
      std::string::npos);
  for (const char* file : {"README.md", "CONTRIBUTING.md", "docs/verification.md", "docs/drift-and-cost.md",
                           "docs/formulations.md", "docs/glossary.md"})
    for (const char* promise : {"the actual step", "measured and shown", "very claim on every system",
                                "very claim of every plug-in", "very claim a plug-in makes",
                                "very claim it makes", "each `Claim` on every system"})
      EXPECT_EQ(one_line(file).find(promise), std::string::npos) << file << ": " << promise;
}

TEST(Documentation, ThePageOfPlugInsIsWhatTheProgramPrints) {
  const auto outcome = pfaff::testing::run_pfaff({"list", "--markdown"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, contents("docs/plugins.md"))
      << "expected docs/plugins.md to be the output of: pfaff list --markdown";
  for (const char* name : {"`pendulum`", "`rk4`", "`canonical`", "`lmm`"})
    EXPECT_NE(outcome.out.find(name), std::string::npos) << name;
}

TEST(Documentation, ThePageOfMethodsIsWhatTheProgramPrints) {
  const auto outcome = pfaff::testing::run_pfaff({"list", "integrators", "--markdown"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, contents("docs/methods.md"))
      << "expected docs/methods.md to be the output of: pfaff list integrators --markdown";
  // A row by hand: Stoermer-Verlet is of order 2, symplectic, symmetric and reversible.
  EXPECT_NE(
      outcome.out.find("\n| method | order | symplectic | K-symplectic | poisson | conformal | symmetric | "
                       "reversible |\n"),
      std::string::npos);
  EXPECT_NE(outcome.out.find("\n| `verlet` | 2 | 2 | | | | 2 | 2 |\n"), std::string::npos);
}

TEST(Documentation, CodeOfProgramsIsCompiled) {  // by app/out_of_tree, which runs it too
  const std::string compiled = contents("examples/program/tour.cpp");
  const auto shown = blocks(contents("docs/cpp.md"));
  ASSERT_EQ(shown.size(), 5U);
  for (const std::string& block : shown) EXPECT_NE(compiled.find(block), std::string::npos) << block;
}

TEST(Documentation, TheTableOfFacetsIsThatOfTheProgram) {
  const auto outcome = pfaff::testing::run_pfaff({"list", "facets", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto list = nlohmann::json::parse(outcome.out);
  std::string table = "| facet | meaning | formulas |\n|---|---|---|\n";
  for (const auto& facet : list["facets"]) {
    table += "| `" + facet["name"].get<std::string>() + "` | " + facet["meaning"].get<std::string>() + " |";
    const char* separator = " `";
    for (const auto& formula : facet["formulas"]) {
      table += separator + formula["name"].get<std::string>() + "`";
      separator = ", `";
    }
    table += " |\n";
  }
  const std::string page = contents("docs/architecture.md");
  EXPECT_NE(page.find("\n\n" + table + "\n"), std::string::npos)
      << "docs/architecture.md: expected the table of facets as\n"
      << table;
  table[table.find("vector-field")] = 'V';  // control: one character
  EXPECT_EQ(page.find(table), std::string::npos);
}

// Every text that begins like a path from the top of the tree, wherever a page has it.
std::set<std::string> files_named(const std::string& page) {
  static const std::regex path(
      R"((^|[^\w./-])((core|brackets|formulations|systems|integrators|runs(?=/[a-z])|bench|verify|derive|papers|app|tests|docs|examples|cmake|\.ci)/[\w./-]*))");
  std::set<std::string> files;
  for (std::sregex_iterator at(page.begin(), page.end(), path), end; at != end; ++at) {
    std::string file = (*at)[2];
    while (file.ends_with('.')) file.pop_back();  // of the sentence
    files.insert(file);
  }
  return files;
}
// The sections of a page, as links name them.
std::set<std::string> sections_of(const std::string& page) {
  std::set<std::string> sections;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find_first_not_of('#');
    if (begin == 0 || begin == std::string::npos || line[begin] != ' ') continue;
    std::string section;
    for (const char c : line.substr(begin + 1))
      if (c == ' ') {
        section += '-';
      } else if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_') {
        section += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      }
    sections.insert(section);
  }
  return sections;
}
std::vector<std::string> missing(const std::set<std::string>& files, const std::filesystem::path& folder) {
  std::vector<std::string> gone;
  std::copy_if(files.begin(), files.end(), std::back_inserter(gone),
               [&](const std::string& file) { return !std::filesystem::exists(folder / file); });
  return gone;
}
// The links [text](file#section) of a page in this folder that lead nowhere; those to other sites are not
// looked at.
std::vector<std::string> broken_links(std::string page, const std::string& folder) {
  // In blocks of code brackets and parentheses are no links.
  for (std::size_t at = page.find("```cpp\n"); at != std::string::npos; at = page.find("```cpp\n")) {
    const std::size_t end = page.find("\n```", at);
    page.erase(at, end == std::string::npos ? end : end + 4 - at);
  }
  static const std::regex link(R"(\]\(([^)#]*)#?([^)]*)\))");
  std::vector<std::string> broken;
  for (std::sregex_iterator at(page.begin(), page.end(), link), end; at != end; ++at) {
    const std::string file = (*at)[1], section = (*at)[2];
    if (file.find("://") != std::string::npos) continue;
    const std::string path = folder + "/" + file;
    const bool there = std::filesystem::exists(source + "/" + path);
    if (!there || (!section.empty() && !sections_of(file.empty() ? page : contents(path)).contains(section)))
      broken.push_back(file + (section.empty() ? "" : "#" + section));
  }
  return broken;
}

TEST(Documentation, FilesThatPagesNameAreThere) {
  std::vector<std::string> pages{"README.md", "CONTRIBUTING.md", "examples/README.md"};
  for (const auto& entry : std::filesystem::directory_iterator(source + "/docs"))
    if (entry.path().extension() == ".md") pages.push_back("docs/" + entry.path().filename().string());
  const std::vector<std::string> none;
  for (const std::string& page : pages) {
    const std::string text = contents(page);
    EXPECT_EQ(missing(files_named(text), source), none) << page;
    EXPECT_EQ(broken_links(text, std::filesystem::path(page).parent_path().string()), none) << page;
  }
  // These two are maps: that their files are found at all shows that the test reads them.
  EXPECT_GT(files_named(contents("docs/architecture.md")).size(), 50U);
  EXPECT_GT(files_named(contents("docs/glossary.md")).size(), 20U);
}
TEST(Documentation, AFileThatIsNotThereIsFound) {  // the control of the test above
  const std::string page =
      "# A page\nClaims (`core/facets/claim_rows.hpp`) are checked in verify/claim_check.cpp. "
      "See "
      "[them](verification.md#claims), [it](verification.md#what-a-method-may-claim), [that](claim.md), "
      "[this](#a-page), [nothing](#page) and [more](https://example.org/core/none.hpp).";
  EXPECT_EQ(missing(files_named(page), source), std::vector<std::string>{"verify/claim_check.cpp"});
  EXPECT_EQ(broken_links(page, "docs"),
            (std::vector<std::string>{"verification.md#claims", "claim.md", "#page"}));
}

// The first block is a system with the reasons of its lines beside them (examples/plugin/duffing.cpp).
TEST(Documentation, CodeOfContributingIsCompiled) {
  const auto shown = blocks(contents("CONTRIBUTING.md"));
  ASSERT_EQ(shown.size(), 2U);
  EXPECT_NE(contents("examples/templates/multistep_integrator.cpp").find(shown[1]), std::string::npos)
      << shown[1];
}

TEST(Documentation, CodeOfConstraintsIsCompiled) {
  const auto shown = blocks(contents("docs/constraints.md"));
  ASSERT_EQ(shown.size(), 1U);
  EXPECT_NE(contents("examples/templates/tests/bracket_test.cpp").find(shown[0]), std::string::npos)
      << shown[0];
}

}  // namespace
