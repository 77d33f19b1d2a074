// The files that a system written as text is made of: when they are read, and that they belong to a run.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/runs/motion.hpp>
#include <pfaff/systems/text/text_system.hpp>

#include "../temporary_directory.hpp"

namespace {
using namespace pfaff;
namespace fs = std::filesystem;

TEST(TextModelFiles, TheContentsOfTheFilesBelongToARun) {
  const pfaff::testing::TemporaryDirectory directory;
  const fs::path file = directory.path() / "spring.toml";
  const auto write = [&](const std::string& stiffness) {
    std::ofstream(file)
        << "coordinates = [\"q\", \"p\"]\ninitial = [1, 0.2]\nkinetic = \"p^2/2\"\npotential = \"" +
               stiffness + "*q^2/2\"\n";
  };
  RunSettings settings;
  settings.system = file.string();
  settings.integrator = "verlet";
  settings.step = "0.1";
  settings.time = "1";
  write("2");
  const ResolvedRun first = resolve(settings), again = resolve(settings);
  EXPECT_EQ(&system_named(file.string()), &system_named(file.string()));
  ASSERT_EQ(first.origins.files.size(), 1U);
  EXPECT_EQ(first.origins.files[0].first, fs::absolute(file).lexically_normal().string());
  EXPECT_TRUE(differences(first.origins, again.origins).empty());
  write("3");
  const ResolvedRun changed = resolve(settings);
  EXPECT_EQ(differences(first.origins, changed.origins).size(), 1U);
}

TEST(TextModelFiles, AreMadeOfTheBracketThatWasRead) {
  const pfaff::testing::TemporaryDirectory directory;
  const fs::path file = directory.path() / "model.toml", bracket = directory.path() / "scaled.toml";
  const auto write = [&](const std::string& scale) {
    std::ofstream(bracket) << "coordinates = [\"q\", \"p\"]\nsymmetry = \"skew\"\njacobi = true\n"
                              "tensor = [[\"0\", \"" +
                                  scale + "\"], [\"-" + scale + "\", \"0\"]]\n";
  };
  std::ofstream(file) << "coordinates = [\"q\", \"p\"]\ninitial = [1, 0]\nbracket = \"scaled.toml\"\n"
                         "hamiltonian = \"p^2/2 + q^2/2\"\n";
  const auto force = [](const SystemPlugin& system) {
    const Problem<double> problem(system.make({}));
    std::vector<double> z{1, 0}, rate(2);
    problem.field(0, z, rate);
    return rate[1];
  };
  write("2");
  const SystemPlugin& before = system_named(file.string());
  EXPECT_EQ(force(before), -2);
  write("3");
  EXPECT_EQ(force(before), -2);
  EXPECT_EQ(force(system_named(file.string())), -3);
  fs::remove(bracket);
  EXPECT_EQ(force(before), -2);
}
}  // namespace
