#include <pfaff/runs/support/term_magnitudes.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfaff {

TermMagnitudes::TermMagnitudes(std::shared_ptr<const Tape> tape)
    : replay_(std::move(tape)),
      outputs_(replay_.tape().outputs.size()),
      magnitudes_(replay_.tape().code.size()),
      largest_(outputs_.size()) {}

void TermMagnitudes::add(double t, const std::vector<double>& z) {
  replay_(t, z.data(), outputs_.data());
  const auto value = [this](int slot) { return std::abs(replay_.slots()[static_cast<std::size_t>(slot)]); };
  const auto magnitude = [this](int slot) { return magnitudes_[static_cast<std::size_t>(slot)]; };
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
        magnitudes_[k] = std::max(magnitude(i.a) * value(i.b), value(i.a) * magnitude(i.b));
        break;
      case Operation::divide:
        magnitudes_[k] = std::max(magnitude(i.a), value(i.a) * magnitude(i.b) / value(i.b)) / value(i.b);
        break;
      default:
        magnitudes_[k] = value(static_cast<int>(k));
    }
  }
  for (std::size_t k = 0; k < largest_.size(); ++k) {
    const double m = magnitude(replay_.tape().outputs[k]);
    if (std::isfinite(m)) largest_[k] = std::max(largest_[k], m);
  }
}

}  // namespace pfaff
