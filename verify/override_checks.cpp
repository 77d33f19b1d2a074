// Formulas that an author has written although they could be derived: each must agree with the derived one.
#include <pfaff/verify/residuals.hpp>

namespace pfaff {

std::vector<Check> check_overrides(const std::string& plugin, const Model& model, const Region& region) {
  std::vector<Check> checks;
  for (const StatedIdentity& stated : written_formulas(model)) {
    const Region inputs = region.first(static_cast<std::size_t>(stated.residual->inputs));
    both(checks, plugin, stated.words, plugin, stated.residual, with_branches_of(*stated.residual, inputs));
  }
  return checks;
}

}  // namespace pfaff
