// Which numbers of a tape get a variable of their own when it is written as text.
//
// A number that is used twice gets one, so that nothing is computed again; so do branches, the solutions of
// linear systems, a sine whose cosine is used too, and every expression that would grow too long. All others
// are written where they are used. The text is therefore as long as the tape, however deep the formula is.
#pragma once

#include <vector>

#include <pfaff/core/tape/tape.hpp>

namespace pfaff::emit {

struct PlanRules {
  int largest = 0;            // operations after which an expression gets a variable
  bool squares = false;       // x x is written as a power, in which x stands once
  bool name_outputs = false;  // every output that is computed gets a variable
};

class Plan {
 public:
  Plan(const Tape& tape, const PlanRules& rules);

  /// Whether the slot has a variable. Constants, the time and inputs have none of their own.
  [[nodiscard]] bool named(int slot) const { return named_[static_cast<std::size_t>(slot)] != 0; }
  /// The slots with variables in the order in which they are computed. Of a linear system only the first
  /// stands here, for all its components.
  [[nodiscard]] const std::vector<int>& statements() const { return statements_; }
  /// Operations in the expression that is written for the slot.
  [[nodiscard]] int operations(int slot) const { return operations_[static_cast<std::size_t>(slot)]; }

 private:
  std::vector<char> named_;
  std::vector<int> operations_, statements_;
};

/// True for a constant, the time or an input.
bool is_atom(const Instruction& instruction);

/// Calls visit(slot) for every constant, input, time and named slot in the expression that is written for
/// `slot`; of a linear system, in those of all its entries.
template <class Visit>
void visit_parts(const Tape& tape, const Plan& plan, int slot, Visit&& visit);

}  // namespace pfaff::emit

#include <pfaff/core/tape/operands.hpp>

namespace pfaff::emit {

// The operands in what is written for an instruction: a special function is written without its slope.
template <class Visit>
void written_operands(const Instruction& i, const std::vector<LinearSystem>& solves, Visit&& visit) {
  if (i.operation == Operation::special)
    visit(i.a);
  else
    operands(i, solves, visit);
}

template <class Visit>
void visit_parts(const Tape& tape, const Plan& plan, int slot, Visit&& visit) {
  written_operands(tape.code[static_cast<std::size_t>(slot)], tape.solves, [&](int part) {
    if (plan.named(part) || is_atom(tape.code[static_cast<std::size_t>(part)])) {
      visit(part);
    } else {
      visit_parts(tape, plan, part, visit);
    }
  });
}

}  // namespace pfaff::emit
