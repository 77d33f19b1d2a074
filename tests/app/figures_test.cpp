// What is wrong with figures and the index is said before any work begins, and what a run's figures show.
#include "command.hpp"

namespace {

using namespace pfaff::testing;

TEST(Figures, WhatIsWrongIsSaidBeforeTheWork) {
  const TemporaryDirectory files;
  for (const auto& [options, said] :
       {std::pair(std::vector<std::string>{"--figures", "gif"}, "got 'gif'; did you mean 'pgf'?"),
        std::pair(std::vector<std::string>{"--figures", "pdf", "--width", "9"}, "like 85mm, got '9'"),
        std::pair(std::vector<std::string>{"--width", "85mm"}, "--width requires --figures")}) {
    std::vector<std::string> words{"compare", "kepler", "--quick", "--out", files / "out"};
    words.insert(words.end(), options.begin(), options.end());
    expect_complaint(run_pfaff(words), 2, {said}, "compare");
  }
  EXPECT_FALSE(fs::exists(files.path() / "out"));
}

TEST(Figures, AFileThatIsNoIndexIsLeftAlone) {
  const TemporaryDirectory files;
  write(files / "index.html", "<p>mine</p>");
  expect_complaint(run_pfaff({"compare", "--all", "--quick", "--out", files.path()}), 2,
                   {"index.html' is no index of Pfaff's; expected a directory without such a file"},
                   "compare --all");
  EXPECT_EQ(text_of(files / "index.html"), "<p>mine</p>");
  EXPECT_EQ(std::distance(fs::directory_iterator(files.path()), fs::directory_iterator()), 1);
}

TEST(Figures, OfARunSayWhatTheyShow) {
  const TemporaryDirectory files;
  const std::string run = files / "run";
  ASSERT_EQ(
      run_pfaff({"run", "kepler", "verlet", "--step", "0.05", "--time", "5", "--out", run, "--quiet"}).status,
      0);
  expect_complaint(run_pfaff({"plot", run, "--coordinates", "q1,Q2"}), 2,
                   {"kepler has no coordinate 'Q2'; did you mean 'q2'?"}, "plot");
  EXPECT_FALSE(fs::exists(fs::path(run) / "plot"));
  const Outcome plotted =
      run_pfaff({"plot", run, "--coordinates", "q1,p1", "--figures", "pdf", "--width", "60mm", "--json"});
  ASSERT_EQ(plotted.status, 0) << plotted.err;
  const auto j = json_of(plotted.out);
  EXPECT_TRUE(j["sentence"].get<std::string>().starts_with(
      "kepler, verlet: 100 steps to t = 5; energy moves from the start by at most "))
      << j["sentence"];
  EXPECT_TRUE(fs::exists(fs::path(j["figures"].get<std::string>()) / "motion.pdf"));
  EXPECT_NE(text_of(j["page"].get<std::string>()).find("p1 against q1"), std::string::npos);
  // Half of a series is not what the summary speaks of.
  const std::string series = text_of(fs::path(run) / "series.csv");
  write(fs::path(run) / "series.csv", series.substr(0, series.rfind('\n', series.size() / 2) + 1));
  expect_complaint(run_pfaff({"plot", run}), 2, {"holds files that are not as a run has left them"}, "plot");
}

}  // namespace
