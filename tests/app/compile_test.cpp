// --compile: a run is the same to rounding, its config.toml says how it was made, and it goes on where there
// is no compiler.
#include <cmath>

#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

class Compile : public ::testing::Test {
 protected:
  Compile() { setenv("XDG_CACHE_HOME", (files_ / "cache").c_str(), 1); }
  ~Compile() override {
    unsetenv("XDG_CACHE_HOME");
    unsetenv("CXX");
  }
  [[nodiscard]] const TemporaryDirectory& files() const { return files_; }
  // A run of the damped pendulum by a method that needs the field's Jacobian, which nobody has written.
  [[nodiscard]] Arguments run(const std::string& out) const {
    return {"run",
            "--system",
            "damped-pendulum",
            "--integrator",
            "gauss",
            "--set",
            "stages=2",
            "--step",
            "0.1",
            "--time",
            "20",
            "--out",
            out == "-" ? out : files_ / out};
  }
  static std::vector<std::vector<std::string>> completed(const Arguments& arguments) {
    const Outcome outcome = run_pfaff(arguments);
    EXPECT_EQ(outcome.status, 0) << joined(arguments) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return rows_of(outcome.out);
  }

 private:
  TemporaryDirectory files_;
};

TEST_F(Compile, ARunIsTheSameToRounding) {
  const auto expected = completed(run("-")), found = completed(run("-") + Arguments{"--compile"});
  EXPECT_TRUE(fs::exists(files().path() / "cache" / "pfaff-native"));
  ASSERT_EQ(found.size(), expected.size());
  EXPECT_EQ(found[0], expected[0]);
  for (std::size_t row = 1; row < found.size(); ++row)
    for (std::size_t k = 0; k < 3; ++k)  // t, r, p: a damped motion, along which roundings do not grow
      EXPECT_NEAR(std::stod(found[row][k]), std::stod(expected[row][k]), 1e-13) << row << ' ' << k;
}

TEST_F(Compile, TheConfigurationSaysSoAndRepeatsIt) {
  ASSERT_EQ(run_pfaff(run("compiled") + Arguments{"--compile"}).status, 0);
  ASSERT_EQ(run_pfaff(run("plain")).status, 0);
  EXPECT_NE(text_of(files() / "compiled/config.toml").find("compile = \"yes\""), std::string::npos);
  EXPECT_EQ(text_of(files() / "plain/config.toml").find("compile"), std::string::npos);
  ASSERT_EQ(
      run_pfaff({"run", "--config", files() / "compiled/config.toml", "--out", files() / "again"}).status, 0);
  EXPECT_EQ(text_of(files() / "again/config.toml"), text_of(files() / "compiled/config.toml"));
  EXPECT_EQ(text_of(files() / "again/series.csv"), text_of(files() / "compiled/series.csv"));
  const Outcome other = run_pfaff(run("compiled"));
  EXPECT_EQ(other.status, 2) << "a run that is compiled is another one";
  EXPECT_NE(other.err.find("another run"), std::string::npos) << other.err;
}

TEST_F(Compile, AnotherCompilerMakesAnotherRun) {
  const Arguments compiled = run("run") + Arguments{"--compile"};
  ASSERT_EQ(run_pfaff(compiled).status, 0);
  EXPECT_NE(text_of(files() / "run/config.toml").find("-ffp-contract=off"), std::string::npos);
  setenv("CXX", "c++ -O1", 1);
  const Outcome other = run_pfaff(compiled);
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.err.find("native is another build"), std::string::npos) << other.err;
  setenv("CXX", "no-such-compiler", 1);
  const Outcome none = run_pfaff(compiled);
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("native is another build"), std::string::npos) << none.err;
  EXPECT_EQ(run_pfaff(compiled + Arguments{"--force"}).status, 0);
  EXPECT_NE(text_of(files() / "run/config.toml").find("interpreted: no compiler"), std::string::npos);
  unsetenv("CXX");
}

TEST_F(Compile, WithoutACompilerFormulasAreInterpretedWhichIsSaidOnce) {
  setenv("CXX", "no-such-compiler", 1);
  const Outcome outcome = run_pfaff(run("-") + Arguments{"--compile"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "pfaff: there is no C++ compiler here; formulas are interpreted\n");
  EXPECT_EQ(rows_of(outcome.out), completed(run("-")));
}

TEST_F(Compile, AFailingCompilerIsAnErrorInOneLine) {
  setenv("CXX", "c++ --no-such-option", 1);
  expect_complaint(
      run_pfaff({"evaluate", "--system", "kepler", "--compile"}), 1,
      {"compiling the formulas of system kepler: c++ ended with status", "its messages are in '"},
      "evaluate --compile");
}

TEST_F(Compile, EvaluateAndExperimentsTakeIt) {
  const auto evaluated = [](const Arguments& more) {
    return run_pfaff(Arguments{"evaluate", "--json", "--system", "damped-pendulum"} + more).out;
  };
  EXPECT_EQ(evaluated({"--compile"}), evaluated({}));
  const std::string experiment = R"(schema = 1
title = "A test"
compile = true
[[method]]
label = "Gauss"
integrator = "gauss"
[[case]]
name = "short"
system = "damped-pendulum"
time = "5"
steps = ["0.1"]
)";
  write(files() / "compiled.toml", experiment);
  const Outcome outcome =
      run_pfaff({"compare", files() / "compiled.toml", "--no-report", "--out", files() / "out"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  bool found = false;
  for (const auto& entry : fs::recursive_directory_iterator(files().path() / "out"))
    if (entry.path().filename() == "config.toml")
      found = text_of(entry.path()).find("compile = \"yes\"") != std::string::npos;
  EXPECT_TRUE(found);
  std::string wrong = experiment;
  write(files() / "wrong.toml", wrong.replace(wrong.find("true"), 4, "\"maybe\""));
  const Outcome refused = run_pfaff({"compare", files() / "wrong.toml", "--out", files() / "none"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("key 'compile': unknown answer 'maybe'"), std::string::npos) << refused.err;
}

}  // namespace
