// The index by which a recorder finds equal instructions, against a map of the standard library.
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <tuple>

#include <pfaff/core/tape/instruction_index.hpp>

namespace {
using namespace pfaff;

Instruction drawn(std::mt19937& random, int largest) {
  std::uniform_int_distribution<int> operation(0, 7), operand(-1, largest);
  return {static_cast<Operation>(operation(random)), operand(random), operand(random), operand(random)};
}

// Few different operands, so that most instructions come again, and many, so that tables grow often and there
// are many of them.
TEST(InstructionIndex, FindsWhatAMapFinds) {
  for (const int largest : {1, 5, 700, 1000000}) {
    std::mt19937 random(7);
    InstructionIndex index;
    std::vector<Instruction> code;
    std::map<std::tuple<Operation, int, int, int>, int> expected;
    for (int k = 0; k < 5000; ++k) {
      const Instruction i = drawn(random, largest);
      const auto [where, added] =
          expected.try_emplace({i.operation, i.a, i.b, i.c}, static_cast<int>(code.size()));
      ASSERT_EQ(index.find(i, code), added ? InstructionIndex::none : where->second) << k;
      if (!added) continue;
      code.push_back(i);
      index.add(static_cast<int>(code.size()) - 1, code);
    }
    // What stands in the code without having been added, as unknowns of a solve do, is not found.
    code.push_back({Operation::solve, largest + 1, 0, 0});
    EXPECT_EQ(index.find(code.back(), code), InstructionIndex::none);
  }
}
}  // namespace
