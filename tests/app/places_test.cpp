// Errors in texts of users show their place: one line with file, line and column, and what was expected, then
// the line of the text and a caret under the place.
#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

/// A text, and what is said of it behind the name of its file.
struct Misplaced {
  std::string text, said;
};

// Refused with exit status 2, a line that ends with `said`, the line in question, and the caret.
void expect_place(const Arguments& command, const std::string& file, const Misplaced& bad) {
  const Outcome refused = run_pfaff(command);
  SCOPED_TRACE(bad.text + "\n" + refused.err);
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(refused.out, "");
  EXPECT_TRUE(refused.err.starts_with("pfaff: "));
  EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 3);
  EXPECT_TRUE(refused.err.ends_with("^\n"));
  EXPECT_NE(refused.err.find(file + ":" + bad.said + "\n"), std::string::npos)
      << "does not say: " << bad.said;
}

TEST(Places, OfWhatIsWrongInAFormula) {
  const TemporaryDirectory files;
  const std::string condition = "expected a comparison as its condition, such as x < y, before ','";
  for (const Misplaced& bad : {
           Misplaced{"mas*q^2", "4:14: unknown name 'mas'; did you mean 'mass'?"},
           {"q^2/(2*none)", "4:19: division by what is always zero where none = 0"},
           {"q^2/0", "4:18: division by what is always zero"},
           {"select(q, q^2, q)", "4:22: select: " + condition},
           {"select(mass + 1, q^2, q)", "4:29: select: " + condition},
           {"select(0 < q < 1, q, 1)", "4:27: select: expected one comparison as its condition"},
           {"select(q < 1, q)", "4:20: select: expected 3 arguments, got 2"},
           {"select(q == 1, q, 1)",
            "4:23: expected + - * / ^, a number or a name; conditions of select(condition, a, b) compare by "
            "< > "
            "<= or >="},
           {"(q < 1)*q", "4:17: values are compared in the condition of select(condition, a, b) alone"},
       }) {
    write(files / "bad.toml",
          "coordinates = [\"q\", \"p\"]\nparameters = { mass = 1, none = 0 }\n"
          "kinetic = \"p^2/2\"\npotential = \"" +
              bad.text + "\"\n");
    expect_place({"run", files / "bad.toml", "verlet", "--step", "0.1", "--time", "1", "--out", "-"},
                 files / "bad.toml", bad);
  }
  write(files / "bad.toml",
        "coordinates = [\"q\", \"p\"]\nparameters = { n = 2 }\n"
        "let = { c = [\"select(n < 3, vector(i, 1, 2, i), vector(i, 1, 3, i))\"] }\n"
        "kinetic = \"p^2/2\"\npotential = \"c[1]*q\"\n");
  expect_place({"describe", files / "bad.toml"}, files / "bad.toml",
               {"branches", "3:15: select: its branches stand for 2 and 3 values; expected as many in both"});
}

// Expressions of the command line know pi and the parameters of the system.
TEST(Places, OfNamesThatAreNoParameters) {
  const Arguments run{"run", "kepler", "verlet", "--out", "-"};
  expect_place(run + Arguments{"--step", "2*pi/n", "--time", "1"}, "--step",
               {"2*pi/n", "1:6: unknown name 'n'; expected one of: eccentricity, pi"});
  expect_place(run + Arguments{"--step", "0.1", "--time", "20*period"}, "--time",
               {"20*period", "1:4: unknown name 'period'; expected one of: eccentricity, pi"});
  expect_place(run + Arguments{"--step", "excentricity/10", "--time", "1"}, "--step",
               {"excentricity/10", "1:1: unknown name 'excentricity'; did you mean 'eccentricity'?"});
  expect_place(run + Arguments{"--step", "0.1", "--time", "1", "--set", "initial=2*a,0,0,1"}, "initial",
               {"2*a", "1:3: unknown name 'a'; expected one of: eccentricity, pi"});
  expect_place(run + Arguments{"--step", "0.1", "--time", "1", "--set", "eccentricity=ecc/2"},
               "parameter 'eccentricity' of kepler",
               {"ecc/2", "1:1: unknown name 'ecc'; expected one of: pi"});
}

TEST(Places, OfWhatIsNoJson) {
  const TemporaryDirectory files;
  const std::string expected = "expected a JSON object with t and z (or q and p, or q and v), ";
  for (const Misplaced& bad : {
           Misplaced{"z = [1, 0]", "1:1: " + expected + "got 'z'"},
           {R"({"z": [1, 0])", "1:13: " + expected + "which ends unfinished"},
           {"{\"t\": 0,\n \"z\": [1, ", "2:11: " + expected + "which ends unfinished"},
           {"{\"z\": [1,\n0]]", "2:3: " + expected + "got '0]]'"},
       }) {
    write(files / "state.json", bad.text);
    expect_place({"run", "pendulum", "verlet", "--step", "0.1", "--time", "1", "--out", "-", "--state",
                  files / "state.json"},
                 files / "state.json", bad);
  }
  write(files / "model.json", "{\"dimension\": 2,\n \"rods\": [");
  expect_place({"evaluate", "bead-rod", "--set", "model=" + (files / "model.json")}, files / "model.json",
               {"a model", "2:11: expected JSON, which ends unfinished"});
}

}  // namespace
