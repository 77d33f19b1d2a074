// Reproductions: that no row passes when what the paper prints is changed a little, that the printed side
// knows nothing of the engine, and that nothing of a paper is left out of its coverage.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/papers/coverage/coverage.hpp>

#include "../temporary_directory.hpp"

namespace {

using namespace pfaff;
namespace fs = std::filesystem;

// The rows of each paper, computed once.
const std::vector<ReproducedRow>& rows_of(const std::string& paper) {
  static std::map<std::string, std::vector<ReproducedRow>> known;
  const auto found = known.find(paper);
  return found != known.end() ? found->second : known.emplace(paper, reproduce(paper, "")).first->second;
}

// The evidence with the number in one place changed by ten times the tolerance, or in its 30th digit where
// the number is so large that quad would not notice.
Evidence with_change(Evidence evidence, Numbers Evidence::*where, std::size_t k) {
  Quad& number = (evidence.*where)[k];
  const auto size = std::abs(static_cast<double>(number));
  number += Quad(std::max(10 * evidence.tolerance, 1e-29 * size));
  return evidence;
}

class Reproduce : public ::testing::TestWithParam<std::string> {};

TEST_P(Reproduce, EveryRowIsInOrder) {
  for (const ReproducedRow& row : rows_of(GetParam())) {
    EXPECT_NE(row.status, "failed") << row.id << ": printed " << row.printed << ", ours " << row.ours
                                    << ", difference " << row.difference;
    EXPECT_EQ(row.status, judge(row.evidence)) << row.id;
  }
}

TEST_P(Reproduce, APrintedNumberChangedALittleFails) {
  int changed = 0;
  for (const ReproducedRow& row : rows_of(GetParam())) {
    const Evidence& e = row.evidence;
    SCOPED_TRACE(row.id);
    if (e.kind == Evidence::Kind::value)
      for (std::size_t k = 0; k < e.printed.size(); ++k, ++changed) {
        EXPECT_EQ(judge(with_change(e, &Evidence::printed, k)), "failed");
        EXPECT_EQ(judge(with_change(e, &Evidence::ours, k)), "failed");
      }
    if (e.kind == Evidence::Kind::order) {
      // An order below the stated one is a failure, one above it an improvement only by a whole order.
      Evidence stated = e;
      stated.printed.front() = e.ours.front() + Quad(0.5);
      EXPECT_EQ(judge(stated), "failed");
      stated.printed.front() = e.ours.front() - Quad(0.5);
      EXPECT_EQ(judge(stated), "failed");
    }
    if (e.kind == Evidence::Kind::misprint) {
      // A misprint is none where what is printed is right, and not known where the corrected form is wrong.
      Evidence right = e;
      right.printed = right.ours;
      EXPECT_EQ(judge(right), "failed");
      for (std::size_t k = 0; k < e.corrected.size(); ++k, ++changed)
        EXPECT_EQ(judge(with_change(e, &Evidence::corrected, k)), "failed");
    }
  }
  EXPECT_GT(changed, GetParam() == "others" ? 50 : 100);
}

TEST_P(Reproduce, EveryConditionCanFail) {
  for (const ReproducedRow& row : rows_of(GetParam())) {
    const bool property =
        row.evidence.kind == Evidence::Kind::claim || row.evidence.kind == Evidence::Kind::property;
    EXPECT_EQ(property, !row.evidence.conditions.empty()) << row.id;
    for (std::size_t k = 0; k < row.evidence.conditions.size(); ++k) {
      Evidence broken = row.evidence;
      Condition& c = broken.conditions[k];
      c.value = c.bound + (c.relation == Condition::Relation::at_most ? 1e-3 : -1e-3);
      EXPECT_EQ(judge(broken), "failed") << row.id << ", condition " << k;
      c.value = std::numeric_limits<double>::quiet_NaN();
      EXPECT_EQ(judge(broken), "failed") << row.id << ", condition " << k;
    }
  }
}

TEST_P(Reproduce, RowsAreIdentifiedByTheirNames) {
  std::set<std::string> names;
  for (const ReproducedRow& row : rows_of(GetParam()))
    EXPECT_TRUE(names.insert(row.id).second) << row.id << " stands there twice";
}

// A section is computed by itself, and its rows are those that it has among all.
TEST_P(Reproduce, SectionsMakeUpTheWhole) {
  std::map<std::string, std::vector<std::string>> sections;
  for (const ReproducedRow& row : rows_of(GetParam())) sections[row.section].push_back(row.id);
  for (const auto& [section, ids] : sections) {
    std::vector<std::string> alone;
    for (const ReproducedRow& row : reproduce(GetParam(), section)) alone.push_back(row.id);
    EXPECT_EQ(alone, ids) << section;
  }
}

TEST_P(Reproduce, CoverageHasNoFaults) {
  const Coverage coverage = coverage_of(GetParam(), items_of(GetParam()), rows_of(GetParam()));
  for (const std::string& fault : coverage.faults) ADD_FAILURE() << fault;
}

INSTANTIATE_TEST_SUITE_P(Papers, Reproduce, ::testing::ValuesIn(papers()), [](const auto& paper) {
  std::string name;
  for (const char c : paper.param) name += c == '-' ? '_' : c;
  return name;
});

TEST(Judgement, KnowsWhatIsBetterAndWhatIsWorse) {
  const auto order = [](double printed, double ours) {
    return judge({Evidence::Kind::order, {Quad(printed)}, {}, {Quad(ours)}, {}, 0.05});
  };
  EXPECT_EQ(order(1, 1.02), "reproduced");
  EXPECT_EQ(order(1, 1.99), "improved");
  EXPECT_EQ(order(1, 1.5), "failed");
  EXPECT_EQ(order(2, 1), "failed");
  EXPECT_EQ(order(2, std::numeric_limits<double>::quiet_NaN()), "failed");
  const Numbers one{Quad(1)}, two{Quad(2)}, none{};
  EXPECT_EQ(judge({Evidence::Kind::value, one, {}, one, {}, at_round_off}), "reproduced");
  EXPECT_EQ(judge({Evidence::Kind::value, one, {}, {Quad(1), Quad(1)}, {}, at_round_off}), "failed");
  EXPECT_EQ(judge({Evidence::Kind::value, none, {}, none, {}, at_round_off}), "failed");
  EXPECT_EQ(judge({Evidence::Kind::misprint, one, two, two, {}, at_round_off}), "erratum");
  EXPECT_EQ(judge({Evidence::Kind::misprint, one, one, one, {}, at_round_off}), "failed");
  EXPECT_EQ(judge({Evidence::Kind::claim, {}, {}, {}, {}, at_round_off}), "failed");
  EXPECT_EQ(judge({Evidence::Kind::property, {}, {}, {}, {at_most(0, 1)}, at_round_off}), "qualitative");
}

// How many equations, definitions and so on each paper numbers, read from the papers. Series whose last
// number is left out of a table have no gap, which is why the last ones stand here.
TEST(Coverage, EndsWhereThePapersEnd) {
  const std::map<std::string, std::vector<std::string>> last{
      {"su-qin",
       {"(107)", "Definition 2.1", "Definition 3.2", "Proposition 2.1", "Proposition 3.2", "Theorem 3.2",
        "Theorem 4.3"}},
      {"nguyen-turski",
       {"(1.2)", "(2.2)", "(3.21)", "(4.7)", "(A.5)", "(B.5)", "(C.17)", "Definition 3", "Proposition 6",
        "Theorem 2", "Example 3.1", "table 2", "figure 3", "figure B.1"}},
      {"pitanga-rodrigues", {"(41)", "(a)", "(b)", "Remark 2"}}};
  for (const auto& [paper, names] : last) {
    std::set<std::string> listed;
    for (const PaperItem& item : items_of(paper)) listed.insert(item.name);
    for (const std::string& name : names) EXPECT_TRUE(listed.contains(name)) << paper << ": " << name;
  }
  EXPECT_THROW(items_of("su-qn"), InputError);
}

// Nothing of this paper is left for later; what has no row cannot have one.
TEST(Coverage, OfPitangaAndRodriguesIsWhole) {
  const std::vector<PaperItem> items = items_of("pitanga-rodrigues");
  EXPECT_GT(items.size(), 50U);
  for (const PaperItem& item : items) EXPECT_NE(item.cover, Cover::pending) << item.name;
}

ReproducedRow row_named(const std::string& equation) {
  ReproducedRow row;
  row.equation = equation;
  row.id = equation + " a row";
  return row;
}
std::vector<PaperItem> three_equations() {
  return {{"(1)", ItemKind::equation, Cover::rows, "", "file, line 1"},
          {"Theorem 1", ItemKind::theorem, Cover::reason, "a definition", "file, line 2"},
          {"(2)", ItemKind::equation, Cover::rows, "", "file, line 3"},
          {"(3)", ItemKind::equation, Cover::pending, "built later", "file, line 4"}};
}

TEST(Coverage, PlantedFaultsAreFound) {
  const std::vector<ReproducedRow> rows{row_named("(1)-(2)")};
  EXPECT_TRUE(coverage_of("a paper", three_equations(), rows).faults.empty());
  const auto only_fault = [](const std::vector<PaperItem>& items, const std::vector<ReproducedRow>& all) {
    const std::vector<std::string> faults = coverage_of("a paper", items, all).faults;
    EXPECT_EQ(faults.size(), 1U);
    return faults.empty() ? std::string() : faults.front();
  };
  auto gap = three_equations();
  gap.erase(gap.begin() + 2);
  EXPECT_EQ(only_fault(gap, {row_named("(1)")}), "file, line 4: equation (2) is not listed");
  auto first = three_equations();
  first[1].name = "Theorem 2";
  EXPECT_EQ(only_fault(first, rows), "file, line 2: theorem Theorem 1 is not listed");
  EXPECT_EQ(only_fault(three_equations(), {row_named("(1)")}),
            "file, line 3: (2) has no row; expected one, or a reason");
  EXPECT_EQ(only_fault(three_equations(), {row_named("(1), (2), (4)")}),
            "the row '(1), (2), (4) a row': unknown item of a paper '(4)'; did you mean '(1)'?");
  EXPECT_EQ(only_fault(three_equations(), {row_named("(1)-(3)")}),
            "file, line 4: (3) has rows and is listed as pending");
  auto twice = three_equations();
  twice.push_back(twice.back());
  EXPECT_EQ(only_fault(twice, rows), "file, line 4: (3) is listed twice");
}

TEST(Coverage, IsReadFromFiles) {
  const pfaff::testing::TemporaryDirectory folder;
  const auto read = [&](const std::string& entries) {
    std::ofstream(folder / "paper.toml") << "items = [\n" << entries << "\n]\n";
    return read_items(folder / "paper.toml");
  };
  const std::vector<PaperItem> items =
      read("{ equation = ['(1)', '(2)'] },\n{ table = 'table 1', pending = 'built later' },");
  ASSERT_EQ(items.size(), 3U);
  EXPECT_EQ(items[1].name + ", " + items[1].place, "(2), paper.toml, line 2");
  EXPECT_EQ(items[1].cover, Cover::rows);
  EXPECT_EQ(items[2].name + ", " + items[2].place, "table 1, paper.toml, line 3");
  EXPECT_EQ(items[2].kind, ItemKind::table);
  EXPECT_EQ(items[2].cover, Cover::pending);
  EXPECT_EQ(items[2].note, "built later");
}

TEST(Coverage, FilesThatAreWrongAreRefusedWithTheLine) {
  const pfaff::testing::TemporaryDirectory folder;
  const auto refusal = [&](const std::string& entry) -> std::string {
    std::ofstream(folder / "paper.toml") << "items = [\n{ equation = '(1)' },\n" << entry << "\n]\n";
    try {
      read_items(folder / "paper.toml");
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  const std::string there = "paper.toml, line 3: ";
  EXPECT_EQ(refusal("{ equation = '(2)' }"), "none");
  EXPECT_EQ(refusal("{ equaton = '(2)' }"), there + "unknown key 'equaton'; did you mean 'equation'?");
  EXPECT_EQ(refusal("{ equation = [] }"), there + "expected names of a kind, such as equation = '(1)'");
  EXPECT_EQ(refusal("{ equation = '(2)', table = 'table 1' }"),
            there + "key 'table': expected one kind, got equation too");
  EXPECT_EQ(refusal("{ equation = [[]] }"), there + "key 'equation': expected a number or a string");
  EXPECT_EQ(refusal("{ equation = '(2)', reason = '' }"),
            there + "key 'reason': expected why there are no rows, got an empty text");
  EXPECT_EQ(refusal("{ equation = '(2)', reason = 'a definition', pending = 'built later' }"),
            there + "key 'pending': expected a reason or what is pending, not both");
  EXPECT_NE(refusal("{ equation = }").find("paper.toml:3: "), std::string::npos);
}

TEST(Coverage, NamesItemsOneByOneAndInRanges) {
  const auto items = three_equations();
  EXPECT_EQ(named_items("(1)", items), (std::vector<std::string>{"(1)"}));
  EXPECT_EQ(named_items("(1)-(3)", items), (std::vector<std::string>{"(1)", "(2)", "(3)"}));
  EXPECT_EQ(named_items("(2), Theorem 1", items), (std::vector<std::string>{"(2)", "Theorem 1"}));
  EXPECT_EQ(named_items("(3)-(1)", items), (std::vector<std::string>{"(3)-(1)"}));
}

// What papers/printed/ includes besides itself and the standard library.
std::vector<std::string> foreign_includes(const fs::path& folder) {
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      if (!line.starts_with("#include ")) continue;
      const bool own = line.find("<pfaff/papers/printed/") != std::string::npos,
                 number = line.find("<pfaff/core/numbers/") != std::string::npos,
                 standard = line.starts_with("#include <") && line.find('/') == std::string::npos;
      if (!own && !number && !standard) found.push_back(entry.path().filename().string() + ": " + line);
    }
  }
  return found;
}

TEST(Printed, KnowsNumbersAndNothingElseOfTheEngine) {
  const fs::path folder = fs::path(PFAFF_GOLDEN) / "../../papers/printed";
  ASSERT_TRUE(fs::exists(folder / "dense.hpp"));
  for (const std::string& line : foreign_includes(folder)) ADD_FAILURE() << line;
  const pfaff::testing::TemporaryDirectory planted;
  std::ofstream(planted / "engine.hpp") << "#include <vector>\n#include <pfaff/core/linear/matrix.hpp>\n";
  EXPECT_EQ(foreign_includes(planted.path()).size(), 1U);
}

}  // namespace
