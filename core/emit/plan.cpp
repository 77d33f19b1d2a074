#include <pfaff/core/emit/plan.hpp>

namespace pfaff::emit {

bool is_atom(const Instruction& i) {
  return i.operation == Operation::constant || i.operation == Operation::time ||
         i.operation == Operation::input;
}

Plan::Plan(const Tape& tape, const PlanRules& rules)
    : named_(tape.code.size(), 0), operations_(tape.code.size(), 0) {
  const std::size_t n = tape.code.size();
  std::vector<int> uses(n, 0);
  std::vector<char> output(n, 0);
  const auto at = [](int slot) { return static_cast<std::size_t>(slot); };
  for (const int slot : tape.outputs) {
    ++uses[at(slot)];
    output[at(slot)] = 1;
  }
  for (std::size_t k = n; k-- > 0;) {
    const Instruction& i = tape.code[k];
    if (uses[k] == 0) continue;
    if (i.operation == Operation::solve_next) {
      ++uses[group_start(tape.code, k)];
    } else if (rules.squares && i.operation == Operation::multiply && i.a == i.b) {
      ++uses[at(i.a)];
    } else {
      written_operands(i, tape.solves, [&](int slot) { ++uses[at(slot)]; });
    }
  }

  const auto stands_alone = [&](int slot) { return named(slot) || is_atom(tape.code[at(slot)]); };
  for (std::size_t k = 0; k < n; ++k) {
    const Instruction& i = tape.code[k];
    if (i.operation == Operation::solve_next) named_[k] = named_[k - 1];
    if (i.operation == Operation::solve_next || uses[k] == 0 || is_atom(i)) continue;
    int size = 1;
    written_operands(i, tape.solves,
                     [&](int slot) { size += stands_alone(slot) ? 0 : operations_[at(slot)]; });
    if (i.operation == Operation::solve) {
      const int order = tape.solves[at(i.a)].size;
      size += order * order * order;
    }
    operations_[k] = size;
    const bool sign = i.operation == Operation::negate && stands_alone(i.a);
    const bool paired = (i.operation == Operation::sine && uses[k + 1] > 0) ||
                        (i.operation == Operation::cosine && uses[k - 1] > 0);
    const bool long_one = i.operation == Operation::select || i.operation == Operation::solve;
    if ((uses[k] > 1 && !sign) || paired || long_one || size > rules.largest ||
        (rules.name_outputs && output[k] != 0)) {
      named_[k] = 1;
      statements_.push_back(static_cast<int>(k));
    }
  }
}

}  // namespace pfaff::emit
