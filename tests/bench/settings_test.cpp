// Settings of runs: which plug-in a parameter belongs to, how many steps fit into the time, and what
// config.toml says.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include <unistd.h>

#include <pfaff/bench/runner/config_file.hpp>

#include "run_settings.hpp"

namespace {

using namespace pfaff;
using pfaff::testing::complaint;

RunSettings pendulum_settings(const std::string& step, const std::string& time) {
  RunSettings s;
  s.system = "damped-pendulum";
  s.integrator = "generating-function";
  s.step = step;
  s.time = time;
  return s;
}

TEST(Settings, AreSplitByWhoKnowsThem) {
  const auto& system = systems().get("damped-pendulum", "system");
  const auto& method = integrators().get("generating-function", "integrator");
  const SplitSettings split = split_settings(
      system, nullptr, &method,
      {{"order", "6"}, {"initial", " 1, -2"}, {"system.nu", "0.7"}, {"integrator.variant", "P"}});
  EXPECT_EQ(split.system, (Assignments{{"nu", "0.7"}}));
  EXPECT_EQ(split.integrator, (Assignments{{"order", "6"}, {"variant", "P"}}));
  EXPECT_EQ(split.initial, (std::vector<std::string>{"1", "-2"}));
  EXPECT_THROW((void)split_settings(system, nullptr, &method, {{"nu", "0.5"}, {"system.nu", "0.7"}}),
               InputError);
  EXPECT_THROW((void)split_settings(system, nullptr, &method, {{"mu", "1"}}), InputError);
  EXPECT_THROW((void)split_settings(system, nullptr, nullptr, {{"order", "6"}}), InputError);
}

// Both sides have a parameter of this name: it must be said whose it is.
struct Spring {
  static constexpr int dimension = 2;
  int order = 2;
  static std::vector<Parameter> parameters() { return {parameter(&Spring::order, "order", "", 1, 9)}; }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0] * q[0] / 2;
  }
};

TEST(Settings, ABareKeyOfBothSidesIsAmbiguous) {
  static const System<Spring> registered{{.name = "spring-with-order",
                                          .title = "a test",
                                          .reference = "su-qin",
                                          .coordinates = {{"q", "m"}, {"p", "m/s"}},
                                          .initial = {1, 0}}};
  RunSettings settings = pendulum_settings("0.1", "1");
  settings.system = "spring-with-order";
  settings.set = {{"order", "4"}};
  const std::string said = complaint(settings);
  for (const char* part : {"'order'", "both", "system.order", "integrator.order"})
    EXPECT_NE(said.find(part), std::string::npos) << said;
  settings.set = {{"system.order", "3"}, {"integrator.order", "6"}};
  const ResolvedRun run = resolve(settings);
  EXPECT_EQ(run.model->parameters()[0].second, "3");
  EXPECT_EQ(run.method->parameters()[0].second, "6");
}

TEST(Settings, ASystemThatDescribesTooLittleIsRefused) {
  static const System<Spring> stateless{{.name = "spring-without-state",
                                         .title = "a test",
                                         .reference = "su-qin",
                                         .coordinates = {{"q", "m"}, {"p", "m/s"}}}};
  static const System<Spring> nameless{
      {.name = "spring-without-names", .title = "a test", .reference = "su-qin", .initial = {1, 0}}};
  RunSettings settings = pendulum_settings("0.1", "1");
  settings.system = "spring-without-names";
  EXPECT_NE(complaint(settings).find("names 0 coordinates; expected 2"), std::string::npos)
      << complaint(settings);
  settings.system = "spring-without-state";
  EXPECT_NE(complaint(settings).find("no initial state"), std::string::npos) << complaint(settings);
  settings.initial = {"1", "0"};
  EXPECT_EQ(complaint(settings), "");
}

TEST(Settings, Steps) {
  const auto steps = [](const std::string& step, const std::string& time) {
    return resolve(pendulum_settings(step, time)).steps;
  };
  EXPECT_EQ(steps("0.1", "1"), 10);  // 1/0.1 in binary is not 10
  EXPECT_EQ(steps("0.1", "0.3"), 3);
  EXPECT_EQ(steps("0.01", "1e6"), 100000000);
  EXPECT_EQ(steps("1/3", "1"), 3);
  EXPECT_EQ(steps("1/3", "1000"), 3000);
  EXPECT_EQ(steps("1e-3", "7/1000"), 7);
  EXPECT_EQ(steps("0.3333333333333333", "1"), 3);
  EXPECT_EQ(steps("1", "1"), 1);
  // A duration that is not a whole number of steps is shortened to one.
  EXPECT_EQ(steps("0.3", "1"), 3);
  EXPECT_EQ(steps("0.4", "1"), 2);
  EXPECT_EQ(steps("0.6", "1"), 1);
}

TEST(Settings, NumbersAreExact) {
  RunSettings settings = pendulum_settings("0.1", "2");
  settings.initial = {"1/3", "0.1"};
  settings.precision = Precision::quad;
  const ResolvedRun run = resolve(settings);
  EXPECT_EQ(run.step.quad() * Quad(10), Quad(1));
  EXPECT_EQ(run.initial[0].quad(), Quad(1) / Quad(3));
  EXPECT_EQ(run.initial[1].quad(), Quad(1) / Quad(10));
}

TEST(Settings, SamplesAreAboutAThousandUnlessAskedFor) {
  EXPECT_EQ(resolve(pendulum_settings("0.1", "10")).every, 1);
  EXPECT_EQ(resolve(pendulum_settings("0.1", "100")).every, 1);
  EXPECT_EQ(resolve(pendulum_settings("0.1", "200")).every, 2);
  EXPECT_EQ(resolve(pendulum_settings("0.01", "10000")).every, 1000);
  RunSettings settings = pendulum_settings("0.1", "200");
  settings.every = 7;
  EXPECT_EQ(resolve(settings).every, 7);
  EXPECT_EQ(parse_every("12", "here"), 12);
  for (const char* bad : {"0", "-3", "1/2", "x", ""})
    EXPECT_THROW((void)parse_every(bad, "here"), InputError) << bad;
}

TEST(Settings, ConfigIsReadBackAsItWas) {
  RunSettings settings = pendulum_settings("1/7", "3.5");
  settings.initial = {"1/3", "-2e-5"};
  settings.t0 = "0.7";
  settings.every = 3;
  settings.precision = Precision::quad;
  settings.set = {{"nu", "1/9"}, {"order", "5"}, {"variant", "P"}};
  const std::string text = config_text(resolve(settings));
  std::string name = ::testing::TempDir() + "pfaff-config-XXXXXX.toml";
  const int file = mkstemps(name.data(), 5);
  ASSERT_GE(file, 0);
  close(file);
  std::ofstream(name) << text;
  const RunSettings again = read_config(name).settings;
  EXPECT_EQ(config_text(resolve(again)), text);
  EXPECT_EQ(again.precision, Precision::quad);
  EXPECT_EQ(again.every, 3);
  EXPECT_EQ(resolve(again).initial[0].quad(), Quad(1) / Quad(3));
  std::remove(name.c_str());
}

TEST(Settings, WhatDoesNotFitIsRefused) {
  RunSettings settings = pendulum_settings("0.1", "1");
  EXPECT_EQ(complaint(settings), "");
  settings.integrator = "verlet";
  EXPECT_NE(complaint(settings).find("verlet needs separable"), std::string::npos);
  settings = pendulum_settings("0.1", "1");
  settings.tolerance = "1e-6";
  EXPECT_NE(complaint(settings).find("exclude each other"), std::string::npos);
  settings.step.clear();
  EXPECT_NE(complaint(settings).find("fixed steps only"), std::string::npos);
}

}  // namespace
