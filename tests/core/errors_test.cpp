// Texts of errors about unknown names: they offer the nearest name, or list what there is to choose from.
#include <gtest/gtest.h>

#include <algorithm>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/registry/registry.hpp>
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

const std::vector<std::string> system_names{"damped-oscillator", "damped-pendulum", "henon-heiles", "kepler",
                                            "pendulum"};

TEST(Errors, NearestFindsSlipsOfTheKeyboard) {
  EXPECT_EQ(nearest("damped-oscilator", system_names), "damped-oscillator");
  EXPECT_EQ(nearest("keppler", system_names), "kepler");
  EXPECT_EQ(nearest("kelper", system_names), "kepler");
  EXPECT_EQ(nearest("damped_pendulum", system_names), "damped-pendulum");
  EXPECT_EQ(nearest("pendulum", system_names), "pendulum");
  EXPECT_EQ(nearest("hen", system_names), "henon-heiles");  // typed short
  EXPECT_EQ(nearest("hennon-heiles", system_names), "henon-heiles");
}

TEST(Errors, NearestIsEmptyWhenNothingIsNear) {
  EXPECT_EQ(nearest("rigid-body-in-a-box", system_names), "");
  EXPECT_EQ(nearest("zzzzzz", system_names), "");
  EXPECT_EQ(nearest("kepler", {}), "");
}

TEST(Errors, UnknownNameSuggestsOrLists) {
  EXPECT_EQ(unknown_name("system", "damped-oscilator", system_names),
            "unknown system 'damped-oscilator'; did you mean 'damped-oscillator'?");
  EXPECT_EQ(unknown_name("system", "zzzzzzzz", {"kepler", "pendulum"}),
            "unknown system 'zzzzzzzz'; expected one of: kepler, pendulum");
  EXPECT_EQ(unknown_name("parameter", "mass", {}), "unknown parameter 'mass'; there is none to choose from");
}

TEST(Errors, AreOneLineAlsoWhereTheyQuoteSeveral) {
  EXPECT_STREQ(InputError(unknown_name("system", "kep\nler", system_names)).what(),
               "unknown system 'kep ler'; did you mean 'kepler'?");
  EXPECT_STREQ(RunError("cannot write 'a\r\nb'").what(), "cannot write 'a  b'");
}

TEST(Errors, RegistriesNameTheNearestPlugin) {
  EXPECT_EQ(systems().get("kepler", "system").name(), "kepler");
  EXPECT_EQ(systems().find("keppler"), nullptr);
  try {
    (void)systems().get("keppler", "system");
    FAIL() << "an unknown name was accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "unknown system 'keppler'; did you mean 'kepler'?");
  }
  const auto all = systems().names();
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end()));
}

}  // namespace
