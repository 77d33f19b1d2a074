// Plug-ins on trial: what hangs, multiplies, throws or ends the process while it is loaded is found in a
// process of its own, of which nothing is left.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/registry/trial_load.hpp>

#include "../built.hpp"
#include "../processes.hpp"
#include "../temporary_directory.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

class TrialLoad : public ::testing::Test {
 protected:
  TrialLoad() { setenv("PFAFF_WITNESS", witness().c_str(), 1); }
  ~TrialLoad() override { unsetenv("PFAFF_WITNESS"); }
  [[nodiscard]] std::string witness() const { return files_ / "witness"; }

 private:
  TemporaryDirectory files_;
};

TEST_F(TrialLoad, WhatLoadsIsAccepted) {
  EXPECT_EQ(trial_load(test_plugin("fits")), "");
  EXPECT_TRUE(fs::exists(witness())) << "it was not loaded";
}

TEST_F(TrialLoad, WhatThrowsOrEndsTheProcess) {
  EXPECT_EQ(trial_load(test_plugin("throws-error")), "throws while it is loaded: not today");
  EXPECT_NE(trial_load(test_plugin("throws-odd")).find("Odd"), std::string::npos);
  EXPECT_EQ(trial_load(test_plugin("ends-by-itself")),
            "ends the program while it is loaded, with exit status 0");
  EXPECT_EQ(trial_load(test_plugin("ends-by-signal")), "ends the program while it is loaded: Terminated");
  EXPECT_NE(trial_load("/nowhere/missing.so").find("cannot open"), std::string::npos);
}

TEST_F(TrialLoad, WhatHangsIsEndedInTime) {
  EXPECT_EQ(trial_load(test_plugin("hang"), std::chrono::milliseconds(500)),
            "does not end to be loaded within 500 ms");
  EXPECT_TRUE(gone(process_in(witness())));
}

TEST_F(TrialLoad, WhatMultipliesIsRefusedAndNothingOfItIsLeft) {
  EXPECT_EQ(trial_load(test_plugin("come-back-twice")), "leaves another process behind while it is loaded");
  EXPECT_EQ(trial_load(test_plugin("leave-a-process")), "leaves another process behind while it is loaded");
  // The process that was left may not have come to its witness.
  if (fs::exists(witness())) {
    EXPECT_TRUE(gone(process_in(witness())));
  }
}

}  // namespace
