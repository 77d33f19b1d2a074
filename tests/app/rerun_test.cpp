// A run repeated from the config.toml of another gives the same bytes, and a run that fails keeps what it has
// completed.
#include <cmath>

#include <pfaff/core/numbers/real.hpp>

#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

TEST(Rerun, GivesTheSameBytes) {
  const Arguments quad{"--system",     "damped-oscillator",
                       "--integrator", "gauss",
                       "--step",       "1/7",
                       "--time",       "10/3",
                       "--set",        "stages=3",
                       "--precision",  "quad",
                       "--set",        "initial=1/3,-0.7",
                       "--set",        "nu=1/3"};
  const Arguments shorter{"--system",     "damped-pendulum",
                          "--integrator", "generating-function",
                          "--step",       "0.1",
                          "--time",       "200",
                          "--every",      "7",
                          "--set",        "order=6",
                          "--set",        "initial=0.1,2"};
  const Arguments adaptive{
      "--system", "kepler", "--integrator", "odeint-dopri5",    "--tolerance", "1e-9",
      "--time",   "20",     "--set",        "eccentricity=0.3", "--absolute",  "1e-9,1/3,0,1e-10"};
  const Arguments by_default{"--system", "henon-heiles", "--integrator", "verlet",
                             "--step",   "0.1",          "--time",       "50"};
  for (const Arguments& arguments : {quad, shorter, adaptive, by_default}) {
    SCOPED_TRACE(joined(arguments));
    const TemporaryDirectory files;
    const Outcome first = run_pfaff(Arguments{"run", "--out", files / "first"} + arguments);
    ASSERT_EQ(first.status, 0) << first.err;
    const Outcome again =
        run_pfaff({"run", "--out", files / "again", "--config", files / "first/config.toml"});
    ASSERT_EQ(again.status, 0) << again.err;
    for (const char* name : {"config.toml", "series.csv", "summary.json"})
      EXPECT_EQ(text_of(files.path() / "first" / name), text_of(files.path() / "again" / name)) << name;
    EXPECT_GT(fs::file_size(files.path() / "first/series.csv"), 1000U);
  }
}

TEST(Rerun, StartsAtTheTimeOfTheStateFile) {
  const TemporaryDirectory files;
  write(files / "state.json", R"({"t": "0.7", "z": ["0.4", "-0.7"]})");
  const Arguments run{"run",
                      "--system",
                      "damped-oscillator",
                      "--integrator",
                      "generating-function",
                      "--step",
                      "0.1",
                      "--time",
                      "1",
                      "--precision",
                      "quad",
                      "--state",
                      files / "state.json"};
  ASSERT_EQ(run_pfaff(run + Arguments{"--out", files / "first"}).status, 0);
  fs::remove(files.path() / "state.json");
  ASSERT_EQ(run_pfaff({"run", "--out", files / "again", "--config", files / "first/config.toml"}).status, 0);
  const std::string series = text_of(files / "first/series.csv");
  EXPECT_EQ(series, text_of(files / "again/series.csv"));
  const auto start = pfaff::Real::parse(rows_of(series)[1][0]);
  ASSERT_TRUE(start.has_value());
  EXPECT_EQ(start->quad(), pfaff::Real::fraction(7, 10).quad());
}

// K = e^{nu t} [[0, -1], [1, 0]] leaves the range of doubles at t = 709.78 / nu.
TEST(FailedRun, KeepsEveryCompletedSampleAndSaysWhy) {
  const TemporaryDirectory files;
  const Outcome run = run_pfaff({"run", "--out", files / "run", "--system", "damped-oscillator",
                                 "--integrator", "generating-function", "--set", "order=2", "--set", "nu=10",
                                 "--step", "0.1", "--time", "100", "--json"});
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.err.find('\n') + 1, run.err.size()) << run.err;
  for (const char* said : {"pfaff: the run ended early", "birkhoffian is not finite at t = 71", "(step 710)",
                           "non_finite", "kept"})
    EXPECT_NE(run.err.find(said), std::string::npos) << run.err;
  const auto j = json_of(run.out);
  EXPECT_EQ(j["status"], "non_finite");
  EXPECT_NE(j["message"].get<std::string>().find("at t = 71"), std::string::npos);
  EXPECT_EQ(j["steps"], 1000);
  const int completed = j["completed"];
  EXPECT_NEAR(completed * 0.1, 70.978, 0.1);
  const auto rows = rows_of(text_of(files / "run/series.csv"));
  ASSERT_EQ(rows.size(), static_cast<std::size_t>(completed) + 2);  // a header, and the initial sample
  EXPECT_NEAR(std::stod(rows.back()[0]), 0.1 * completed, 1e-12);
  for (std::size_t k = 1; k < rows.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c) EXPECT_TRUE(std::isfinite(std::stod(rows[k][c]))) << k;
  EXPECT_EQ(text_of(files / "run/summary.json"), run.out);
  EXPECT_EQ(run_pfaff({"run", "--out", files / "again", "--config", files / "run/config.toml"}).status, 1);
  // In quad the invariant stays in range. There it is its drift, which is kept in doubles, that leaves it.
  std::string config = text_of(files / "run/config.toml");
  config.replace(config.find("double"), 6, "quad");
  write(files / "quad.toml", config);
  const Outcome in_quad = run_pfaff({"run", "--out", "-", "--config", files / "quad.toml"});
  EXPECT_EQ(in_quad.status, 1);
  EXPECT_NE(in_quad.err.find("the drift of birkhoffian is not finite at t = 7"), std::string::npos)
      << in_quad.err;
}

TEST(FailedRun, ToStandardOutput) {
  const Outcome run =
      run_pfaff({"run", "--out", "-", "--system", "damped-oscillator", "--integrator", "generating-function",
                 "--set", "order=2", "--set", "nu=10", "--step", "0.1", "--time", "100"});
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.err.find('\n') + 1, run.err.size());
  EXPECT_GT(rows_of(run.out).size(), 700U);
}

}  // namespace
