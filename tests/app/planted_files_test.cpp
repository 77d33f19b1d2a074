// What stands in an output directory before the program writes there is never written over and never
// followed: links, pipes, and files of the user's own under the names that the program uses for itself.
#include <sys/stat.h>

#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

Arguments planted_run_to(const std::string& out) {
  const std::string plugin = test_plugin("spring-1");
  return {"run",    "--out", out,      "--system", "test-spring", "--integrator", "verlet",
          "--step", "0.01",  "--time", "0.1",      "--json",      "--plugin",     plugin};
}

class PlantedFiles : public ::testing::Test {
 protected:
  TemporaryDirectory files;
  const fs::path out = files.path() / "out", victim = files.path() / "victim";
  void SetUp() override {
    fs::create_directory(out);
    write(victim.string(), "mine");
  }
};

TEST_F(PlantedFiles, LocksThatAreNoneAreLeftAlone) {
  const fs::path lock = out / ".lock";
  const auto expect_left_alone = [&](const std::string& what) {
    SCOPED_TRACE(what);
    const Outcome outcome = run_pfaff(planted_run_to(out));
    expect_complaint(outcome, 2, {out.string(), ".lock", "Pfaff has not written"}, what);
    EXPECT_EQ(text_of(victim.string()), "mine");
    EXPECT_EQ(std::distance(fs::directory_iterator(out), {}), 1);
    fs::remove(lock);
  };
  fs::create_symlink(victim, lock);
  expect_left_alone("a link to a file");
  fs::create_symlink(files.path() / "nowhere", lock);
  expect_left_alone("a link to nowhere");
  EXPECT_FALSE(fs::exists(files.path() / "nowhere"));
  fs::create_hard_link(victim, lock);
  expect_left_alone("another name of a file");
  write(lock.string(), "a list of locks and keys");
  expect_left_alone("a file of the user's own");
  ASSERT_EQ(mkfifo(lock.c_str(), 0600), 0);
  expect_left_alone("a pipe");
  fs::create_directory(lock);
  expect_left_alone("a directory");
  // Controls: what a lock has left, also one that was killed before it had written into it, is taken.
  for (const char* left : {"process 1 on nowhere (pfaff run) since 2020-01-01 00:00:00 UTC", ""}) {
    write(lock.string(), left);
    EXPECT_EQ(run_pfaff(planted_run_to(out)).status, 0);
    EXPECT_FALSE(fs::exists(lock));
  }
}

TEST_F(PlantedFiles, UnfinishedFilesAreMadeNew) {
  for (const char* name : {"config.toml.part", "summary.json.part"}) {
    fs::create_symlink(victim, out / name);
    EXPECT_EQ(run_pfaff(planted_run_to(out)).status, 0) << name;
    EXPECT_EQ(text_of(victim.string()), "mine") << name;
    EXPECT_FALSE(fs::exists(fs::symlink_status(out / name))) << name;
    for (const char* file : {"config.toml", "series.csv", "summary.json"}) {
      EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(out / file))) << file;
      fs::remove(out / file);
    }
    fs::create_hard_link(victim, out / name);
    EXPECT_EQ(run_pfaff(planted_run_to(out)).status, 0) << name;
    EXPECT_EQ(text_of(victim.string()), "mine") << name;
    for (const char* file : {"config.toml", "series.csv", "summary.json"}) fs::remove(out / file);
  }
  // A link under the name of a finished file is replaced, not followed.
  EXPECT_EQ(run_pfaff(planted_run_to(out)).status, 0);
  fs::remove(out / "series.csv");
  fs::create_symlink(victim, out / "series.csv");
  EXPECT_EQ(run_pfaff(planted_run_to(out)).status, 0);
  EXPECT_EQ(text_of(victim.string()), "mine");
  EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(out / "series.csv")));
}

TEST_F(PlantedFiles, ThereIsNoOtherFileOfOurOwn) {
  fs::create_symlink(victim, out / ".probe");
  expect_complaint(run_pfaff(planted_run_to(out)), 2, {"exists already"}, ".probe");
  EXPECT_EQ(text_of(victim.string()), "mine");
  fs::remove(out / ".probe");
  fs::create_symlink(files.path() / "nowhere", files.path() / "dangling");
  expect_complaint(run_pfaff(planted_run_to(files / "dangling")), 2, {"exists already"}, "a link to nowhere");
}

}  // namespace
