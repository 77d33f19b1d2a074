// Counts of a tape's operations.
#include <algorithm>

#include <pfaff/core/tape/operands.hpp>
#include <pfaff/derive/derivation/derivation.hpp>

namespace pfaff {

namespace {
bool computes(const Instruction& i) {
  return i.operation != Operation::constant && i.operation != Operation::time &&
         i.operation != Operation::input;
}
}  // namespace

std::size_t operations(const Tape& tape) {
  return static_cast<std::size_t>(std::count_if(tape.code.begin(), tape.code.end(), computes));
}

double tree_operations(const Tape& tape) {
  std::vector<double> size(tape.code.size());
  for (std::size_t k = 0; k < tape.code.size(); ++k) {
    // A cosine reads what its sine reads.
    const Instruction& i = tape.code[group_start(tape.code, k)];
    size[k] = computes(i) ? 1 : 0;
    operands(i, tape.solves, [&](int slot) { size[k] += size[static_cast<std::size_t>(slot)]; });
  }
  double sum = 0;
  for (const int slot : tape.outputs) sum += size[static_cast<std::size_t>(slot)];
  return sum;
}

}  // namespace pfaff
