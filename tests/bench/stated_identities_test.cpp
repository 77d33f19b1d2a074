// What a run looks at before it begins: formulas that contradict each other are refused where a run would
// follow one of them, and sound ones are not, whatever their size.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <pfaff/bench/runner/stated_identities.hpp>
#include <pfaff/systems/text/text_system.hpp>

#include "../temporary_directory.hpp"
#include "../verify/judged.hpp"
#include "run_settings.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::complaint;
using pfaff::testing::settings_of;

// Why a run of a text model is refused; empty where it is not.
std::string complaint_about(const std::string& text) {
  const pfaff::testing::TemporaryDirectory files;
  std::ofstream(files / "system.toml") << text;
  return complaint(settings_of(files / "system.toml", "0.1", "1"));
}

const std::string oscillator =
    "coordinates = [\"q\", \"p\"]\ninitial = [0.5, 0.1]\nkinetic = \"p^2/2\"\n"
    "potential = \"3.1415926*q^2/2 + q^4/4\"\n";

TEST(StatedIdentities, AForceThatIsNotThePotentialsIsRefused) {
  EXPECT_EQ(complaint_about(oscillator), "");
  EXPECT_EQ(complaint_about(oscillator + "force = [\"-3.1415926*q - q^3\"]\n"), "");
  // Constants are written to as many digits as somebody has.
  EXPECT_EQ(complaint_about(oscillator + "force = [\"-3.1415927*q - q^3\"]\n"), "");
  const std::string said = complaint_about(oscillator + "force = [\"-3.1415926*q - q^2\"]\n");
  EXPECT_NE(said.find("false at the initial state: written force is the derived one (off by "),
            std::string::npos)
      << said;
}

TEST(StatedIdentities, AFaultThatTheInitialStateHidesIsSeenBesideIt) {
  const std::string said = complaint_about(
      "coordinates = [\"q\", \"p\"]\ninitial = [0, 0.1]\nkinetic = \"p^2/2\"\npotential = \"q^2/2\"\n"
      "force = [\"q\"]\n");
  EXPECT_NE(said.find("false at a state near the initial one: written force is"), std::string::npos) << said;
}

// Where it starts sin is 1 and its derivative round-off: beside round-off nothing is large.
TEST(StatedIdentities, RoundOffIsNoContradiction) {
  EXPECT_EQ(complaint_about("coordinates = [\"q\", \"p\"]\ninitial = [1.5707963267948966, 0.1]\n"
                            "kinetic = \"p^2/2\"\npotential = \"sin(q)\"\n"
                            "force = [\"-sin(q + 1.57079632679489661923132169163975144)\"]\n"),
            "");
}

struct Form {
  static constexpr int dimension = 2;
  Real k12 = 1, k21 = -1;
  template <class T>
  void structure(const T& /*t*/, In<T> z, Out<T> k) const {
    k[0] = k[3] = T(0);
    k[1] = k12 * z[0];
    k[2] = k21 * z[0];
  }
  template <class T>
  void covector(const T& /*t*/, In<T> z, Out<T> d) const {
    d[0] = -z[0];
    d[1] = -z[1];
  }
};

std::string complaint_about(const Form& form, const std::vector<Real>& z) {
  try {
    const SystemDescriptor descriptor{.name = "form", .title = "", .reference = "", .initial = {1, 1}};
    check_stated_identities(make_model(descriptor, form, {}), Real(0), z);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(StatedIdentities, KIsSkewAndRegular) {
  EXPECT_EQ(complaint_about(Form(), {1, 1}), "");
  // In whatever unit.
  EXPECT_EQ(complaint_about(Form{1e-30_r, -1e-30_r}, {1, 1}), "");
  EXPECT_NE(complaint_about(Form{1, 1}, {1, 1}).find("false at the initial state: K is skew"),
            std::string::npos);
  EXPECT_EQ(complaint_about(Form(), {0, 1}),
            "system form: K is singular at the initial state; expected a regular matrix");
}

// What a run of a text model says of its invariants.
std::string said_of_invariants(const std::string& text) {
  const pfaff::testing::TemporaryDirectory files;
  std::ofstream(files / "system.toml") << text;
  return resolve(settings_of(files / "system.toml", "0.1", "1")).not_conserved;
}

TEST(StatedIdentities, WhatIsSaidToBeConservedIs) {
  EXPECT_EQ(said_of_invariants(oscillator + "[invariants]\nsum = \"p^2/2 + 3.1415926*q^2/2 + q^4/4\"\n"), "");
  EXPECT_EQ(
      said_of_invariants(oscillator + "[invariants]\nproduct = { of = \"q*p\", behaviour = \"free\" }\n"),
      "");
  const std::string said = said_of_invariants(oscillator + "[invariants]\nproduct = \"q*p\"\n");
  EXPECT_NE(said.find("product is said to be conserved, but the motion changes it (its rate is "),
            std::string::npos)
      << said;
  // At rest nothing moves, but beside it.
  EXPECT_NE(said_of_invariants("coordinates = [\"q\", \"p\"]\ninitial = [0, 0]\nkinetic = \"p^2/2\"\n"
                               "potential = \"q^2/2\"\n[invariants]\nposition = \"q\"\n"),
            "");
  // With damping the energy falls, which a model may say of it.
  EXPECT_EQ(said_of_invariants("coordinates = [\"q\", \"p\"]\ninitial = [1, 0]\nkinetic = \"p^2/2\"\n"
                               "potential = \"q^2/2\"\ndamping = \"0.1\"\n[invariants]\n"
                               "sum = { of = \"p^2/2 + q^2/2\", behaviour = \"decreasing\" }\n"),
            "");
}

// Of nothing that is registered or that ships as a text model is anything false where it begins.
TEST(StatedIdentities, OfEverySystemHold) {
  for (const SystemPlugin* plugin : systems().all()) {
    const auto model = plugin->make({});
    if (model->initial().empty() || plugin->name().starts_with("tiny-")) continue;
    EXPECT_NO_THROW(check_stated_identities(model, Real(0), model->initial())) << plugin->name();
    if (plugin->name().starts_with("test-")) continue;
    EXPECT_EQ(not_conserved(model, Real(0), model->initial()), "") << plugin->name();
  }
  for (const auto& file : std::filesystem::directory_iterator(PFAFF_GOLDEN "/../../examples/models")) {
    std::ifstream stream(file.path());
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (text.find("\ntensor = ") != std::string::npos) continue;  // a bracket, and no system
    const auto model = system_named(file.path().string()).make({});
    if (model->initial().empty()) continue;
    EXPECT_NO_THROW(check_stated_identities(model, Real(0), model->initial())) << file.path();
    EXPECT_EQ(not_conserved(model, Real(0), model->initial()), "") << file.path();
  }
}

}  // namespace
