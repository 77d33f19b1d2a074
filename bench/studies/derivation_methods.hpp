// The methods that derive equations of motion, by name, and the forms in which equations are shown.
#pragma once

#include <string>
#include <vector>

namespace pfaff {

enum class DerivationWay {
  ldl,
  simplified,
  lmm,
  recursion,
  recursion_literal,
  bivector,
  minors,
  nonholonomic,
  birkhoffian,
  generating_function
};

/// A way to derive equations of motion.
struct DerivationMethod {
  DerivationWay way;
  std::string name, title;
};
/// All of them.
const std::vector<DerivationMethod>& derivation_methods();
/// The method of that name. InputError for an unknown one.
const DerivationMethod& derivation_method(const std::string& name);

/// In what form equations are shown: "counts", how large they are, or a language.
std::vector<std::string> derivation_forms();

}  // namespace pfaff
