// Another name for a registered method with some of its parameters set, such as
//
//   const MethodAlias yoshida_verlet{composition, "yoshida-verlet", {{"scheme", "yoshida"}, {"base",
//   "verlet"}}};
//
// Former names of methods stay valid this way. An alias is run, described, verified and named in experiments
// like a method, and the output of a run calls it by its own name; only lists of the methods leave it out.
#pragma once

#include <mutex>

#include <pfaff/core/facets/method_instance.hpp>

namespace pfaff {

namespace detail {

/// An alias of `method`. Parameters that `presets` sets are not parameters of the alias. `shortened` gives
/// short names to settings of a plug-in that the presets choose, such as {"compensated", "base.compensated"};
/// under these names they are parameters of the alias.
class AliasPlugin final : public MethodPlugin {
 public:
  AliasPlugin(const MethodPlugin& method, const std::string& name, Assignments presets,
              Assignments shortened = {},
              const std::source_location& where = std::source_location::current());

  [[nodiscard]] const std::vector<Parameter>& parameters() const override;
  [[nodiscard]] std::unique_ptr<MethodInstance> make(const Assignments& assignments) const override;
  /// The method's instances that agree with the presets.
  [[nodiscard]] std::vector<Assignments> instances(bool full) const override;

 private:
  const MethodPlugin& method_;
  Assignments presets_, shortened_;
  // Made when they are first asked for, because plug-ins that the presets name may register after the alias.
  mutable std::once_flag made_;
  mutable std::vector<Parameter> parameters_;
};

/// In its place in the unit that registers nothing (core/facets/scalar_units.hpp).
struct NoAlias {
  template <class Method>
  NoAlias(const Method& /*method*/, std::string_view /*name*/, const Assignments& /*presets*/,
          const Assignments& /*shortened*/ = {}) {}
};

}  // namespace detail

/// Registers an alias of a method, which has to be defined above it in the same file so that it is
/// constructed first.
using MethodAlias = std::conditional_t<std::is_same_v<detail::ThisUnit, detail::InDouble>, detail::NoAlias,
                                       detail::AliasPlugin>;

}  // namespace pfaff
