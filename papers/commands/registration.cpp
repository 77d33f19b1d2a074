// What the library of studies registers while it is loaded.
#include <pfaff/bench/studies/studies.hpp>
#include <pfaff/derive/commands/commands.hpp>
#include <pfaff/derive/derivation_growth/derivation_growth.hpp>
#include <pfaff/papers/commands/commands.hpp>
#include <pfaff/verify/commands/commands.hpp>

namespace pfaff {

namespace {
const StudiesRegistration registered{{.verify = verify_command,
                                      .falsify = falsify_command,
                                      .reproduce = reproduce_command,
                                      .derive = derive_command,
                                      .tune = tune_command,
                                      .derivation_growth = derivation_growth}};
}  // namespace

}  // namespace pfaff
