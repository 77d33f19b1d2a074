// Is a formula a polynomial of the state, and of which degree?
#pragma once

#include <optional>

#include <pfaff/core/tape/tape.hpp>

namespace pfaff {

/// A bound of the degree in the state of every output, as the operations of the tape show it; nullopt where
/// they do not make polynomials. Terms that cancel are counted, so that the degree itself may be lower.
/// Coefficients may be any functions of time.
std::optional<int> polynomial_degree(const Tape& tape);

}  // namespace pfaff
