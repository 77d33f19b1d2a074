// At which rows of a run errors are measured.
#include <gtest/gtest.h>

#include <algorithm>

#include <pfaff/bench/runner/record.hpp>
#include <pfaff/core/errors/budget.hpp>
#include <pfaff/core/system.hpp>

#include "kept_samples.hpp"
#include "run_settings.hpp"

namespace {

using namespace pfaff;
using pfaff::testing::settings_of;

struct FallingPendulum {  // without its exact solution
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = -sin(z[0]);
  }
};

RunSettings of_rows(int rows) {
  RunSettings settings = settings_of("pendulum", "0.01", to_string(Real(rows) / Real(100)));
  settings.every = 1;
  settings.structure_residuals = false;
  return settings;
}
pfaff::testing::RecordWithSamples made(RunSettings settings, bool every_row) {
  settings.errors_at_every_row = every_row;
  const ResolvedRun run = resolve(settings);
  return pfaff::testing::execute_and_keep(run, reference_asked_for(run).get());
}
std::vector<std::size_t> rows_with_errors(const pfaff::testing::RecordWithSamples& record) {
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < record.samples.size(); ++k)
    if (record.samples[k].error) rows.push_back(k);
  return rows;
}

// The start and 200 rows, the last one among them, between which no two gaps differ by more than one row. The
// errors there are those that are measured at every row.
TEST(ReferenceRows, AreEvenlySpacedAndEndWithTheLast) {
  for (const int rows : {201, 333, 1000, 1999}) {
    const pfaff::testing::RecordWithSamples some = made(of_rows(rows), false),
                                            all = made(of_rows(rows), true);
    const std::vector<std::size_t> found = rows_with_errors(some);
    ASSERT_EQ(found.size(), 201U) << rows;
    EXPECT_EQ(found.front(), 0U);
    EXPECT_EQ(found.back(), static_cast<std::size_t>(rows));
    std::size_t least = 9999, most = 0;
    double largest = 0;
    for (std::size_t k = 1; k < found.size(); ++k) {
      least = std::min(least, found[k] - found[k - 1]);
      most = std::max(most, found[k] - found[k - 1]);
      EXPECT_EQ(*some.samples[found[k]].error, *all.samples[found[k]].error);
      largest = std::max(largest, static_cast<double>(*all.samples[found[k]].error));
    }
    EXPECT_LE(most - least, 1U) << rows;
    EXPECT_EQ(some.error_max, largest);
    EXPECT_LE(*some.error_max, *all.error_max);
    EXPECT_EQ(some.error_final, all.error_final);
    EXPECT_EQ(rows_with_errors(all).size(), static_cast<std::size_t>(rows) + 1);
    EXPECT_EQ(some.error_rows, 200);
    EXPECT_EQ(some.reached_rows, rows);
  }
}

// The error of the start is zero but for the rounding of the initial state.
TEST(ReferenceRows, TheStart) {
  EXPECT_LE(static_cast<double>(*made(of_rows(1000), false).samples.front().error), 0x1p-52);
}

TEST(ReferenceRows, AreAllWhereTheyAreFew) {
  const pfaff::testing::RecordWithSamples record = made(of_rows(200), false);
  EXPECT_EQ(rows_with_errors(record).size(), 201U);
  const ResolvedRun run = resolve(of_rows(200));
  EXPECT_FALSE(summary(run, record).contains("error_rows"));
}

TEST(ReferenceRows, AreSaidInTheSummary) {
  const ResolvedRun run = resolve(of_rows(1000));
  const pfaff::testing::RecordWithSamples record =
      pfaff::testing::execute_and_keep(run, reference_asked_for(run).get());
  EXPECT_EQ(summary(run, record)["error_rows"], (nlohmann::json{{"measured", 200}, {"of", 1000}}));
  EXPECT_NE(pfaff::testing::series_csv(run, reference_asked_for(run).get()).find(",error [1]"),
            std::string::npos);
}

// Where the solution ends before the run, the last row to which it reaches has an error.
TEST(ReferenceRows, EndWithTheSolution) {
  RunSettings settings = of_rows(1000);
  settings.reference = ErrorsAgainst::solution;
  const ResolvedRun run = resolve(settings);
  std::vector<Quad> initial;
  for (const Real& x : run.initial) initial.push_back(x.quad());
  const auto model = make_model({.name = "falling", .title = "", .reference = "", .initial = run.initial},
                                FallingPendulum{});
  const ReferenceSolution half(model, Quad(0), initial, Quad(5.0119));
  const std::vector<std::size_t> found = rows_with_errors(pfaff::testing::execute_and_keep(run, &half));
  ASSERT_GE(found.size(), 3U);
  EXPECT_EQ(found.back(), 501U);  // at t = 5.01, which is none of every fifth row
  EXPECT_EQ(found[found.size() - 2], 500U);
}

// Where the run ends before its time, its last row has an error: after 503 steps, of which each fifth has
// one.
TEST(ReferenceRows, EndWithTheRun) {
  const ResolvedRun run = resolve(of_rows(1000));
  const auto solution = reference_asked_for(run);
  const Budget budget({.steps = 503});
  const pfaff::testing::RecordWithSamples record = pfaff::testing::execute_and_keep(run, solution.get());
  EXPECT_NE(record.status, Status::converged);
  const std::vector<std::size_t> found = rows_with_errors(record);
  ASSERT_GE(found.size(), 3U);
  EXPECT_EQ(found.back(), record.samples.size() - 1);
  EXPECT_LT(found.size(), record.samples.size() / 2);
}

TEST(ReferenceRows, AreAskedFor) {
  const auto asked = [](const std::string& text) {
    return to_string(parse_reference(text, "--reference", references_of_runs));
  };
  EXPECT_EQ(asked("exact"), "exact");
  EXPECT_EQ(asked("every"), "exact,every");
  EXPECT_EQ(asked("solution,every"), "solution,every");
  EXPECT_EQ(asked("every, solution"), "solution,every");
  EXPECT_EQ(asked("none"), "none");
  const auto refused = [&](const std::string& text) -> std::string {
    try {
      return asked(text);
    } catch (const InputError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(refused("exakt").find("--reference: unknown reference 'exakt'; did you mean 'exact'?"), 0U)
      << refused("exakt");
  EXPECT_EQ(refused("none,every"), "--reference: 'none' measures no errors; expected no 'every' beside it");
  EXPECT_EQ(refused("exact,solution"),
            "--reference: expected one reference, and 'every' once, got 'exact,solution'");
}

}  // namespace
