// Results are never stale: what a directory holds is taken only where its settings, the contents of its files
// and the builds of its plug-ins are those of the run that is asked for.
#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

std::string chain(const std::string& gravity) {
  return "dimension = 2\nmasses = [1.0, 2.0]\ngravity = " + gravity +
         "\nanchors = { origin = [0.0, 0.0] }\nrods = [[0, \"origin\"], [0, 1]]\n"
         "positions = [[0.6, -0.8], [1.1, -0.8]]\n";
}
Arguments short_run_to(const std::string& out, const Arguments& more) {
  return Arguments{"run", "--out", out, "--step", "0.01", "--time", "0.5"} + more;
}
Arguments chain_to(const std::string& out, const std::string& model) {
  return short_run_to(out, {"--system", "bead-rod", "--integrator", "rattle", "--set", "model=" + model});
}
void expect_same_run(const fs::path& a, const fs::path& b) {
  for (const char* name : {"config.toml", "series.csv", "summary.json"})
    EXPECT_EQ(text_of(a / name), text_of(b / name)) << name;
}
Circumstances in(const fs::path& directory) {
  Circumstances here;
  here.directory = directory;
  return here;
}

TEST(Identity, ARunThatIsThereAlreadyIsKept) {
  const TemporaryDirectory files;
  const Arguments run =
      short_run_to(files / "run", {"--system", "damped-pendulum", "--integrator", "rk4", "--json"});
  const Outcome first = run_pfaff(run);
  ASSERT_EQ(first.status, 0) << first.err;
  const auto written = fs::last_write_time(files.path() / "run/series.csv");
  const Outcome again = run_pfaff(run);
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(again.out, first.out);
  EXPECT_EQ(fs::last_write_time(files.path() / "run/series.csv"), written);
  // Other settings are another run, whose files stay.
  const std::string series = text_of(files / "run/series.csv");
  for (const Arguments& other :
       {Arguments{"--every", "2"}, Arguments{"--set", "nu=0.4"}, Arguments{"--reference", "none"}})
    expect_complaint(run_pfaff(run + other), 2, {"holds another run"}, joined(other));
  EXPECT_EQ(text_of(files / "run/series.csv"), series);
}

TEST(Identity, AChangedModelFileIsNoticed) {
  const TemporaryDirectory files;
  write(files / "chain.toml", chain("9.81"));
  ASSERT_EQ(run_pfaff(chain_to(files / "run", files / "chain.toml")).status, 0);
  const std::string before = text_of(files / "run/series.csv");
  write(files / "chain.toml", chain("1.62"));
  for (const Arguments& run :
       {chain_to(files / "run", files / "chain.toml"),
        Arguments{"run", "--out", files / "run", "--config", files / "run/config.toml"},
        Arguments{"run", "--out", files / "new", "--config", files / "run/config.toml"}})
    expect_complaint(run_pfaff(run), 2, {"chain.toml has changed", "--force"}, joined(run));
  EXPECT_EQ(text_of(files / "run/series.csv"), before);
  EXPECT_FALSE(fs::exists(files.path() / "new"));
  ASSERT_EQ(run_pfaff(chain_to(files / "run", files / "chain.toml") + Arguments{"--force"}).status, 0);
  EXPECT_NE(text_of(files / "run/series.csv"), before);
  ASSERT_EQ(run_pfaff(chain_to(files / "fresh", files / "chain.toml")).status, 0);
  expect_same_run(files.path() / "run", files.path() / "fresh");
  // Control: a file that is written anew with the same contents is the same file.
  write(files / "chain.toml", chain("1.62"));
  EXPECT_EQ(run_pfaff(chain_to(files / "run", files / "chain.toml")).status, 0);
}

TEST(Identity, AChangedStateFileIsAnotherRun) {
  const TemporaryDirectory files;
  const Arguments run = short_run_to(
      files / "run", {"--system", "damped-pendulum", "--integrator", "rk4", "--state", files / "state.json"});
  write(files / "state.json", R"({"t": 0, "z": [1, 0.5]})");
  ASSERT_EQ(run_pfaff(run).status, 0);
  write(files / "state.json", R"({"t": 0, "z": [1, 0.25]})");
  expect_complaint(run_pfaff(run), 2, {"holds another run"}, "another state");
  write(files / "state.json", R"({"z": ["1", "1/2"]})");
  EXPECT_EQ(run_pfaff(run).status, 0) << "the same state in other words";
}

TEST(Identity, ARebuiltPluginIsNoticed) {
  const TemporaryDirectory files;
  const auto build = [&](const std::string& stiffness) {
    fs::copy_file(test_plugin("spring-" + stiffness), files.path() / "spring.so",
                  fs::copy_options::overwrite_existing);
  };
  const auto run = [&](const std::string& out) {
    return short_run_to(
        files / out, {"--system", "test-spring", "--integrator", "verlet", "--plugin", files / "spring.so"});
  };
  build("1");
  ASSERT_EQ(run_pfaff(run("run")).status, 0);
  const std::string before = text_of(files / "run/series.csv");
  EXPECT_NE(text_of(files / "run/config.toml").find("spring.so\" = \""), std::string::npos);
  build("2");
  expect_complaint(run_pfaff(run("run")), 2, {"spring.so is another build", "--force"}, "rebuilt");
  const Arguments again{
      "run", "--out", files / "new", "--config", files / "run/config.toml", "--plugin", files / "spring.so"};
  expect_complaint(run_pfaff(again), 2, {"spring.so is another build", "--force"},
                   "rebuilt, from its config");
  EXPECT_EQ(run_pfaff(again + Arguments{"--force"}).status, 0);
  EXPECT_NE(text_of(files / "new/series.csv"), before);
  // Control: the first build again.
  build("1");
  EXPECT_EQ(run_pfaff(run("run")).status, 0);
  EXPECT_EQ(text_of(files / "run/series.csv"), before);
}

// What a text model or a table of coefficients names is a part of the run as what a parameter names is.
TEST(Identity, ARebuiltPluginThatAFileNamesIsNoticed) {
  const TemporaryDirectory files;
  write(files / "model.toml",
        "coordinates = [\"q\", \"p\"]\ninitial = [1, 0]\nhamiltonian = \"p^2/2 + q^2/2\"\n"
        "bracket = \"test-stiff\"\n");
  write(files / "table.toml",
        "name = \"twice\"\nkind = \"composition\"\norder = 2\nbase = \"test-verlet\"\n"
        "weights = [\"1/2\", \"1/2\"]\n");
  const auto build = [&](const std::string& stiffness) {
    fs::copy_file(test_plugin("spring-" + stiffness), files.path() / "spring.so",
                  fs::copy_options::overwrite_existing);
  };
  const Arguments plugin{"--plugin", files / "spring.so"};
  const Arguments model{"--system", files / "model.toml", "--integrator", "rk4"};
  const Arguments table{"--system", "pendulum", "--integrator", files / "table.toml"};
  for (const Arguments& named : {model, table}) {
    build("1");
    const Arguments run = short_run_to(files / "run", named + plugin);
    const Outcome first = run_pfaff(run);
    ASSERT_EQ(first.status, 0) << first.err;
    // From the configuration, which says where the plug-in is and does not load it.
    const Arguments again{"run", "--out", files / "new", "--config", files / "run/config.toml"};
    expect_complaint(run_pfaff(again), 2, {"--plugin " + (files / "spring.so")}, joined(named));
    EXPECT_EQ(run_pfaff(again + plugin).status, 0) << joined(named);
    EXPECT_EQ(run_pfaff(run).status, 0) << joined(named);
    build("2");
    expect_complaint(run_pfaff(run), 2, {"spring.so is another build", "--force"}, joined(named));
    fs::remove_all(files.path() / "run");
    fs::remove_all(files.path() / "new");
  }
}

TEST(Identity, ConfigRepeatsARunFromAnywhere) {
  const TemporaryDirectory files;
  const std::string name = "a \"chain\" \\ of\ttwo.toml";
  fs::create_directories(files.path() / "models");
  fs::create_directories(files.path() / "elsewhere");
  write(files / ("models/" + name), chain("9.81"));
  fs::copy_file(test_plugin("spring-1"), files.path() / "models/spring.so");
  const Arguments with_model = chain_to("run", "models/" + name);
  const Arguments with_plugin = short_run_to(
      "run", {"--system", "test-spring", "--integrator", "verlet", "--plugin", "models/spring.so"});
  const Arguments projected =
      short_run_to("run", {"--system", "spherical-pendulum", "--integrator", "rattle", "--set",
                           "initial=0.6,0,-0.9,0,0.5,0", "--project-initial"});
  for (const Arguments& run : {with_model, with_plugin, projected}) {
    ASSERT_EQ(run_pfaff(run, in(files.path())).status, 0) << joined(run);
    Arguments repeated{"run", "--out", "again", "--config", "../run/config.toml"};
    if (run == with_plugin) repeated = repeated + Arguments{"--plugin", "../models/spring.so"};
    const Outcome again = run_pfaff(repeated, in(files.path() / "elsewhere"));
    EXPECT_EQ(again.status, 0) << again.err;
    expect_same_run(files.path() / "run", files.path() / "elsewhere/again");
    fs::remove_all(files.path() / "run");
    fs::remove_all(files.path() / "elsewhere/again");
  }
  ASSERT_EQ(run_pfaff(with_plugin, in(files.path())).status, 0);
  fs::remove(files.path() / "models/spring.so");
  expect_complaint(run_pfaff({"run", "--out", files / "lost", "--config", files / "run/config.toml"}), 2,
                   {"run/config.toml", "spring.so' is not loaded", "--plugin"}, "a plug-in that is gone");
}

// The C library has several variants of its functions, of which a setting chooses; the file is the same.
TEST(Identity, AnotherVariantOfLibmIsNoticed) {
#ifdef __x86_64__
  if (__builtin_cpu_supports("fma") == 0) GTEST_SKIP() << "this machine has one variant";
  const TemporaryDirectory files;
  const auto run = [&](const std::string& out) {
    return short_run_to(files / out, {"--system", "pendulum", "--integrator", "verlet"});
  };
  const Arguments again{"run", "--out", files / "again", "--config", files / "run/config.toml"};
  ASSERT_EQ(run_pfaff(run("run")).status, 0);
  EXPECT_NE(text_of(files / "run/config.toml").find("\"values of libm\" = \"fnv-"), std::string::npos);
  for (const char* variant : {"glibc.cpu.hwcaps=-FMA,-AVX2", "glibc.cpu.hwcaps=-FMA,-AVX2,-AVX"}) {
    setenv("GLIBC_TUNABLES", variant, 1);
    expect_complaint(run_pfaff(again), 2, {"values of libm are others", "--force"}, variant);
    expect_complaint(run_pfaff(run("run")), 2, {"values of libm are others", "--force"}, variant);
    // The control: a run that was made with the variant is repeated with it.
    ASSERT_EQ(run_pfaff(run("other")).status, 0);
    EXPECT_EQ(run_pfaff({"run", "--out", files / "same", "--config", files / "other/config.toml"}).status, 0);
    EXPECT_NE(text_of(files / "other/config.toml"), text_of(files / "run/config.toml"));
    for (const char* made : {"other", "same"}) fs::remove_all(files.path() / made);
  }
  unsetenv("GLIBC_TUNABLES");
  EXPECT_EQ(run_pfaff(again).status, 0);
#endif
}

// An experiment with one case, of a model file.
std::string model_experiment(const fs::path& model, const std::string& more) {
  return "schema = 1\ntitle = \"A test\"\n[[method]]\nlabel = \"RATTLE\"\nintegrator = \"rattle\"\n"
         "[[case]]\nname = \"chain\"\nsystem = \"bead-rod\"\ntime = \"0.5\"\nsteps = [\"0.01\", \"0.02\"]\n"
         "set = { model = '" +
         model.string() + "' }\n" + more;
}

TEST(Identity, AnExperimentMakesChangedRunsAnew) {
  const TemporaryDirectory files;
  const fs::path out = files.path() / "out", series = out / "runs/chain-rattle-h0.01/series.csv";
  const auto compare = [&](const Arguments& more) {
    return run_pfaff(
        Arguments{"compare", files / "test.toml", "--quick", "--json", "--no-report", "--out", out.string()} +
        more);
  };
  const auto resumed = [&](const Outcome& outcome) {
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return json_of(outcome.out)["experiments"][0]["resumed"].get<int>();
  };
  write(files / "chain.toml", chain("9.81"));
  write(files / "test.toml", model_experiment(files / "chain.toml", ""));
  EXPECT_EQ(resumed(compare({})), 0);
  EXPECT_EQ(resumed(compare({})), 2);
  const std::string before = text_of(series), costs = text_of(out / "cost.csv");

  // A run of an experiment is repeated from its config.toml, references, residuals and names included.
  ASSERT_EQ(run_pfaff({"run", "--out", files / "again", "--config",
                       (out / "runs/chain-rattle-h0.01/config.toml").string()})
                .status,
            0);
  expect_same_run(series.parent_path(), files.path() / "again");

  write(files / "chain.toml", chain("1.62"));
  expect_complaint(compare({}), 2, {"chain.toml has changed", "--force"}, "compare");
  EXPECT_EQ(text_of(series), before);
  EXPECT_EQ(resumed(compare({"--force"})), 0);
  EXPECT_NE(text_of(series), before);
  EXPECT_NE(text_of(out / "cost.csv"), costs) << "timings of another model are kept";
  EXPECT_EQ(resumed(compare({"--force"})), 2) << "--force is for what has changed";

  // What is measured belongs to the settings of the runs.
  const std::string residuals = text_of(series);
  EXPECT_NE(residuals.find("structure_residual"), std::string::npos);
  write(files / "test.toml", model_experiment(files / "chain.toml", "structure = \"none\"\n"));
  EXPECT_EQ(resumed(compare({})), 0);
  EXPECT_EQ(text_of(series).find("structure_residual"), std::string::npos);
}

TEST(Identity, DamagedRunsAreMadeAnew) {
  const TemporaryDirectory files;
  const fs::path out = files.path() / "out", run = out / "runs/chain-rattle-h0.01";
  write(files / "chain.toml", chain("9.81"));
  write(files / "test.toml", model_experiment(files / "chain.toml", ""));
  const Arguments compare{"compare", files / "test.toml", "--quick", "--json", "--no-report",
                          "--out",   out.string()};
  ASSERT_EQ(run_pfaff(compare).status, 0);
  const std::string config = text_of(run / "config.toml"), series = text_of(run / "series.csv"),
                    summary = text_of(run / "summary.json");
  // All other damages stand in tests/bench/run_directory_test.cpp.
  const std::vector<std::pair<const char*, std::string>> damages{
      {"summary.json", "{}"},
      {"summary.json", "null"},
      {"series.csv", series.substr(0, series.size() / 2)},
      {"../../experiment.json", "{}"}};
  for (const auto& [name, content] : damages) {
    SCOPED_TRACE(std::string(name) + ": " + content.substr(0, 20));
    write(run / name, content);
    const Outcome outcome = run_pfaff(compare);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const bool of_run = std::string(name).find('/') == std::string::npos;
    EXPECT_EQ(json_of(outcome.out)["experiments"][0]["resumed"], of_run ? 1 : 2);
    EXPECT_EQ(text_of(run / "config.toml"), config);
    EXPECT_EQ(text_of(run / "series.csv"), series);
    EXPECT_EQ(text_of(run / "summary.json"), summary);
  }
}

}  // namespace
