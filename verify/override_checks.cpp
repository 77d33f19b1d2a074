// Formulas that an author has written although they could be derived: each must agree with the derived one.
#include <algorithm>

#include <pfaff/verify/residuals.hpp>

namespace pfaff {

namespace {

bool has_branches(const Tape& tape) {
  return std::any_of(tape.code.begin(), tape.code.end(),
                     [](const Instruction& i) { return i.operation == Operation::select; });
}

// The region with a box about what the motion reaches, four times as large, where no ranges are stated.
// Formulas without branches that agree near the motion agree wherever they have values, because they are
// analytic; a branch that the motion does not take shows beyond alone.
Region with_other_branches(Region region) {
  constexpr double times = 4;
  if (!region.box.empty() || region.surface != nullptr) return region;
  for (std::size_t k = 0; k < region.centres.front().size(); ++k) {
    double smallest = region.centres.front()[k].value(), largest = smallest;
    for (const std::vector<Real>& centre : region.centres) {
      smallest = std::min(smallest, centre[k].value());
      largest = std::max(largest, centre[k].value());
    }
    const double middle = (smallest + largest) / 2, reach = times * (largest - smallest) / 2;
    region.box.push_back(reach > 0 ? Range{middle - reach, middle + reach} : unbounded);
  }
  return region;
}

}  // namespace

std::vector<Check> check_overrides(const std::string& plugin, const Model& model, const Region& region) {
  std::vector<Check> checks;
  for (const StatedIdentity& stated : written_formulas(model)) {
    const Region inputs = region.first(static_cast<std::size_t>(stated.residual->inputs));
    both(checks, plugin, stated.words, plugin, stated.residual,
         has_branches(*stated.residual) ? with_other_branches(inputs) : inputs);
  }
  return checks;
}

}  // namespace pfaff
