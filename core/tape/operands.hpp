// Which slots an instruction of a tape reads.
#pragma once

#include <vector>

#include <pfaff/core/tape/tape.hpp>

namespace pfaff {

/// Calls visit(slot) for every slot that an instruction reads. The slots of a linear system are read by the
/// first instruction of its group.
template <class Visit>
void operands(const Instruction& i, const std::vector<LinearSystem>& solves, Visit&& visit) {
  switch (i.operation) {
    case Operation::constant:
    case Operation::time:
    case Operation::input:
    case Operation::solve_next:
      return;
    case Operation::add:
    case Operation::subtract:
    case Operation::multiply:
    case Operation::divide:
    case Operation::special:
      visit(i.a);
      visit(i.b);
      return;
    case Operation::select:
      visit(i.a);
      visit(i.b);
      visit(i.c);
      return;
    case Operation::solve:
      for (const int slot : solves[static_cast<std::size_t>(i.a)].matrix) visit(slot);
      for (const int slot : solves[static_cast<std::size_t>(i.a)].right_hand_side) visit(slot);
      return;
    default:
      visit(i.a);
      return;
  }
}

/// The first instruction of the group that writes slot k. A group is a sine with its cosine or all components
/// of a linear solve; other instructions are groups of one.
inline std::size_t group_start(const std::vector<Instruction>& code, std::size_t k) {
  if (code[k].operation == Operation::cosine) return k - 1;
  if (code[k].operation == Operation::solve_next) return k - static_cast<std::size_t>(code[k].b);
  return k;
}

}  // namespace pfaff
