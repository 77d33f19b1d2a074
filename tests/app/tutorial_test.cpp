// The tutorial is true: every command in it is run, one after another in one directory, and what it prints
// has the shape of what stands on the page: the same lines, numbers and blanks apart.
#include <cstdio>
#include <regex>

#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Lines = std::vector<std::string>;

struct TutorialStep {
  std::string command;
  Lines shown;
};

// The commands of the blocks ```console of a page: lines behind "$ ", with what follows up to END where one
// asks for it. What stands below a command is what it prints.
std::vector<TutorialStep> steps_of(const std::string& page) {
  std::vector<TutorialStep> steps;
  std::istringstream lines(page);
  bool inside = false, here_document = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      inside = line == "```console";
    } else if (here_document) {
      steps.back().command += line + '\n';
      here_document = line != "END";
    } else if (inside && line.starts_with("$ ")) {
      steps.push_back({line.substr(2) + '\n', {}});
      here_document = line.ends_with("<<'END'");
    } else if (inside) {
      steps.back().shown.push_back(line);
    }
  }
  return steps;
}

// A line with every number as #, and every run of blanks as one.
std::string shape_of(const std::string& line) {
  static const std::regex number(R"([-+]?\b\d+(\.\d+)?(e[-+]?\d+)?)"), blanks(" +");
  return std::regex_replace(std::regex_replace(line, number, "#"), blanks, " ");
}

// True where the lines are those shown, from these two on; "..." stands for any lines.
bool agree(const Lines& shown, const Lines& printed, std::size_t s = 0, std::size_t p = 0) {
  if (s == shown.size()) return p == printed.size();
  if (shown[s] == "...") {
    for (std::size_t next = p; next <= printed.size(); ++next)
      if (agree(shown, printed, s + 1, next)) return true;
    return false;
  }
  return p < printed.size() && shape_of(shown[s]) == shape_of(printed[p]) &&
         agree(shown, printed, s + 1, p + 1);
}

Lines printed_by(const std::string& command, const fs::path& directory) {
  write(directory / "step.bash",
        "cd '" + directory.string() + "' || exit\npfaff() { '" + PFAFF_PROGRAM + "' \"$@\"; }\n" + command);
  FILE* pipe = popen(("bash '" + (directory / "step.bash").string() + "' 2>&1").c_str(), "r");
  EXPECT_NE(pipe, nullptr);
  std::string text;
  for (int c = fgetc(pipe); c != EOF; c = fgetc(pipe)) text += static_cast<char>(c);
  pclose(pipe);
  Lines lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(Tutorial, EveryCommandPrintsWhatThePageShows) {
  unsetenv("COLUMNS");
  const auto steps = steps_of(text_of(fs::path(PFAFF_GOLDEN) / "../../docs/tutorial.md"));
  ASSERT_GT(steps.size(), 15U);
  const TemporaryDirectory directory;
  std::size_t lines = 0;
  for (const TutorialStep& step : steps) {
    const Lines printed = printed_by(step.command, directory.path());
    std::string all;
    for (const std::string& line : printed) all += "  " + line + '\n';
    EXPECT_TRUE(agree(step.shown, printed)) << step.command << "prints\n" << all;
    lines += printed.size();
  }
  EXPECT_GT(lines, 100U);
}

TEST(Tutorial, WhatIsNotPrintedIsSeen) {  // the control of the test above
  const Lines printed{"energy  drift max 6.4e-05, bounded", "", "written  to"};
  EXPECT_TRUE(agree({"energy drift max 1e-3, bounded", "", "written  to"}, printed));
  EXPECT_TRUE(agree({"...", "written to"}, printed));
  EXPECT_FALSE(agree({"energy drift max 1e-3, linear", "", "written to"}, printed));
  EXPECT_FALSE(agree({"energy drift max 1e-3, bounded", "written to"}, printed));
  EXPECT_FALSE(agree({"energy drift max 1e-3, bounded", ""}, printed));
  EXPECT_FALSE(agree({"written to", "..."}, printed));
}

}  // namespace
