#include <pfaff/systems/bead_rod/system.hpp>

#include <utility>

namespace pfaff {

std::shared_ptr<const Model> bead_rod_model(const SystemDescriptor& descriptor,
                                            BeadRodDescription description, Assignments parameters) {
  BeadRodFormulas formulas;
  formulas.described = std::move(description);
  return make_model(descriptor, formulas, std::move(parameters));
}

}  // namespace pfaff
