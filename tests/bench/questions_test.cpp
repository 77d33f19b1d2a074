// What an experiment asks, and to which families its methods belong, as the file says it and experiment.json
// has it.
#include <gtest/gtest.h>

#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/core/errors/errors.hpp>

#include "../temporary_directory.hpp"

namespace {

using namespace pfaff;

TEST(Questions, CasesAskWhatTheHeadAsksUnlessTheyAskTheirOwn) {
  const pfaff::testing::TemporaryDirectory files;
  const auto read = [&](const std::string& text) {
    write_file(files / "test.toml", "schema = 1\ntitle = \"A test\"\n" + text);
    return read_experiment(files / "test.toml", true);
  };
  const std::string method = "[[method]]\nlabel = \"GF\"\nintegrator = \"generating-function\"\n";
  const std::string one = "[[case]]\nsystem = \"harmonic-oscillator\"\ntime = 1\nsteps = [0.5]\n";
  const std::string asked = "equation = \"$q'' = -q$\"\nquestion = \"What?\"\nanswer = \"energy\"\n";
  const Experiment e =
      read(asked + method + one + "name = \"a\"\n" + one + "name = \"b\"\nanswer = \"structure\"\n");
  EXPECT_EQ(e.cases[0].asked.question, "What?");
  EXPECT_EQ(e.cases[0].asked.answer, "energy");
  EXPECT_EQ(e.cases[1].asked.question, "What?");
  EXPECT_EQ(e.cases[1].asked.answer, "structure");
  (void)run_experiment(e, files / "out", {}, {.report = false});
  const auto j = nlohmann::json::parse(read_file(files / "out/experiment.json"));
  EXPECT_EQ(j["cases"][1]["answer"], "structure");
  EXPECT_EQ(j["cases"][1]["question"], "What?");
  EXPECT_EQ(j["cases"][1]["equation"], "$q'' = -q$");
  EXPECT_EQ(j["methods"][0]["family"], "generating");
  EXPECT_FALSE(j["methods"][0].contains("another_motion"));
  EXPECT_THROW(read("answer = \"enery\"\n" + method + one + "name = \"a\"\n"), InputError);
}

}  // namespace
