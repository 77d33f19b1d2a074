// Names of cases and methods become names of files: what is too long for one, or shares one, is refused
// before anything is run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/runner/files.hpp>
#include "../temporary_directory.hpp"

namespace {

using namespace pfaff;
using ::testing::HasSubstr;

std::string refusal_of(const std::vector<std::string>& cases, const std::vector<std::string>& labels) {
  const pfaff::testing::TemporaryDirectory files;
  std::string text = "schema = 1\ntitle = \"A test\"\n";
  for (const std::string& label : labels)
    text += "[[method]]\nlabel = \"" + label + "\"\nintegrator = \"rk4\"\n";
  for (std::size_t k = 0; k < cases.size(); ++k)
    text += "[[case]]\nname = \"" + cases[k] +
            "\"\nsystem = \"pendulum\"\ntime = 1\nsteps = [0.5]\nmethods = [\"" + labels[k % labels.size()] +
            "\"]\n";
  write_file(files.path() / "test.toml", text);
  try {
    (void)run_experiment(read_experiment(files / "test.toml", true), files.path() / "out", {},
                         {.report = false, .timing = 1e-4});
  } catch (const InputError& error) {
    EXPECT_FALSE(std::filesystem::exists(files / "out"));
    return error.what();
  }
  return {};
}

TEST(NamesOfRuns, AreNamesOfFiles) {
  const std::string too_long = "too long for the name of a directory";
  EXPECT_THAT(refusal_of({"c"}, {std::string(300, 'a')}), HasSubstr(too_long));
  EXPECT_THAT(refusal_of({std::string(300, 'a')}, {"RK4"}), HasSubstr(too_long));
  EXPECT_THAT(refusal_of({std::string(120, 'b')}, {std::string(120, 'a')}), HasSubstr(too_long));
  // Of the letters, case, method and step have 193 together, and what stands between them the rest.
  EXPECT_EQ(refusal_of({"c"}, {std::string(193, 'a')}), "");
  EXPECT_THAT(refusal_of({"c"}, {std::string(194, 'a')}), HasSubstr("200 letters at most, got 201"));
  EXPECT_EQ(refusal_of({std::string(95, 'c')}, {std::string(99, 'a')}), "");
}

TEST(NamesOfRuns, AreTheirOwn) {
  EXPECT_THAT(refusal_of({"a b", "a-b"}, {"RK4", "other"}), HasSubstr("cases 'a b' and 'a-b' would share"));
  EXPECT_THAT(refusal_of({"A", "a"}, {"RK4", "other"}), HasSubstr("would share the names of their figures"));
  EXPECT_THAT(refusal_of({"x (1)", "x [1]"}, {"RK4"}), HasSubstr("would share the names of their figures"));
  EXPECT_EQ(refusal_of({"a b", "a c"}, {"RK4", "other"}), "");
}

}  // namespace
