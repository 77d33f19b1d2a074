// Which checks a verification makes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <pfaff/verify/check.hpp>

namespace pfaff {

/// Checks that are made together: of a plug-in with one set of parameters, or of a method on one system.
struct VerificationJob {
  std::string what;  // as progress names it
  std::function<std::vector<Check>()> run;
  std::string of{};  // of a system: what it is asked for by
  std::string on{};  // of a method: what the system is asked for by
};

/// The checks that the settings ask for, in their order. InputError where a system without an initial state
/// is asked for by name.
std::vector<VerificationJob> verification_jobs(const VerificationSettings& settings);
/// Those of objects (verify() in check.hpp).
std::vector<VerificationJob> verification_jobs(const std::vector<MethodToVerify>& methods,
                                               const std::vector<std::shared_ptr<const Model>>& systems,
                                               const std::vector<std::shared_ptr<const Model>>& on);

/// Checks of a method on a system, and the controls of its coefficients where that is the system for them.
std::vector<Check> with_control(std::vector<Check> checks, const MethodInstance& method,
                                const Assignments& parameters, const SystemPlugin& system);

}  // namespace pfaff
