// Dense linear systems of a tape written out as divisions, products and differences.
#pragma once

#include <string>

#include <pfaff/core/tape/tape.hpp>

namespace pfaff {

/// The same formula without operations that solve. The order of elimination is found with numbers, at one
/// generic point, and then fixed: the formulas hold wherever the pivots of that order do not vanish, and lose
/// digits near there, where the systems themselves, pivoted at every point, do not. InputError where a system
/// is singular at that point; `what` begins the message.
Tape explicit_solves(const Tape& tape, const std::string& what);

}  // namespace pfaff
