// Timings that are read again may have been edited or cut: what no timing can have given is measured anew,
// and the rest is kept as it is.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include <pfaff/bench/experiment/costs.hpp>
#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/runner/files.hpp>
#include "../temporary_directory.hpp"

namespace {

using namespace pfaff;
using namespace pfaff::testing;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}
std::string joined_lines(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

class Timings : public ::testing::Test {
 protected:
  TemporaryDirectory directory;
  const fs::path costs = directory.path() / "out/cost.csv", machine = directory.path() / "out/machine.json";
  Experiment experiment() {
    write_file(directory.path() / "test.toml",
               "schema = 1\ntitle = \"A test\"\n[[method]]\nlabel = \"A, \\\"b\\\"\"\nintegrator = \"rk4\"\n"
               "[[method]]\nlabel = \"Verlet\"\nintegrator = \"verlet\"\n"
               "[[case]]\nname = \"c\"\nsystem = \"pendulum\"\ntime = 1\nsteps = [0.5, 0.25]\n");
    return read_experiment(directory / "test.toml", true);
  }
  void make() {
    (void)run_experiment(experiment(), directory.path() / "out", {}, {.report = false, .timing = 1e-4});
  }
};

TEST_F(Timings, ThatAreNotPlausibleAreMeasuredAnew) {
  make();
  const std::vector<std::string> whole = lines_of(read_file(costs));
  ASSERT_EQ(whole.size(), 5U);
  // Of a row: its key, its numbers, and the host.
  const std::string key = whole[1].substr(0, whole[1].find(",0.5,") + 5);
  const std::string host = whole[1].substr(whole[1].rfind(',') + 1);
  for (const std::string numbers : {"inf,10,20,7,0.1,",
                                    "-1,10,20,7,0.1,",
                                    "nan,10,20,7,0.1,",
                                    "abc,10,20,7,0.1,",
                                    ",10,20,7,0.1,",
                                    "15,inf,20,7,0.1,",
                                    "15,-1,20,7,0.1,",
                                    "15,nan,20,7,0.1,",
                                    "15,10,inf,7,0.1,",
                                    "15,10,nan,7,0.1,",
                                    "9,10,20,7,0.1,",
                                    "21,10,20,7,0.1,",
                                    "15,10,20,0,0.1,",
                                    "15,10,20,-7,0.1,",
                                    "15,10,20,7.5,0.1,",
                                    "15,10,20,inf,0.1,",
                                    "15,10,20,7,0,",
                                    "15,10,20,7,-1,",
                                    "15,10,20,7,nan,",
                                    "15,10,20,7,inf,",
                                    "15,10,1e9,7,0.1,",
                                    "1e300,1e300,1e300,7,1e300,",
                                    "15,10,20,7,0.1",
                                    "15,10,20,7,",
                                    "15 ,10,20,7,0.1,",
                                    "0x1p3,8,9,7,0.1,",
                                    "15"}) {
    SCOPED_TRACE(numbers);
    std::vector<std::string> edited = whole;
    edited[1] = key + numbers + (numbers.ends_with(',') ? host : "");
    write_file(costs, joined_lines(edited));
    EXPECT_EQ(read_costs(costs, expand(experiment())).size(), 3U);
    make();
    const std::vector<std::string> again = lines_of(read_file(costs));
    ASSERT_EQ(again.size(), 5U);
    EXPECT_NE(again[1], edited[1]);
    EXPECT_TRUE(again[1].starts_with(key)) << again[1];
    for (const std::size_t k : {0U, 2U, 3U, 4U}) EXPECT_EQ(again[k], whole[k]);
    const auto read = read_costs(costs, expand(experiment()));
    EXPECT_EQ(read.size(), 4U);
    for (const auto& [of, row] : read) EXPECT_TRUE(std::isfinite(row.median) && row.median > 0) << of;
  }
  // Controls: other numbers that timings can have are kept, and so is what is measured as nothing.
  for (const std::string numbers : {"15,10,20,7,0.1,", "1e6,9.5e+05,2e6,7,0.5,", "0,0,0,7,1e-07,"}) {
    std::vector<std::string> edited = whole;
    edited[1] = key + numbers + host;
    write_file(costs, joined_lines(edited));
    make();
    EXPECT_EQ(lines_of(read_file(costs)), edited);
  }
}

TEST_F(Timings, OfAFileThatIsCutAreThoseBeforeTheCut) {
  make();
  const std::string whole = read_file(costs);
  const std::vector<std::string> lines = lines_of(whole);
  for (std::size_t cut = lines[0].size(); cut < whole.size(); cut += 1 + whole.size() / 60) {
    SCOPED_TRACE(cut);
    write_file(costs, whole.substr(0, cut));
    const auto ends = static_cast<std::size_t>(
        std::count(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(cut), '\n'));
    EXPECT_EQ(read_costs(costs, expand(experiment())).size(), ends == 0 ? 0 : ends - 1);
  }
}

TEST_F(Timings, AreThoseOfAMachine) {
  make();
  const std::string whole = read_file(costs), facts = read_file(machine);
  const auto lines = [&] { return lines_of(read_file(costs)); };
  for (const std::string& damaged : {facts.substr(0, facts.size() / 2), std::string("{}"), std::string("[1]"),
                                     std::string("{\"cpu\": 1}"), std::string()}) {
    SCOPED_TRACE(damaged);
    write_file(machine, damaged);
    write_file(costs, whole);
    make();
    ASSERT_EQ(lines().size(), 5U);
    for (std::size_t k = 1; k < 5; ++k) EXPECT_NE(lines()[k], lines_of(whole)[k]);
    const auto again = nlohmann::json::parse(read_file(machine), nullptr, false);
    ASSERT_TRUE(again.is_object());
    EXPECT_EQ(again["host"], nlohmann::json::parse(facts)["host"]);
  }
  write_file(machine, facts);
  write_file(costs, whole);
  make();
  EXPECT_EQ(read_file(costs), whole);
}

}  // namespace
