// Results are the same bits whatever instructions the build uses and however it is optimised. The systems
// here are made of sums, products, quotients and square roots, which every machine rounds alike; functions
// such as sin depend on the C library too.
#include <fstream>
#include <sstream>

#include "command.hpp"

namespace {
using namespace pfaff::testing;

// The last row that a run prints, all of whose digits are given.
std::string last_row(const std::string& arguments) {
  std::vector<std::string> words{"run"};
  std::istringstream stream(arguments);
  for (std::string word; stream >> word;)
    words.push_back(word.starts_with("examples/") ? PFAFF_GOLDEN "/../../" + word : word);
  words.insert(words.end(), {"--out", "-", "--quiet", "--reference", "none"});
  const Outcome outcome = run_pfaff(words);
  EXPECT_EQ(outcome.status, 0) << arguments << ": " << outcome.err;
  std::istringstream lines(outcome.out);
  std::string last;
  for (std::string line; std::getline(lines, line);) last = line;
  return last;
}

// Lines in pairs: what is run, and the row that a build for every machine, without optimisation, ended with.
TEST(SameBits, WhateverTheInstructions) {
  std::ifstream file(PFAFF_GOLDEN "/same_bits.txt");
  int runs = 0;
  std::string row;
  for (std::string arguments; std::getline(file, arguments) && std::getline(file, row); ++runs)
    EXPECT_EQ(last_row(arguments), row) << arguments;
  EXPECT_EQ(runs, 18);
}

// The control: a step that is longer by one unit in the last place ends elsewhere.
TEST(SameBits, OneBitIsSeen) {
  EXPECT_NE(last_row("kepler gauss --set stages=8 --step 0.1 --time 20"),
            last_row("kepler gauss --set stages=8 --step 0.10000000000000002 --time 20"));
}

}  // namespace
