// What is taken for the error of a run when methods are compared: in work and precision, in times to an
// error, at equal cost, and where steps are chosen.
//
//   the state      the largest |z - z_exact| / |z_exact| over the run, without the key `error` of a case
//   a quantity I   the largest |I - I(0)| / |I(0)| over the run, where the case says error = "I"
//
// A case that has neither a solution nor that key is compared by the largest |I - I(0)| of its conserved
// quantity, in the unit of I.
#pragma once

#include <string>

#include <pfaff/bench/experiment/experiment.hpp>

namespace pfaff {

/// The error of a run that ended well, by the measure of its case; NaN where it was not measured.
double error_of(const ExperimentCase& one, const nlohmann::json& summary);

/// The same of a run that has left no summary.
double error_of(const ExperimentCase& one, const ResolvedRun& run, const RunRecord& record);

/// Why the quantity that the case takes for its error cannot be that of the run: its model does not conserve
/// it, or it is zero at the start to within the rounding of its terms. Empty where it can, and where the case
/// takes none. InputError, naming the nearest invariant, where the model has no such quantity.
std::string error_refused(const ExperimentCase& one, const ResolvedRun& run);

}  // namespace pfaff
