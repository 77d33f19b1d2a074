// What a directory holds of a run, the builds of loaded objects, and locks on directories.
#include <gtest/gtest.h>

#include <fstream>

#include <pfaff/bench/runner/config_file.hpp>
#include <pfaff/bench/runner/directory_lock.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/bench/runner/run_directory.hpp>
#include <pfaff/core/process/checksum.hpp>
#include <pfaff/core/process/loaded_objects.hpp>
#include "../temporary_directory.hpp"

namespace pfaff {
namespace {

using testing::TemporaryDirectory;

ResolvedRun resolved_pendulum(const std::string& time) {
  RunSettings s;
  s.system = "damped-pendulum";
  s.integrator = "rk4";
  s.step = "0.1";
  s.time = time;
  return resolve(s);
}
void put(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
}

TEST(Checksum, IsSha1) {  // FIPS 180-2, appendix A
  EXPECT_EQ(sha1_of("abc"), "a9993e364706816aba3e25717850c26c9cd0d89d");
  EXPECT_EQ(sha1_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "84983e441c3bd26ebaae4aa1f95129e5e54670f1");
  EXPECT_EQ(sha1_of(""), "da39a3ee5e6b4b0d3255bfef95601890afd80709");
}

TEST(RunDirectory, AnyDamagedByteIsNoticed) {
  const TemporaryDirectory files;
  const ResolvedRun run = resolved_pendulum("2");
  (void)write_run(files.path(), run, nullptr);
  ASSERT_TRUE(kept_run(files.path(), run).current());
  for (const std::string& name : run_file_names()) {
    const std::string whole = read_file(files.path() / name);
    for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 40) {
      SCOPED_TRACE(name + ", byte " + std::to_string(at));
      for (const char other : {' ', '\0', '9', '"', '\xff'}) {
        if (whole[at] == other) continue;
        std::string damaged = whole;
        damaged[at] = other;
        put(files / name, damaged);
        EXPECT_FALSE(kept_run(files.path(), run).current());
      }
      put(files / name, whole.substr(0, at));
      EXPECT_FALSE(kept_run(files.path(), run).current());
    }
    for (const char* instead : {"", "{}", "null", "[]", "1", "\"\"", "{\"checksum\": 1}"}) {
      put(files / name, instead);
      EXPECT_FALSE(kept_run(files.path(), run).current()) << name << ' ' << instead;
    }
    std::filesystem::remove(files.path() / name);
    EXPECT_FALSE(kept_run(files.path(), run).current());
    std::filesystem::create_directory(files.path() / name);
    EXPECT_FALSE(kept_run(files.path(), run).current());
    std::filesystem::remove(files.path() / name);
    put(files / name, whole);
    ASSERT_TRUE(kept_run(files.path(), run).current());
  }
}

TEST(RunDirectory, IsThatOfOneRun) {
  const TemporaryDirectory files;
  const ResolvedRun run = resolved_pendulum("2");
  (void)write_run(files.path(), run, nullptr);
  EXPECT_TRUE(kept_run(files.path(), resolved_pendulum("2")).current());
  const KeptRun of_another = kept_run(files.path(), resolved_pendulum("3"));
  EXPECT_TRUE(of_another.whole);
  EXPECT_TRUE(of_another.other);
  EXPECT_FALSE(of_another.current());
  EXPECT_FALSE(of_another.outdated());
  // The text of one run may begin with that of another.
  ResolvedRun longer = run;
  longer.origins = {};
  (void)write_run(files.path(), longer, nullptr);
  EXPECT_FALSE(kept_run(files.path(), longer).other);

  const std::atomic<bool> stop{true};
  EXPECT_EQ(write_run(files.path(), run, nullptr, {}, &stop)["status"], "interrupted");
  EXPECT_TRUE(kept_run(files.path(), run).same());
  EXPECT_FALSE(kept_run(files.path(), run).whole);
}

TEST(RunDirectory, OriginsThatChangeMakeItOutdated) {
  const TemporaryDirectory files;
  ResolvedRun run = resolved_pendulum("1");
  EXPECT_GE(run.origins.libraries.size(), 2U);
  run.origins.files = {{"/models/a.toml", "1"}};
  run.origins.plugins = {{"/plugins/b.so", "2"}};
  (void)write_run(files.path(), run, nullptr);
  EXPECT_TRUE(kept_run(files.path(), run).current());
  const auto changed = [&](const ResolvedRun& now) {
    const KeptRun kept = kept_run(files.path(), now);
    EXPECT_EQ(kept.outdated(), !kept.changed.empty());
    return in_one_line(kept.changed);
  };
  ResolvedRun now = run;
  now.origins.files[0].second = "3";
  EXPECT_EQ(changed(now), "/models/a.toml has changed");
  now = run;
  now.origins.plugins[0].second = "3";
  EXPECT_EQ(changed(now), "b.so is another build");
  now.origins.plugins[0] = {"/other/place/b.so", "2"};
  EXPECT_EQ(changed(now), "");
  now.origins.libraries[0].second += "0";
  EXPECT_EQ(changed(now), run.origins.libraries[0].first + " is another build");
  now = run;
  now.origins.files[0].first = "/models/c.toml";
  EXPECT_EQ(changed(now), "/models/a.toml is no longer a part of it, /models/c.toml has become a part of it");
}

TEST(LoadedObjects, HaveBuilds) {
  const auto objects = loaded_objects();
  ASSERT_GT(objects.size(), 3U);
  for (const char* name : {"libpfaff.so", "libpfaff_bench.so"}) {
    const auto found = std::find_if(objects.begin(), objects.end(), [&](const LoadedObject& object) {
      return object.path.find(name) != std::string::npos;
    });
    ASSERT_NE(found, objects.end()) << name;
    EXPECT_GE(found->build.size(), 40U);
  }
  const auto& verlet = integrators().get("verlet", "integrator");
  EXPECT_EQ(object_holding(&verlet).path, shipped_plugins_path());
  static const int here = 0;
  EXPECT_EQ(object_holding(&here).path, objects.front().path) << "the program";
  EXPECT_NE(object_holding(&here).build, object_holding(&verlet).build);
  const int on_the_stack = 0;
  EXPECT_THROW((void)object_holding(&on_the_stack), std::logic_error);
}

TEST(DirectoryLock, HoldsOthersOffWhileItLives) {
  const TemporaryDirectory files;
  const auto refusal = [&] {
    try {
      const DirectoryLock second(files.path(), "second");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  {
    const DirectoryLock first(files.path(), "the first test");
    for (int k = 0; k < 2; ++k) {  // being refused does not let go of it
      const std::string said = refusal();
      for (const std::string& part : {files.path().string(), "process " + std::to_string(getpid()),
                                      std::string("the first test"), std::string("since 20")})
        EXPECT_NE(said.find(part), std::string::npos) << said;
    }
  }
  EXPECT_TRUE(std::filesystem::is_empty(files.path()));
  EXPECT_EQ(refusal(), "");
  put(files / DirectoryLock::file_name, "process 1 on nowhere");  // as a process leaves it that was killed
  EXPECT_EQ(refusal(), "");
}

// Everything that a path may hold comes back as it was.
TEST(ConfigFile, EscapesTexts) {
  const TemporaryDirectory files;
  const std::string path = files / "a \"b\" \\c\n\t\x01 \x7f 'ü'.toml";
  put(path,
      "dimension = 2\nmasses = [1]\nanchors = { origin = [0, 0] }\nrods = [[0, \"origin\"]]\n"
      "positions = [[1, 0]]\n");
  RunSettings settings;
  settings.system = "bead-rod";
  settings.integrator = "rattle";
  settings.step = "0.1";
  settings.time = "1";
  settings.set = {{"model", path}};
  settings.of_case = "a\nb\"";
  const std::string text = config_text(resolve(settings));
  put(files / "config.toml", text);
  const RunConfig again = read_config(files / "config.toml");
  EXPECT_EQ(config_text(resolve(again.settings)), text);
  EXPECT_EQ(again.settings.of_case, settings.of_case);
  ASSERT_EQ(again.origins.files.size(), 1U);
  EXPECT_EQ(again.origins.files[0], (std::pair{path, sha1_of(read_file(path))}));
  EXPECT_GE(again.origins.libraries.size(), 2U);
  settings.set = {{"model", files / "\xff.toml"}};
  EXPECT_THROW((void)resolve(settings), InputError);
}

}  // namespace
}  // namespace pfaff
