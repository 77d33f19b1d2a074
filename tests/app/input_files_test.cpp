// Files that never end, or never begin, are refused before they are read, whatever they are to be: a pipe to
// which nobody writes, a device, and a file that is longer than the disk.
#include <sys/stat.h>

#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

TEST(InputFiles, WhatIsNoRegularFileIsRefusedEverywhere) {
  const TemporaryDirectory files;
  const Arguments run{"run", "--step", "0.1", "--time", "1", "--out", "-"};
  const auto commands = [&](const std::string& toml, const std::string& json) {
    return std::vector<Arguments>{
        run + Arguments{"--system", toml, "--integrator", "verlet"},
        run + Arguments{"--system", "pendulum", "--integrator", toml},
        run + Arguments{"--system", "pendulum", "--integrator", "verlet", "--state", json},
        run + Arguments{"--system", "bead-rod", "--integrator", "rattle", "--set", "model=" + json},
        run + Arguments{"--system", "bead-rod", "--integrator", "rattle", "--set", "model=" + toml},
        {"run", "--config", toml, "--out", "-"},
        {"compare", toml},
        {"verify", toml},
        {"describe", toml},
        {"evaluate", "--system", toml},
        {"list", "integrators", "--plugin", toml}};
  };
  const auto refused_with = [&](const std::string& kind, const std::string& toml, const std::string& json) {
    for (const Arguments& command : commands(toml, json)) {
      SCOPED_TRACE(kind);
      expect_refused(command, {"cannot read ", kind});
    }
  };
  ASSERT_EQ(mkfifo((files / "pipe.toml").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo((files / "pipe.json").c_str(), 0600), 0);
  refused_with("it is a pipe; expected a regular file", files / "pipe.toml", files / "pipe.json");
  for (const char* name : {"zero.toml", "zero.json"}) fs::create_symlink("/dev/zero", files.path() / name);
  refused_with("it is a device; expected a regular file", files / "zero.toml", files / "zero.json");
  for (const char* name : {"long.toml", "long.json"}) {
    write(files.path() / name, "#");
    ASSERT_EQ(truncate((files / name).c_str(), off_t{1} << 40U), 0);
  }
  refused_with("more than 268435456 bytes", files / "long.toml", files / "long.json");
}

}  // namespace
