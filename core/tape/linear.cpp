#include <pfaff/core/tape/linear.hpp>

#include <algorithm>
#include <vector>

namespace pfaff {

namespace {
// What a slot is known to be.
enum class Kind { constant, linear, other };

Kind sum_of(Kind a, Kind b) { return a == b ? a : Kind::other; }
Kind product_of(Kind a, Kind b) {
  if (a == Kind::constant) return b;
  return b == Kind::constant ? a : Kind::other;
}
}  // namespace

bool linear(const Tape& tape) {
  std::vector<Kind> kinds(tape.code.size(), Kind::other);
  const auto at = [&](int slot) { return kinds[static_cast<std::size_t>(slot)]; };
  const auto all = [&](const std::vector<int>& slots, Kind kind) {
    return std::all_of(slots.begin(), slots.end(), [&](int slot) { return at(slot) == kind; });
  };
  for (std::size_t k = 0; k < tape.code.size(); ++k) {
    const Instruction& i = tape.code[k];
    switch (i.operation) {
      case Operation::constant:
        kinds[k] = Kind::constant;
        break;
      case Operation::input:
        kinds[k] = Kind::linear;
        break;
      case Operation::negate:
        kinds[k] = at(i.a);
        break;
      case Operation::add:
      case Operation::subtract:
        kinds[k] = sum_of(at(i.a), at(i.b));
        break;
      case Operation::multiply:
        kinds[k] = product_of(at(i.a), at(i.b));
        break;
      case Operation::divide:
        kinds[k] = at(i.b) == Kind::constant ? at(i.a) : Kind::other;
        break;
      case Operation::square_root:
      case Operation::exponential:
      case Operation::logarithm:
      case Operation::sine:
      case Operation::cosine:
      case Operation::power:
      case Operation::special:
        kinds[k] = at(i.a) == Kind::constant ? Kind::constant : Kind::other;
        break;
      case Operation::solve: {
        const LinearSystem& system = tape.solves[static_cast<std::size_t>(i.a)];
        const bool solved = all(system.matrix, Kind::constant) && all(system.right_hand_side, Kind::linear);
        kinds[k] = solved ? Kind::linear : Kind::other;
        break;
      }
      case Operation::solve_next:
        kinds[k] = kinds[k - 1];
        break;
      case Operation::time:
      case Operation::select:
        break;
    }
  }
  return all(tape.outputs, Kind::linear);
}

bool identity(const Tape& tape) {
  if (tape.outputs.size() != static_cast<std::size_t>(tape.inputs)) return false;
  for (int k = 0; k < tape.inputs; ++k) {
    const auto slot = static_cast<std::size_t>(tape.outputs[static_cast<std::size_t>(k)]);
    if (tape.code[slot].operation != Operation::input || tape.code[slot].a != k) return false;
  }
  return true;
}

}  // namespace pfaff
