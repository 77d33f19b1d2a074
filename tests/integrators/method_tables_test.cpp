// Methods that are read from tables of coefficients: what is checked, what is computed, and that their steps
// are those of the same methods written in C++.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>

#include <pfaff/core/system.hpp>

#include "method_files.hpp"
#include "methods.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::expect_table_refused;
using pfaff::testing::Relativistic;
using pfaff::testing::shipped_tables;
using pfaff::testing::table_refusal;
using pfaff::testing::TemporaryDirectory;

std::string verlet_with(const std::string& drift, const std::string& more = "order = 2") {
  return "name = \"table\"\nkind = \"splitting\"\n" + more + "\ndrift = [" + drift + "]\nkick = [1]\n";
}

std::vector<std::string> names_of(const std::vector<Claim>& claims) {
  std::vector<std::string> names;
  for (const Claim claim : claims) names.emplace_back(to_string(claim));
  return names;
}
using Names = std::vector<std::string>;

// The largest difference of two methods after twenty steps, relative to the size of the state.
template <class T>
double run_difference(const MethodInstance& a, const MethodInstance& b, const std::string& system) {
  const std::shared_ptr<const Model> model = systems().get(system, "system").make({});
  const T h = T(Real::fraction(1, 20));
  const auto za = pfaff::testing::after_steps(a, model, h, 20),
             zb = pfaff::testing::after_steps(b, model, h, 20);
  double largest = 0, size = 0;
  for (std::size_t k = 0; k < za.size(); ++k) {
    largest = std::max(largest, static_cast<double>(abs(za[k] - zb[k])));
    size = std::max(size, static_cast<double>(abs(za[k])));
  }
  return largest / size;
}

// The same method, up to the rounding of twenty steps of some flows each.
void expect_same_steps(const MethodInstance& a, const MethodInstance& b, const std::string& system) {
  EXPECT_LT(run_difference<double>(a, b, system), 1e-14);
  EXPECT_LT(run_difference<Quad>(a, b, system), 1e-32);
}

TEST(MethodTables, EveryOneThatIsShippedIsRead) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(shipped_tables)) {
    if (entry.path().extension() != ".toml") continue;
    const auto table = read_method_table(entry.path().string());
    EXPECT_EQ(table->name(), entry.path().stem().string());
    EXPECT_FALSE(table->descriptor().reference.empty()) << table->name();
    if (!table->theory().kind.empty()) {  // which maps have none of
      EXPECT_EQ(table->theory().order, table->descriptor().order);
    }
    EXPECT_FALSE(table->descriptor().double_coefficients) << table->name();
    ++count;
  }
  EXPECT_GE(count, 18);
}

TEST(MethodTables, WhatTheyKeepIsComputed) {
  const auto kept = [](const std::string& name) {
    return names_of(read_method_table(shipped_tables + name + ".toml")->descriptor().preserves);
  };
  EXPECT_EQ(kept("dormand-prince"), Names{"none"});
  EXPECT_EQ(kept("radau-iia-5"), Names{"none"});
  EXPECT_EQ(kept("adams-bashforth-4"), Names{"none"});
  EXPECT_EQ(kept("symplectic-dirk-4"),
            (Names{"symplectic", "symmetric", "reversible", "quadratic-invariants"}));
  EXPECT_EQ(kept("pefrl"), (Names{"symplectic", "symmetric", "reversible"}));
  EXPECT_EQ(kept("mclachlan-atela-4"), Names{"symplectic"});
}

TEST(MethodTables, StepLikeTheSameMethodInCpp) {
  const auto made = [](const std::string& name) {
    return read_method_table(shipped_tables + name + ".toml");
  };
  const auto registered = [](const std::string& name, const Assignments& set) {
    return integrators().get(name, "integrator").make(set);
  };
  const auto forest_ruth = made("forest-ruth"), suzuki = made("suzuki-4-verlet"),
             euler = made("verlet-as-processed-euler");
  for (const char* system : {"pendulum", "henon-heiles"}) {
    expect_same_steps(*forest_ruth->make({}), *registered("yoshida-verlet", {{"order", "4"}}), system);
    expect_same_steps(*suzuki->make({}), *registered("suzuki-verlet", {{"order", "4"}}), system);
    expect_same_steps(*euler->make({}), *registered("verlet", {}), system);
    EXPECT_GT(run_difference<double>(*forest_ruth->make({}), *registered("suzuki-verlet", {{"order", "4"}}),
                                     system),
              1e-12);
  }
}

TEST(MethodTables, RungeKuttaTablesStepLikeTheSameMethodInCpp) {
  const TemporaryDirectory files;
  std::ofstream(files / "rk.toml") << "name = \"table\"\nkind = \"runge-kutta\"\norder = 4\n"
                                      "a = [[], [\"1/2\"], [0, 0.5], [0, 0, 1]]\n"
                                      "b = [\"1/6\", \"1/3\", \"1/3\", \"1/6\"]\n";
  std::ofstream(files / "gauss.toml") << "name = \"table\"\nkind = \"runge-kutta\"\norder = 4\n"
                                         "let = { s = \"sqrt(3)/6\" }\nc = [\"1/2 - s\", \"1/2 + s\"]\n"
                                         "a = [[\"1/4\", \"1/4 - s\"], [\"1/4 + s\", \"1/4\"]]\n"
                                         "b = [\"1/2\", 0.5]\n";
  const auto explicit_one = read_method_table(files / "rk.toml"),
             gauss = read_method_table(files / "gauss.toml");
  for (const char* system : {"pendulum", "damped-pendulum"}) {
    expect_same_steps(*explicit_one->make({}), *integrators().get("rk4", "").make({}), system);
    expect_same_steps(*gauss->make({}), *integrators().get("gauss", "").make({{"stages", "2"}}), system);
  }
}

TEST(MethodTables, AWrongCoefficientIsRefusedWithItsConditionAndResidual) {
  EXPECT_EQ(table_refusal(verlet_with("0.5, \"1/2\"")), "accepted: table");
  expect_table_refused(
      verlet_with("0.5, 0.500000001"),
      {":3:9: key 'order': 2, but the Lie word drift = 1, a condition of order 1, is off by 1.00e-09",
       "expected at most"});
  expect_table_refused(verlet_with("0.5, 0.500000000000000000001"),
                       {"is off by 1.00e-21", "numbers of 36 digits", "precision = \"double\""});
  expect_table_refused(verlet_with("0.4, 0.6"), {"the Lie word drift kick = 0, a condition of order 2"});
  expect_table_refused(verlet_with("0.5, 0.5", "order = 4"), {"a condition of order 3"});
  expect_table_refused(verlet_with("0.5, 0.5", "order = 1"),
                       {"all conditions of order 2 hold; expected that order"});
  expect_table_refused(
      "name = \"table\"\nkind = \"runge-kutta\"\norder = 4\na = [[], [0.5], [0, 0.5], [0, 0, 1]]\n"
      "b = [\"1/6\", \"1/3\", \"1/3\", \"1/6 + 1e-9\"]\n",
      {"the tree t, Phi = 1/1, a condition of order 1, is off by 1.00e-09"});
  expect_table_refused(
      "name = \"table\"\nkind = \"multistep\"\norder = 2\nrho = [-1, 0, 1]\nsigma = [0, 2.001, 0]\n",
      {"the sum of j rho_j - sigma_j = 0"});
  expect_table_refused(
      "name = \"table\"\nkind = \"composition\"\nbase = \"verlet\"\norder = 4\nweights = [0.3, 0.4, "
      "0.3]\n",
      {"the Lie word Y3 = 0, a condition of order 3"});
}

TEST(MethodTables, DoublesAreTakenWhereTheyAreMarked) {
  const std::string yoshida =
      "name = \"table\"\nkind = \"composition\"\nbase = \"verlet\"\norder = 4\n"
      "weights = [1.3512071919596578, -1.7024143839193153, 1.3512071919596578]\n";
  expect_table_refused(yoshida, {"precision = \"double\""});
  const TemporaryDirectory files;
  std::ofstream(files / "table.toml") << yoshida + "precision = \"double\"\n";
  EXPECT_TRUE(read_method_table(files / "table.toml")->descriptor().double_coefficients);
}

TEST(MethodTables, AClaimThatTheNumbersDoNotBearOutIsRefused) {
  expect_table_refused(
      "name = \"table\"\nkind = \"runge-kutta\"\norder = 2\na = [[], [0.5]]\nb = [0, 1]\n"
      "preserves = [\"symplectic\"]\n",
      {"key 'preserves': 'symplectic' does not follow", "b2 a2,2 + b2 a2,2 = b2 b2"});
  expect_table_refused(verlet_with("0.5, 0.5", "order = 2\npreserves = [\"energy\"]"),
                       {"splittings are not tested"});
  expect_table_refused(verlet_with("0.5, 0.5", "order = 2\npreserves = [\"symplectc\"]"), {"symplectic"});
  expect_table_refused(
      "name = \"table\"\nkind = \"multistep\"\norder = 2\nrho = [-1, 0, 1]\nsigma = [0, 2, 0]\n"
      "preserves = [\"symmetric\"]\n",
      {"a map of several states"});
}

TEST(MethodTables, AnUnstableMultistepMethodIsRefused) {
  expect_table_refused(
      "name = \"table\"\nkind = \"multistep\"\norder = 3\nrho = [-5, 4, 1]\nsigma = [2, 4, 0]\n",
      {"not zero-stable", "of modulus 5"});
}

TEST(MethodTables, AKernelIsToldFromItsProcessor) {
  const std::string head = "name = \"table\"\nkind = \"processed\"\norder = 2\n";
  expect_table_refused(
      head + "pre = { drift = [\"-1/4\"], kick = [0] }\nkernel = { drift = [1], kick = [1] }\n",
      {"key 'order': 2, but the Lie word drift kick = 0"});
  expect_table_refused(
      "name = \"table\"\nkind = \"processed\"\norder = 3\npre = { drift = [\"-1/2\"], kick = [0] }\n"
      "kernel = { drift = [1], kick = [1] }\n",
      {"key 'kernel': is not of effective order 3: whatever the processor"});
}

TEST(MethodTables, BadFilesAreRefusedInOneLine) {
  expect_table_refused("name = ", {":1:"});
  expect_table_refused("kind = \"splitting\"\norder = 2\n", {"key 'name': is missing"});
  expect_table_refused("name = \"Table\"\nkind = \"splitting\"\norder = 2\n", {"kebab-case", "'Table'"});
  expect_table_refused("name = \"table\"\nkind = \"spliting\"\norder = 2\n", {"did you mean 'splitting'?"});
  expect_table_refused("name = \"table\"\nkind = \"splitting\"\norder = 0\n",
                       {"expected a whole number > 0"});
  expect_table_refused(verlet_with("0.5, 0.5", "order = 13"), {"expected at most 12"});
  expect_table_refused(verlet_with("0.5, 0.5", "order = 2\nkik = 1"),
                       {"unknown key 'kik'", "did you mean 'kick'?"});
  expect_table_refused(verlet_with("0.5, \"g\""), {":4:16: ", "'g'"});
  expect_table_refused(verlet_with("0.5, true"), {"key 'drift': expected a list of numbers"});
  expect_table_refused(verlet_with("0.5, \"1/0\""), {":4:"});
  expect_table_refused(verlet_with("0.2, 0.3, 0.5"), {"key 'kick': expected 3 numbers or one less", "got 1"});
  expect_table_refused("name = \"table\"\nkind = \"runge-kutta\"\norder = 1\na = [[], []]\nb = [1]\n",
                       {"key 'a': expected 1 rows"});
  expect_table_refused(
      "name = \"table\"\nkind = \"runge-kutta\"\norder = 2\nc = [0, 0.6]\na = [[], [0.5]]\nb = [0, 1]\n",
      {"key 'c': the sum of row 2 of a less c2 is off by -1.00e-01"});
  expect_table_refused(
      "name = \"table\"\nkind = \"runge-kutta\"\norder = 1\na = [[0.5, 0.5], [0.5, 0.5]]\nb = [0.5, 0.5]\n",
      {"have the same sum"});
  expect_table_refused("name = \"table\"\nkind = \"composition\"\nbase = \"rk4\"\norder = 2\nweights = [1]\n",
                       {"rk4 cannot be composed: it is not symmetric; expected one of: ", ", verlet"});
  expect_table_refused(
      "name = \"table\"\nkind = \"composition\"\nbase = \"a\\nb\"\norder = 2\nweights = [1]\n",
      {"key 'base': expected NAME or NAME(key=value, key=value), got 'a b'"});
  EXPECT_THROW((void)read_method_table("no-such-file.toml"), InputError);
}

// Shipped tables with characters, lines and numbers changed at random: accepted, or refused in one line.
TEST(MethodTables, DamagedFilesAreRefusedOrRead) {
  const std::vector<std::string> odd{"1e99999",      "\"1/0\"", "nan",       "[]",        "{}",   "-7",
                                     "\"sqrt(-1)\"", "\"g\"",   "0",         "99",        "\"\"", "true",
                                     "\"((\"",       "]",       "\"a\\nb\"", "\"1e4000\""};
  std::vector<std::string> texts;
  for (const auto& entry : std::filesystem::directory_iterator(shipped_tables)) {
    std::ifstream file(entry.path());
    texts.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  std::sort(texts.begin(), texts.end());
  std::mt19937 choices(1);
  const auto below = [&](std::size_t n) { return choices() % n; };
  int refused = 0;
  for (int k = 0; k < 600; ++k) {
    std::string text = texts[below(texts.size())];
    for (std::size_t changes = 1 + below(2); changes > 0; --changes) {
      std::size_t at = text.find_first_of("0123456789\"", below(text.size()));
      if (at == std::string::npos) at = 0;
      const std::size_t end = text.find_first_of(",]} \n", at);
      if (below(4) == 0) {
        text.erase(at, below(40));
      } else {
        text.replace(at, std::min(end, text.size()) - at, odd[below(odd.size())]);
      }
    }
    const std::string message = table_refusal(text);
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    refused += message.starts_with("accepted") ? 0 : 1;
  }
  EXPECT_GT(refused, 300);  // the others were changed in comments and descriptions
}

TEST(MethodTables, ThoseOfNystroemRefuseOtherKineticEnergies) {
  const SystemDescriptor descriptor{.name = "oscillator",
                                    .title = "a test",
                                    .reference = "none",
                                    .coordinates = {{"q", "m"}, {"p", "m/s"}},
                                    .initial = {1, 1}};
  const auto table = read_method_table(shipped_tables + "blanes-moan-srkn6.toml");
  const auto nystroem = table->make({});
  Relativistic system;
  EXPECT_NE(nystroem->refuses(*make_model(descriptor, system)).find("quadratic in the momenta only"),
            std::string::npos);
  const auto general = read_method_table(shipped_tables + "blanes-moan-s6.toml");
  EXPECT_EQ(general->make({})->refuses(*make_model(descriptor, system)), "");
  system.slow = true;
  EXPECT_EQ(nystroem->refuses(*make_model(descriptor, system)), "");
}

TEST(MethodTables, AreRegisteredUnderTheirNamesWhenTheyAreNamed) {
  const MethodPlugin& table = integrator_named(shipped_tables + "ruth-3.toml");
  EXPECT_EQ(table.name(), "ruth-3");
  EXPECT_EQ(&integrator_named(shipped_tables + "ruth-3.toml"), &table);
  EXPECT_EQ(integrators().find("ruth-3"), &table);
  EXPECT_TRUE(order_theory("ruth-3", {}).has_value());
  EXPECT_TRUE(names_method_table(shipped_tables + "ruth-3.toml"));
  EXPECT_FALSE(names_method_table("verlet"));
  const TemporaryDirectory files;
  std::ofstream(files / "verlet.toml") << "name = \"verlet\"\nkind = \"splitting\"\norder = 2\n"
                                          "drift = [0.5, 0.5]\nkick = [1]\n";
  try {
    (void)integrator_named(files / "verlet.toml");
    ADD_FAILURE() << "a name that is taken was taken again";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("'verlet' is registered in"), std::string::npos) << error.what();
  }
  const std::string own =
      "name = \"own-verlet\"\nkind = \"splitting\"\norder = 2\ndrift = [0.5, 0.5]\nkick = [1]\n";
  std::ofstream(files / "own.toml") << own;
  const MethodPlugin& before = integrator_named(files / "own.toml");
  std::ofstream(files / "own.toml") << "# other bytes\n" << own;
  try {
    (void)integrator_named(files / "own.toml");
    ADD_FAILURE() << "a file that has changed was taken for the one before";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("own.toml: changed since it was read as 'own-verlet'; expected"),
              std::string::npos)
        << error.what();
  }
  std::ofstream(files / "own.toml") << own;
  EXPECT_EQ(&integrator_named(files / "own.toml"), &before);
  std::ofstream(files / "model.toml") << "name = \"model\"\nfield = [\"z1\"]\n";
  EXPECT_FALSE(names_method_table(files / "model.toml"));
}

}  // namespace
