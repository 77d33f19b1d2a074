// Citations made from references.bib; files that are written whole or not at all; and which results of checks
// count as good.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include <unistd.h>

#include <pfaff/bench/experiment/citations.hpp>
#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/core/bracket.hpp>
#include <pfaff/verify/check.hpp>

namespace {

using namespace pfaff;
namespace fs = std::filesystem;

TEST(Citations, EntriesAreWholeAndLinesAreFromThem) {
  ASSERT_FALSE(citation_keys().empty());
  for (const std::string& key : citation_keys()) {
    const std::string entry = bibtex(key);
    EXPECT_TRUE(entry.starts_with("@")) << key;
    EXPECT_TRUE(entry.ends_with("}")) << key;
    EXPECT_EQ(std::count(entry.begin(), entry.end(), '{'), std::count(entry.begin(), entry.end(), '}'))
        << key;
    const std::string line = citation(key);
    EXPECT_NE(line, key) << key;
    EXPECT_EQ(line.find_first_of("{}\n"), std::string::npos) << line;
  }
  EXPECT_EQ(bibtex("nobody1900"), "");
  EXPECT_EQ(citation("nobody1900"), "nobody1900");
}

TEST(Citations, KeysAreFoundInReferences) {
  EXPECT_EQ(keys_in("su-qin (92); hairer-lubich-wanner2006 II.1"),
            (std::vector<std::string>{"hairer-lubich-wanner2006", "su-qin"}));
  EXPECT_TRUE(keys_in("nothing of ours").empty());
  // Tests that run before this one in the same process may have loaded plug-ins of their own.
  const auto expect_cited = [](const auto& registry) {
    int cited = 0;
    for (const auto* plugin : registry.all()) {
      if (plugin->file().find("/tests/") != std::string::npos) continue;
      EXPECT_FALSE(keys_in(plugin->descriptor().reference).empty()) << plugin->name();
      ++cited;
    }
    EXPECT_GT(cited, 30);
  };
  expect_cited(systems());
  expect_cited(integrators());
}

TEST(Citations, ExperimentsCiteWhatIsThere) {
  for (const std::string& name : experiment_names())
    for (const std::string& key : read_experiment(name, false).reference)
      EXPECT_FALSE(bibtex(key).empty()) << name << ": " << key;
}

class Files : public ::testing::Test {
 protected:
  fs::path directory;
  void SetUp() override {
    std::string name = ::testing::TempDir() + "pfaff-files-XXXXXX";
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    directory = name;
  }
  void TearDown() override { fs::remove_all(directory); }
};

TEST_F(Files, AreWholeOrWereNeverThere) {
  write_file(directory / "a", "first");
  write_file(directory / "a", "second");
  EXPECT_EQ(read_file(directory / "a"), "second");
  EXPECT_THROW(write_file(directory / "missing/a", "text"), RunError);
  fs::create_directory(directory / "taken");
  write_file(directory / "taken/inside", "kept");
  EXPECT_THROW(write_file(directory / "taken", "text"), RunError);  // cannot be renamed onto a directory
  EXPECT_EQ(read_file(directory / "taken/inside"), "kept");
  EXPECT_THROW((void)read_file(directory / "missing"), InputError);
  EXPECT_THROW((void)read_file(directory), InputError);
}

TEST_F(Files, OutputDirectories) {
  const auto take = [&](const fs::path& path) { (void)take_output_directory(path, "a test"); };
  take(directory / "new/deep");
  EXPECT_TRUE(fs::is_empty(directory / "new/deep"));
  take(directory / "new/deep");
  write_file(directory / "new/deep/a", "kept");
  EXPECT_THROW(take(directory / "new/deep"), InputError);
  EXPECT_THROW(take(directory / "new/deep/a"), InputError);
  EXPECT_EQ(read_file(directory / "new/deep/a"), "kept");
}

TEST(Checks, ClaimsInScopeMustPassAndControlsMustBeRejected) {
  for (const auto& [result, in_scope, outside] :
       {std::tuple{CheckResult::pass, true, false}, std::tuple{CheckResult::fail, false, false},
        std::tuple{CheckResult::measured, false, true}, std::tuple{CheckResult::rejected, false, false},
        std::tuple{CheckResult::skipped, false, true}}) {
    Check check;
    check.result = result;
    check.reason = "a reason";
    EXPECT_EQ(good(check), in_scope) << to_string(result);
    check.in_scope = false;
    EXPECT_EQ(good(check), outside) << to_string(result);
    check.control = true;
    EXPECT_EQ(good(check), result == CheckResult::rejected) << to_string(result);
  }
  Check check;
  EXPECT_FALSE(good(check)) << "nothing was measured";
  check.in_scope = false;
  EXPECT_FALSE(good(check)) << "and no reason is given";
}

TEST(Checks, CoefficientsInDoubleAreExemptFromQuadWithAReason) {
  const auto& system = systems().get("harmonic-oscillator", "system");
  const auto exempt = [&](const std::string& method) {
    std::set<std::string> claims;
    for (const Check& check : check_method(integrators().get(method, "integrator"), {}, system))
      if (check.result == CheckResult::skipped) {
        EXPECT_FALSE(check.in_scope);
        EXPECT_EQ(check.precision, "quad");
        EXPECT_EQ(check.reason, "the method's coefficients are in double");
        claims.insert(check.claim);
      }
    return claims;
  };
  EXPECT_EQ(exempt("odeint-mclachlan"), (std::set<std::string>{"double-is-quad-rounded", "step-jacobian",
                                                               "symmetric", "symplectic", "reversible"}));
  EXPECT_TRUE(exempt("verlet").empty());  // control
}

TEST(Checks, FalseMethodsAndBracketsAreRejected) {
  for (const auto& checks : {check_false_methods(), check_false_brackets()}) {
    EXPECT_FALSE(checks.empty());
    for (const Check& c : checks) {
      EXPECT_TRUE(c.control) << c.plugin;
      EXPECT_EQ(c.result, CheckResult::rejected) << c.plugin << ": " << c.claim;
    }
  }
}

TEST(Checks, JsonHasTheAgreedKeys) {
  const auto j = to_json(check_false_methods().front());
  for (const char* key : {"plugin", "claim", "scope", "system", "precision", "parameters", "measured",
                          "expected", "tolerance", "in_scope", "control", "result"})
    EXPECT_TRUE(j.contains(key)) << key;
  EXPECT_EQ(j["result"], "rejected");
  EXPECT_EQ(j["plugin"], "rk4");
}

}  // namespace
