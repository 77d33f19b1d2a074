#include <pfaff/runs/support/term_magnitudes.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfaff {

namespace {
// The larger number in every lane, as std::max has it.
Pack<8> larger(const Pack<8>& a, const Pack<8>& b) { return select(b - a, b, a); }
}  // namespace

TermMagnitudes::TermMagnitudes(std::shared_ptr<const Tape> tape)
    : replay_(std::move(tape)),
      outputs_(replay_.tape().outputs.size()),
      magnitudes_(replay_.tape().code.size()),
      largest_(outputs_.size()) {}

void TermMagnitudes::add(const Pack<8>& t, const Pack<8>* z) {
  replay_(t, z, outputs_.data());
  const auto value = [this](int slot) { return abs(replay_.slots()[static_cast<std::size_t>(slot)]); };
  const auto magnitude = [this](int slot) -> const Pack<8>& {
    return magnitudes_[static_cast<std::size_t>(slot)];
  };
  for (std::size_t k = 0; k < magnitudes_.size(); ++k) {
    const Instruction i = replay_.tape().code[k];
    switch (i.operation) {
      case Operation::negate:
        magnitudes_[k] = magnitude(i.a);
        break;
      case Operation::add:
      case Operation::subtract:
        magnitudes_[k] = magnitude(i.a) + magnitude(i.b);
        break;
      case Operation::multiply:
        magnitudes_[k] = larger(magnitude(i.a) * value(i.b), value(i.a) * magnitude(i.b));
        break;
      case Operation::divide:
        magnitudes_[k] = larger(magnitude(i.a), value(i.a) * magnitude(i.b) / value(i.b)) / value(i.b);
        break;
      default:
        magnitudes_[k] = value(static_cast<int>(k));
    }
  }
  for (std::size_t k = 0; k < largest_.size(); ++k) {
    const Pack<8>& of_states = magnitude(replay_.tape().outputs[k]);
    for (std::size_t lane = 0; lane < 8; ++lane)
      if (std::isfinite(of_states[lane])) largest_[k] = std::max(largest_[k], of_states[lane]);
  }
}

}  // namespace pfaff
