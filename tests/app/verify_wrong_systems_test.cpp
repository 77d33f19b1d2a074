// pfaff verify on systems that are not what they state.
#include <fstream>
#include <string>

#include "command.hpp"

namespace {

using namespace pfaff::testing;

// Methods are not judged on a system that is wrong.
TEST(VerifyWrongSystems, BlamesNoMethodForThem) {
  const TemporaryDirectory files;
  const std::string file = files / "wrong.toml";
  std::ofstream(file) << "name = \"wrong\"\ncoordinates = [\"q\", \"p\"]\ninitial = [0.5, 0.3]\n"
                         "kinetic = \"p^2/2\"\npotential = \"q^4/4\"\nforce = [\"-q^3 - 1e-6*q\"]\n";
  const Outcome outcome = run_pfaff({"verify", file});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(outcome.out.starts_with("NOT OK: ")) << outcome.out;
  EXPECT_NE(outcome.out.find("written force is the derived one"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find(" on wrong"), std::string::npos) << outcome.out;
  const auto checks = nlohmann::json::parse(run_pfaff({"verify", file, "--json"}).out)["checks"];
  int left = 0;
  for (const auto& check : checks)
    left += check["reason"] == "not judged: wrong is itself not what it states";
  EXPECT_GT(left, 10);
}

// Systems are told apart by what they are asked for by.
TEST(VerifyWrongSystems, AreToldFromOthersOfTheirName) {
  const TemporaryDirectory files;
  const std::string wrong = files / "wrong.toml", right = files / "right.toml";
  const std::string model =
      "name = \"twin\"\ncoordinates = [\"q\", \"p\"]\ninitial = [0.5, 0.3]\n"
      "kinetic = \"p^2/2\"\npotential = \"q^4/4\"\n";
  std::ofstream(wrong) << model << "force = [\"-q^3 - 1e-6*q\"]\n";
  std::ofstream(right) << model;
  const auto checks = nlohmann::json::parse(run_pfaff({"verify", wrong, right, "--json"}).out)["checks"];
  int judged = 0;
  for (const auto& check : checks) judged += check["plugin"] == "verlet" && check["result"] == "pass";
  EXPECT_GT(judged, 5);
}

}  // namespace
