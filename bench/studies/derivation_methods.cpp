#include <pfaff/bench/studies/derivation_methods.hpp>

#include <pfaff/core/emit/emitter.hpp>
#include <pfaff/core/errors/errors.hpp>

namespace pfaff {

const std::vector<DerivationMethod>& derivation_methods() {
  using enum DerivationWay;
  static const std::vector<DerivationMethod> methods{
      {ldl, "ldl", "Dirac's equations, S factored in its sparsity"},
      {simplified, "simplified", "Dirac's equations with the hidden constraints set to zero in them"},
      {lmm, "lmm", "Lagrange's multipliers"},
      {recursion, "recursion", "one pair of constraints after the other, by vectors"},
      {recursion_literal, "recursion-literal", "the recursion word for word, each bracket made once"},
      {bivector, "bivector", "the recursion on the whole bracket, by updates of rank 2"},
      {minors, "minors", "Dirac's equations with the closed inverse of a chain's S"},
      {nonholonomic, "nonholonomic", "projected equations of velocity constraints"},
      {birkhoffian, "birkhoffian", "K^-1 (grad B + F_t), the structure solved for the rates"},
      {generating_function, "generating-function",
       "the field in a chart, and coefficients of its generating function"}};
  return methods;
}

const DerivationMethod& derivation_method(const std::string& name) {
  std::vector<std::string> names;
  for (const DerivationMethod& method : derivation_methods()) {
    if (method.name == name) return method;
    names.push_back(method.name);
  }
  throw InputError(unknown_name("method", name, names));
}

std::vector<std::string> derivation_forms() {
  std::vector<std::string> names{"counts"};
  for (const Emitter& emitter : emitters()) names.emplace_back(emitter.name);
  return names;
}

}  // namespace pfaff
