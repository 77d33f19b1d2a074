// Experiments of the kind `derivation`: the fit, what is read, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/derive/derivation_growth/derived_sizes.hpp>

#include "../temporary_directory.hpp"

namespace {

using namespace pfaff;
using namespace pfaff::testing;
using ::testing::HasSubstr;

TEST(FittedSlope, IsExactOnALine) {
  const FittedSlope fit = fitted_slope({1, 2, 4, 7}, {5, 3, -1, -7});
  EXPECT_EQ(fit.points, 4U);
  EXPECT_NEAR(fit.slope, -2, 1e-14);
  EXPECT_NEAR(fit.high - fit.low, 0, 1e-13);
}

// y = 0, 1, 0 at x = -1, 0, 1: slope 0, residuals of squares 2/3, one degree of freedom, so that half of the
// interval is tan(0.475 pi) sqrt((2/3)/2), by Cauchy's distribution.
TEST(FittedSlope, HasStudentsInterval) {
  const FittedSlope fit = fitted_slope({-1, 0, 1}, {0, 1, 0});
  EXPECT_NEAR(fit.slope, 0, 1e-15);
  EXPECT_NEAR(fit.high, std::tan(0.475 * std::numbers::pi) / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(fit.low, -fit.high, 1e-12);
  EXPECT_EQ(fitted_slope({1, 2}, {1, 2}).points, 0U);
  EXPECT_EQ(fitted_slope({1, 1, 1}, {1, 2, 3}).points, 0U);
}

class Studies : public ::testing::Test {
 protected:
  std::string message_of(const std::string& text) {
    write_file(directory_ / "study.toml",
               "schema = 1\nkind = \"derivation\"\ntitle = \"A test\"\n"
               "reference = [\"nguyen-turski\"]\nsystem = \"n-pendulum\"\n"
               "parameter = \"bobs\"\n" +
                   text);
    try {
      const Experiment experiment = read_experiment(directory_ / "study.toml", true);
      (void)run_experiment(experiment, directory_.path() / "out", nullptr);
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing thrown";
  }

 private:
  TemporaryDirectory directory_;
};

TEST_F(Studies, RefuseWhatIsWrongBeforeAnythingIsDerived) {
  const std::string good = "[[derive]]\nmethod = \"ldl\"\nsizes = [1, 2]\n";
  EXPECT_THAT(message_of("[[derive]]\nmethod = \"ldll\"\nsizes = [1]\n"), HasSubstr("did you mean 'ldl'"));
  EXPECT_THAT(message_of("[[derive]]\nmethod = \"ldl\"\n"), HasSubstr("key 'sizes' is missing"));
  EXPECT_THAT(message_of("[[derive]]\nmethod = \"ldl\"\nsizes = [0]\n"), HasSubstr("bobs"));
  EXPECT_THAT(message_of("[[derive]]\nmethod = \"birkhoffian\"\nsizes = [2]\n"),
              HasSubstr("needs a structure"));
  EXPECT_THAT(message_of("second = 1\n" + good), HasSubstr("did you mean 'seconds'"));
  EXPECT_THAT(message_of("seconds = 0\n" + good), HasSubstr("expected a number > 0"));
  EXPECT_THAT(message_of(good + "[[published]]\nlabel = \"x\"\nfactor = 1\n"),
              HasSubstr("key 'rate' is missing"));
}

TEST(Experiment, OfAnUnknownKindIsRefused) {
  const TemporaryDirectory directory;
  write_file(directory / "study.toml",
             "schema = 1\nkind = \"derivations\"\ntitle = \"A test\"\nreference = []\n");
  try {
    (void)read_experiment(directory / "study.toml", false);
    FAIL() << "it was read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean 'derivation'"));
  }
}

TEST(Experiment, DeriveReadsWithFewerSizesInQuickMode) {
  const Experiment whole = read_experiment("derive", false), quick = read_experiment("derive", true);
  ASSERT_TRUE(whole.derivation && quick.derivation);
  EXPECT_EQ(whole.derivation->sweeps.front().sizes.back(), "1025");
  EXPECT_LT(quick.derivation->size(), whole.derivation->size() / 2);
  EXPECT_EQ(whole.derivation->published.size(), 2U);
  EXPECT_EQ(whole.derivation->published.front().rate, 0.49);
}

}  // namespace
