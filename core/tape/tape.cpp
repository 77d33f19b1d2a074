// Turning what was recorded into a tape, and what a tape depends on.
#include <algorithm>

#include <pfaff/core/tape/operands.hpp>
#include <pfaff/core/tape/recorder.hpp>

namespace pfaff {

bool Tape::autonomous() const {
  std::vector<char> timed(code.size(), 0);
  for (std::size_t k = 0; k < code.size(); ++k) {
    const Instruction& i = code[k];
    const auto from = [&](int slot) { return timed[static_cast<std::size_t>(slot)]; };
    switch (i.operation) {
      case Operation::constant:
      case Operation::input:
        break;
      case Operation::time:
        timed[k] = 1;
        break;
      case Operation::add:
      case Operation::subtract:
      case Operation::multiply:
      case Operation::divide:
      case Operation::special:
        timed[k] = from(i.a) | from(i.b);
        break;
      case Operation::select:
        timed[k] = from(i.a) | from(i.b) | from(i.c);
        break;
      case Operation::solve: {
        const LinearSystem& s = solves[static_cast<std::size_t>(i.a)];
        for (const int slot : s.matrix) timed[k] |= from(slot);
        for (const int slot : s.right_hand_side) timed[k] |= from(slot);
        break;
      }
      case Operation::solve_next:
        timed[k] = timed[k - 1];
        break;
      default:
        timed[k] = from(i.a);
        break;
    }
  }
  return std::none_of(outputs.begin(), outputs.end(),
                      [&](int slot) { return timed[static_cast<std::size_t>(slot)] != 0; });
}

bool Tape::state_independent() const {
  return std::all_of(outputs.begin(), outputs.end(), [&](int slot) { return slot < state_begin; });
}

Tape Recorder::finish(std::span<const Recorded> outputs) {
  std::vector<int> results;
  results.reserve(outputs.size());
  for (const Recorded& output : outputs) results.push_back(slot_of(output));

  // Mark what the outputs need, last instruction first. A group is kept whole.
  const std::size_t n = code_.size();
  std::vector<char> needed(n, 0);
  for (const int slot : results) needed[static_cast<std::size_t>(slot)] = 1;
  for (std::size_t k = n; k-- > 0;) {
    if (needed[k] == 0) continue;
    const std::size_t start = group_start(code_, k);
    for (std::size_t g = start; g < n && group_start(code_, g) == start; ++g) needed[g] = 1;
    operands(code_[start], solves_, [&](int slot) { needed[static_cast<std::size_t>(slot)] = 1; });
  }

  // Dependence: 0 constants, 1 time, 2 state.
  std::vector<char> level(n, 0);
  for (std::size_t k = 0; k < n; ++k) {
    if (code_[k].operation == Operation::time) level[k] = 1;
    if (code_[k].operation == Operation::input) level[k] = 2;
    const std::size_t start = group_start(code_, k);
    if (start != k) level[k] = level[start];
    operands(code_[k], solves_,
             [&](int slot) { level[k] = std::max(level[k], level[static_cast<std::size_t>(slot)]); });
    // A function of constants alone that could not be folded is evaluated with the time part.
    if (code_[k].operation != Operation::constant) level[k] = std::max<char>(level[k], 1);
  }

  Tape tape;
  tape.inputs = inputs_;
  tape.code.reserve(static_cast<std::size_t>(std::count(needed.begin(), needed.end(), 1)));
  tape.outputs.reserve(results.size());
  std::vector<int> place(n, -1);
  for (int l = 0; l <= 2; ++l) {
    if (l == 1) tape.time_begin = static_cast<int>(tape.code.size());
    if (l == 2) tape.state_begin = static_cast<int>(tape.code.size());
    for (std::size_t k = 0; k < n; ++k)
      if (needed[k] != 0 && level[k] == l) {
        place[k] = static_cast<int>(tape.code.size());
        tape.code.push_back(code_[k]);
      }
  }
  const auto moved = [&](int slot) { return place[static_cast<std::size_t>(slot)]; };
  for (Instruction& i : tape.code) {
    switch (i.operation) {
      case Operation::constant:
        tape.constants.push_back(constants_[static_cast<std::size_t>(i.a)]);
        i.a = static_cast<int>(tape.constants.size()) - 1;
        break;
      case Operation::time:
      case Operation::input:
      case Operation::solve_next:
        break;
      case Operation::add:
      case Operation::subtract:
      case Operation::multiply:
      case Operation::divide:
      case Operation::special:
        i.a = moved(i.a);
        i.b = moved(i.b);
        break;
      case Operation::power:
        i.a = moved(i.a);
        tape.constants.push_back(constants_[static_cast<std::size_t>(i.b)]);
        i.b = static_cast<int>(tape.constants.size()) - 1;
        break;
      case Operation::select:
        i.a = moved(i.a);
        i.b = moved(i.b);
        i.c = moved(i.c);
        break;
      case Operation::solve: {
        LinearSystem system = solves_[static_cast<std::size_t>(i.a)];
        for (int& slot : system.matrix) slot = moved(slot);
        for (int& slot : system.right_hand_side) slot = moved(slot);
        tape.solves.push_back(std::move(system));
        i.a = static_cast<int>(tape.solves.size()) - 1;
        break;
      }
      default:
        i.a = moved(i.a);
        break;
    }
  }
  for (const int slot : results) tape.outputs.push_back(moved(slot));
  return tape;
}

bool Tape::zero() const {
  return std::all_of(outputs.begin(), outputs.end(), [&](int slot) {
    const Instruction& i = code[static_cast<std::size_t>(slot)];
    return i.operation == Operation::constant && constants[static_cast<std::size_t>(i.a)].is(0);
  });
}

}  // namespace pfaff
