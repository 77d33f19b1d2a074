// The keys of a case of an experiment that say at which steps it is run, and its numbers.
#pragma once

#include <string>

#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/runner/toml_keys.hpp>

namespace pfaff {

/// Reads `steps`, a list or "auto", and `evaluations` where they are there; what is not keeps its value.
/// InputError for anything else.
void read_steps(Keys& keys, ExperimentCase& one);

/// Refuses a case that has no steps, evaluations without automatic steps, and automatic steps without a
/// solution, by whose distance they are chosen. `where` begins the message.
void check_steps(const ExperimentCase& one, const std::string& where);

/// The size of a step that is given with the sign of a duration: what experiments name it by.
std::string without_sign(const std::string& step);

/// A step or a tolerance as the decimal that it stands as in tables, of 34 digits where a fraction has no
/// end; a text that is no fraction as it is.
std::string as_decimal(const std::string& number);

/// Puts numbers in the place of the expressions among time, steps and initial state, which read the
/// parameters of the case's system; steps beside a negative time lose a sign that they have. TextError, which
/// begins with `where`, for other names.
void evaluate_numbers(ExperimentCase& one, const std::string& where);

}  // namespace pfaff
