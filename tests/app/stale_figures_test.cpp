// What was made of a run or an experiment goes before that is made anew, and stays where nothing is.
#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

class StaleFigures : public ::testing::Test {
 protected:
  TemporaryDirectory files;
  void write_model(const std::string& stiffness) {
    write(files / "spring.toml", "coordinates = [\"q\", \"p\"]\nkinetic = \"p^2/2\"\npotential = \"" +
                                     stiffness + "*q^2\"\ninitial = [1, 0]\n");
  }
  // Puts files where scripts would, which takes no time.
  void plant(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      fs::create_directories((files.path() / name).parent_path());
      write(files / name, "old");
    }
  }
  void expect(const std::vector<std::string>& names, bool there, const std::string& after) {
    for (const std::string& name : names)
      EXPECT_EQ(fs::exists(files / name), there) << name << " after " << after;
  }
};

TEST_F(StaleFigures, OfARunThatIsMadeAnew) {
  const Arguments run{
      "run", "--system", files / "spring.toml", "--integrator", "rk4", "--step", "0.1", "--time",
      "1",   "--out",    files / "run",         "--quiet"};
  const std::vector<std::string> figures{"run/plot/plot.html", "run/plot/motion.svg", "run/plot/drift.png"};
  write_model("1/2");
  ASSERT_EQ(run_pfaff(run).status, 0);
  plant(figures);
  ASSERT_EQ(run_pfaff(run).status, 0);
  expect(figures, true, "the same run");
  write_model("1");
  EXPECT_EQ(run_pfaff(run).status, 2);
  expect(figures, true, "a run that is refused");
  ASSERT_EQ(run_pfaff(run + Arguments{"--force"}).status, 0);
  expect({"run/plot"}, false, "--force");
  // A damaged run is made anew without force.
  plant(figures);
  write(files / "run/series.csv", "cut");
  ASSERT_EQ(run_pfaff(run).status, 0);
  expect({"run/plot"}, false, "a damaged run");
}

TEST_F(StaleFigures, OfAnExperimentThatIsMadeAnew) {
  write(files / "test.toml",
        "schema = 1\ntitle = \"A test\"\n[[method]]\nlabel = \"RK4\"\nintegrator = \"rk4\"\n[[case]]\n"
        "name = \"c\"\nsystem = \"spring.toml\"\ntime = 1\nsteps = [0.1, 0.05]\n");
  const Arguments compare{"compare",     files / "test.toml", "--quiet",  "--out",
                          files / "out", "--no-report",       "--timing", "0.001"};
  const std::vector<std::string> derived{"out/report.html", "out/figures/motion_c.svg",
                                         "out/figures/paper/verdict_c.tex"};
  write_model("1/2");
  ASSERT_EQ(run_pfaff(compare).status, 0);
  plant(derived);
  ASSERT_EQ(run_pfaff(compare).status, 0);
  expect(derived, true, "the same experiment");
  write_model("1");
  EXPECT_EQ(run_pfaff(compare).status, 2);
  expect(derived, true, "an experiment that is refused");
  ASSERT_EQ(run_pfaff(compare + Arguments{"--force"}).status, 0);
  expect({"out/report.html", "out/figures"}, false, "--force");
  // One run that is missing, and one that was not timed.
  for (const char* lost : {"out/runs/c-rk4-h0.1/series.csv", "out/cost.csv"}) {
    plant(derived);
    fs::remove(files.path() / lost);
    ASSERT_EQ(run_pfaff(compare).status, 0);
    expect({"out/report.html", "out/figures"}, false, lost);
    EXPECT_TRUE(fs::exists(files / lost));
    EXPECT_TRUE(fs::exists(files / "out/results.csv"));
  }
}

TEST_F(StaleFigures, OfDerivationsThatAreMadeAnew) {
  write(files / "study.toml",
        "schema = 1\nkind = \"derivation\"\ntitle = \"A test\"\nsystem = \"n-pendulum\"\n"
        "parameter = \"bobs\"\n[[derive]]\nmethod = \"ldl\"\nsizes = [1, 2]\n");
  const Arguments compare{"compare", files / "study.toml", "--quiet", "--out", files / "out", "--no-report"};
  const std::vector<std::string> derived{"out/report.html", "out/figures/seconds.svg"};
  ASSERT_EQ(run_pfaff(compare).status, 0);
  plant(derived);
  ASSERT_EQ(run_pfaff(compare).status, 0);
  expect(derived, true, "the same study");
  ASSERT_EQ(run_pfaff(compare + Arguments{"--force"}).status, 0);
  expect({"out/report.html", "out/figures"}, false, "--force");
  // A summary with a number that no derivation can have is none.
  const std::string file = files / "out/runs/ldl-1/summary.json", whole = text_of(file);
  for (const auto& [key, value] :
       {std::pair{"seconds", "-1"}, std::pair{"seconds", "1e300"}, std::pair{"seconds", "\"abc\""},
        std::pair{"seconds", "0"}, std::pair{"equations", "-2"}, std::pair{"operations", "1.5"},
        std::pair{"method", "1"}}) {
    SCOPED_TRACE(std::string(key) + " " + value);
    std::string edited = whole;
    const std::size_t at = edited.find(std::string("\"") + key + "\": ") + std::string(key).size() + 4;
    edited.replace(at, edited.find_first_of(",\n", at) - at, value);
    ASSERT_NE(edited, whole);
    write(file, edited);
    plant(derived);
    ASSERT_EQ(run_pfaff(compare).status, 0);
    expect(derived, false, "a summary that was edited");
    EXPECT_GT(json_of(text_of(file))["seconds"].get<double>(), 0);
    EXPECT_EQ(json_of(text_of(file))["operations"], json_of(whole)["operations"]);
  }
}

}  // namespace
