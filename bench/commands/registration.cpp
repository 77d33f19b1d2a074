// What the library of studies registers while it is loaded.
#include <pfaff/bench/commands/commands.hpp>
#include <pfaff/bench/derivation_growth/derivation_growth.hpp>
#include <pfaff/bench/studies/studies.hpp>

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
