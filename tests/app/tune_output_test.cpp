// Where `pfaff tune` writes: it finds out before it searches, writes over nothing, and loses no table.
#include <sys/stat.h>

#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

// A search of so many starts takes hours: what is refused is refused before it.
Arguments long_search(const std::string& out) {
  return {"tune", "pendulum", "--step", "0.5", "--stages", "6", "--starts", "1000000000", "--out", out};
}
Arguments short_search(const std::string& out) {
  return {"tune",     "pendulum", "--step",   "0.5", "--order", "2",
          "--stages", "2",        "--starts", "1",   "--out",   out};
}

TEST(TuneOutput, IsRefusedBeforeTheSearch) {
  const TemporaryDirectory files;
  write(files / "taken.toml", "mine");
  fs::create_directory(files / "directory.toml");
  fs::create_symlink(files / "taken.toml", files / "link.toml");
  fs::create_symlink(files / "nowhere.toml", files / "dangling.toml");
  ASSERT_EQ(mkfifo((files / "pipe.toml").c_str(), 0600), 0);
  for (const char* name : {"taken.toml", "directory.toml", "link.toml", "dangling.toml", "pipe.toml"})
    expect_complaint(run_pfaff(long_search(files / name)), 2, {"--out", name, "exists already"}, name);
  EXPECT_EQ(text_of(files / "taken.toml"), "mine");
  EXPECT_FALSE(fs::exists(files / "nowhere.toml"));
  for (const std::string& path : {files / "no/such/place.toml", files / "taken.toml/x.toml",
                                  std::string("/proc/tuned.toml"), files / (std::string(300, 'a') + ".toml")})
    expect_complaint(run_pfaff(long_search(path)), 2, {"--out", "cannot be made"}, path);
}

TEST(TuneOutput, KeepsTheTableWhereItCannotBeWritten) {
  const TemporaryDirectory files;
  Circumstances full;
  full.largest_file = 10;  // a file can be made, but not filled
  for (const Arguments& more : {Arguments{}, Arguments{"--quiet"}, Arguments{"--json"}}) {
    const Outcome outcome = run_pfaff(short_search(files / "tuned.toml") + more, full);
    SCOPED_TRACE(joined(more));
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.out.find("drift = ["), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.err.find("cannot write " + files / "tuned.toml"), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find('\n') + 1, outcome.err.size()) << outcome.err;
    EXPECT_TRUE(fs::is_empty(files.path()));
  }
  // Control: with room for it, the same table is written, and a table printed is one.
  const Outcome outcome = run_pfaff(short_search(files / "tuned.toml") + Arguments{"--json"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(text_of(files / "tuned.toml"), json_of(outcome.out)["table"].get<std::string>());
  // The user's own file beside it has nothing to do with it.
  write(files / "again.toml.part", "mine");
  EXPECT_EQ(run_pfaff(short_search(files / "again.toml") + Arguments{"--quiet"}).status, 0);
  EXPECT_EQ(text_of(files / "again.toml.part"), "mine");
}

}  // namespace
