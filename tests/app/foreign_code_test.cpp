// Nothing foreign runs: a configuration of somebody else loads no code, a program that was copied alone runs
// no script of the tree that it was built from, and the report's Python sees neither the user's modules nor
// those of the current directory. What plug-ins do while they are loaded ends in one line.
#include "../comma_locale.hpp"
#include "../processes.hpp"
#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

// A run of a pendulum, short enough for a test.
Arguments small_run(const std::string& out, const Arguments& more = {}) {
  return Arguments{"run", "--system", "pendulum", "--integrator", "verlet", "--step",
                   "0.1", "--time",   "1",        "--out",        out} +
         more;
}

class ForeignCode : public ::testing::Test {
 protected:
  ForeignCode() { setenv("PFAFF_WITNESS", witness().c_str(), 1); }
  ~ForeignCode() override {
    for (const char* name :
         {"PFAFF_WITNESS", "PFAFF_PLUGIN_PATH", "PYTHONPATH", "PYTHONSTARTUP", "MPLBACKEND"})
      unsetenv(name);
  }
  [[nodiscard]] std::string witness() const { return files_ / "witness"; }
  [[nodiscard]] const TemporaryDirectory& files() const { return files_; }

 private:
  TemporaryDirectory files_;
};

TEST_F(ForeignCode, AConfigurationLoadsNoPlugins) {
  const std::string fits = test_plugin("fits");
  ASSERT_EQ(run_pfaff(small_run(files() / "mine")).status, 0);
  write(files().path() / "theirs.toml",
        text_of(files() / "mine/config.toml") + "\n[plugins]\n\"" + fits + "\" = \"0123456789abcdef\"\n");
  const Arguments again{"run", "--config", files() / "theirs.toml", "--out", files() / "again", "--force"};
  expect_complaint(run_pfaff(again), 2, {"theirs.toml", "fits.so", "expected --plugin " + fits}, "theirs");
  EXPECT_FALSE(fs::exists(witness())) << "the plug-in was loaded";
  // Named by the user it is loaded, by either way.
  EXPECT_EQ(run_pfaff(again + Arguments{"--plugin", fits}).status, 0);
  EXPECT_TRUE(fs::exists(witness()));
  fs::create_directory(files().path() / "plugins");
  fs::copy_file(fits, files().path() / "plugins/fits.so");
  fs::remove_all(files().path() / "again");
  setenv("PFAFF_PLUGIN_PATH", (files() / "plugins").c_str(), 1);
  EXPECT_EQ(run_pfaff(again).status, 0);
}

TEST_F(ForeignCode, WhatHappensAtTheSecondLoadEndsInOneLine) {
  const auto list = [](const std::string& name) {
    return Arguments{"list", "systems", "--plugin", test_plugin(name)};
  };
  for (const auto& [name, said] : std::vector<std::pair<std::string, std::string>>{
           {"exit-later", "ends the program while it is loaded"},
           {"exit-quickly-later", "ends the program while it is loaded"},
           {"throw-later", "throws while it is loaded: not twice"}}) {
    fs::remove(witness());
    expect_complaint(run_pfaff(list(name)), 2, {"plug-in '" + test_plugin(name) + "': " + said}, name);
    fs::remove(witness());
    expect_complaint(run_pfaff(small_run("-", {"--plugin", test_plugin(name)})), 2, {said}, name);
  }
  // A second process that comes back out of the loader does not go on with the work.
  fs::remove(witness());
  const Outcome forked = run_pfaff(list("fork-later"));
  EXPECT_EQ(forked.status, 0);
  EXPECT_EQ(forked.out, run_pfaff({"list", "systems"}).out);
}

TEST_F(ForeignCode, WhatMultipliesIsRefused) {
  for (const char* name : {"come-back-twice", "leave-a-process"})
    expect_complaint(run_pfaff({"list", "systems", "--plugin", test_plugin(name)}), 2,
                     {name, "leaves another process behind while it is loaded"}, name);
}

TEST_F(ForeignCode, ATrialEndsWithTheProgram) {
  const Program program({"list", "systems", "--plugin", test_plugin("hang")});
  const pid_t trial = process_in(witness());
  ASSERT_GT(trial, 0);
  EXPECT_NE(trial, program.id());
  program.kill();
  EXPECT_TRUE(gone(trial));
}

// Locales, rounding, the working directory: what a plug-in changes while it is loaded changes no byte.
TEST_F(ForeignCode, WhatAPluginChangesOfTheProcessChangesNoNumber) {
  const CommaLocale comma;
  const Arguments changing{"--plugin", test_plugin("change-the-process")};
  for (const Arguments& how : {Arguments{}, Arguments{"--precision", "quad"}, Arguments{"--compile"}}) {
    Circumstances here;
    here.directory = files().path();
    ASSERT_EQ(run_pfaff(small_run("plain", how), here).status, 0);
    const Outcome changed = run_pfaff(small_run("changed", how + changing), here);
    ASSERT_EQ(changed.status, 0) << changed.err;
    for (const char* file : {"series.csv", "config.toml"})
      EXPECT_EQ(text_of(files().path() / "changed" / file), text_of(files().path() / "plain" / file)) << file;
    for (const char* name : {"plain", "changed"}) fs::remove_all(files().path() / name);
  }
  EXPECT_EQ(run_pfaff(Arguments{"describe", "pendulum"} + changing).out,
            run_pfaff({"describe", "pendulum"}).out);
}

// The libraries, but neither experiments nor scripts.
TEST_F(ForeignCode, AProgramThatWasCopiedAloneRunsNoScripts) {
  const fs::path built = built_program().parent_path(), copied = files().path() / "copied/bin";
  fs::create_directories(copied);
  for (const auto& entry : fs::directory_iterator(built))
    if (const std::string name = entry.path().filename().string();
        name == "pfaff" || name.starts_with("libpfaff") || name == "pfaff-trial-load")
      fs::copy(entry.path(), copied / name, fs::copy_options::copy_symlinks);
  ASSERT_EQ(run_pfaff(small_run(files() / "run")).status, 0);
  const auto run_copy = [&](const std::string& arguments) {
    const std::string log = files() / "log";
    const int status =
        std::system(("'" + (copied / "pfaff").string() + "' " + arguments + " >'" + log + "' 2>&1").c_str());
    return std::pair(WEXITSTATUS(status), text_of(log));
  };
  const auto [status, said] = run_copy("plot '" + (files() / "run") + "'");
  EXPECT_EQ(status, 2) << said;
  EXPECT_NE(said.find("the experiments and the scripts of reports are missing; expected them in '"),
            std::string::npos)
      << said;
  EXPECT_EQ(run_copy("compare kepler").first, 2);
  EXPECT_EQ(run_copy("compare --all --quiet").first, 2);  // not a success of no experiments
  EXPECT_FALSE(fs::exists(files().path() / "run/plot"));
  // What needs none of them runs; the next test is the control, in which a program in its build tree plots.
  EXPECT_EQ(run_copy("list").first, 0);
  EXPECT_EQ(run_copy("run --system pendulum --integrator verlet --step 0.1 --time 1 --out -").first, 0);
}

// Modules that the scripts import, and one that every Python imports at its start.
TEST_F(ForeignCode, TheReportsPythonIsAlone) {
  const std::string left = files() / "left";
  fs::create_directory(files().path() / "modules");
  for (const char* name : {"sitecustomize", "usercustomize", "files", "page", "json", "matplotlib"})
    write(files().path() / "modules" / (std::string(name) + ".py"), "open('" + left + "', 'w')\n");
  write(files().path() / "modules/matplotlibrc", "lines.linewidth: 20\n");
  ASSERT_EQ(run_pfaff(small_run(files() / "run")).status, 0);
  const auto plotted = [&](const Circumstances& circumstances) {
    const Outcome outcome = run_pfaff({"plot", files() / "run"}, circumstances);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const std::string page = text_of(files() / "run/plot/plot.html");
    fs::remove_all(files().path() / "run/plot");
    return page;
  };
  const std::string expected = plotted({});
  setenv("PYTHONPATH", (files() / "modules").c_str(), 1);
  setenv("PYTHONSTARTUP", (files() / "modules/files.py").c_str(), 1);
  setenv("MPLBACKEND", "module://page", 1);
  Circumstances there;
  there.directory = files().path() / "modules";
  EXPECT_EQ(plotted(there), expected);
  EXPECT_FALSE(fs::exists(left)) << "a foreign module was imported";
  // The control: a Python that is started as usual does import them.
  EXPECT_EQ(std::system("python3 -c 'import page'"), 0);
  EXPECT_TRUE(fs::exists(left));
}

}  // namespace
