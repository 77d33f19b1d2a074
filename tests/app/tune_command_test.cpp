// pfaff tune: what it prints and writes, and what it refuses.
#include <pfaff/tests/temporary_directory.hpp>

#include "command.hpp"

namespace {
using namespace pfaff::testing;

TEST(Tune, WritesATableThatIsAnIntegrator) {
  const TemporaryDirectory directory;
  const std::string file = directory / "tuned.toml";
  const Outcome outcome = run_pfaff({"tune", "pendulum", "--step", "0.5", "--stages", "4", "--starts", "4",
                                     "--json", "--name", "tuned-pendulum", "--out", file});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto j = json_of(outcome.out);
  EXPECT_EQ(j["verified"], true);
  EXPECT_GT(j["shadow_error"].get<double>(), 0);
  const Outcome described = run_pfaff({"describe", file});
  EXPECT_EQ(described.status, 0) << described.err;
  EXPECT_NE(described.out.find("tuned-pendulum"), std::string::npos);
  EXPECT_EQ(run_pfaff({"run", "pendulum", file, "--step", "0.5", "--time", "5", "--out", "-"}).status, 0);
}

// A copy of a table with a digit of the first number after `key` changed.
std::string with_a_changed_number(const TemporaryDirectory& directory, const std::string& table,
                                  const std::string& key, const std::string& name) {
  std::string text = text_of(table);
  const std::size_t digit = text.find('.', text.find("drift = [", text.find(key))) + 12;
  text[digit] = text[digit] == '5' ? '6' : '5';
  write(directory / name, text);
  return directory / name;
}

TEST(Tune, WritesAProcessedMethodWhoseEveryNumberCounts) {
  const TemporaryDirectory directory;
  const std::string file = directory / "tuned.toml";
  const Outcome outcome =
      run_pfaff({"tune", "pendulum", "--step", "0.5", "--stages", "4", "--processor", "4", "--starts", "8",
                 "--json", "--name", "processed-pendulum", "--out", file});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto j = json_of(outcome.out);
  EXPECT_EQ(j["verified"], true);
  EXPECT_EQ(j["processor"], 4);
  EXPECT_LE(j["kernel_error"].get<double>(), j["shadow_error"].get<double>());
  EXPECT_NE(j["table"].get<std::string>().find("kind = \"processed\""), std::string::npos);
  EXPECT_EQ(run_pfaff({"verify", file}).status, 0);
  EXPECT_EQ(run_pfaff({"run", "pendulum", file, "--step", "0.5", "--time", "5", "--out", "-"}).status, 0);
  // A number of the kernel or of the processor that is wrong by 1e-12 to 1e-11 is told by its condition.
  const Outcome kernel =
      run_pfaff({"describe", with_a_changed_number(directory, file, "[kernel]", "kernel.toml")});
  EXPECT_EQ(kernel.status, 2);
  EXPECT_NE(kernel.err.find("is not of effective order 4"), std::string::npos) << kernel.err;
  EXPECT_NE(kernel.err.find("is off by"), std::string::npos) << kernel.err;
  const Outcome pre = run_pfaff({"describe", with_a_changed_number(directory, file, "[pre]", "pre.toml")});
  EXPECT_EQ(pre.status, 2);
  EXPECT_NE(pre.err.find("the Lie word drift kick = 0, a condition of order 2, is off by"), std::string::npos)
      << pre.err;
}

TEST(Tune, ShowsOthersBeside) {
  const Outcome outcome = run_pfaff({"tune", "pendulum", "--step", "0.5", "--stages", "4", "--starts", "4",
                                     "--json", "--beside", PFAFF_GOLDEN "/../../examples/tables/pefrl.toml"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto j = json_of(outcome.out);
  EXPECT_EQ(j["verified"], nullptr);
  // PEFRL has four forces, too.
  EXPECT_LE(j["shadow_error"].get<double>(), j["beside"][0]["shadow_error"].get<double>());
}

TEST(Tune, Refusals) {
  const auto refused = [](std::vector<std::string> arguments, const std::string& said) {
    arguments.insert(arguments.begin(), "tune");
    const Outcome outcome = run_pfaff(arguments);
    EXPECT_EQ(outcome.status, 2) << outcome.out;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  refused({"pendulum", "--step", "0.5", "--stages", "3"}, "expected at least 4 forces");
  refused({"pendulum", "--step", "0.5", "--stages", "2", "--processor", "3"}, "expected at least 3 forces");
  refused({"pendulum", "--step", "0.5", "--processor", "2"}, "expected at least 3 kicks");
  refused({"pendulum", "--step", "0.5", "--processor", "-1"}, "a processor of -1 kicks");
  refused({"pendulum", "--step", "0.5", "--order", "5"}, "expected 2, 4 or 6");
  refused({"pendulum", "--step", "0"}, "--step: expected");
  refused({"pendulum", "--step", "0.5", "--name", "My method"}, "kebab-case");
  refused({"pendulum", "--step", "0.5", "--out", "table.txt"}, ".toml");
  refused({"free-rigid-body", "--step", "0.5"}, "H = T(p) + V(q)");
  refused({"damped-oscillator", "--step", "0.5"}, "H = T(p) + V(q)");
  refused({"pendulum", "--step", "0.5", "--beside", "gauss"}, "expected a splitting");
}

}  // namespace
