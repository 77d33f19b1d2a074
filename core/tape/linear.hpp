// Linear formulas: those whose results are fixed combinations of the state, whatever the time.
#pragma once

#include <pfaff/core/tape/tape.hpp>

namespace pfaff {

/// True where every output is seen from the instructions to be a linear combination of the inputs with
/// constant coefficients, without a constant term. A formula that is linear only because terms cancel is not
/// seen to be.
[[nodiscard]] bool linear(const Tape& tape);

/// True where output k is input k and there are no others.
[[nodiscard]] bool identity(const Tape& tape);

}  // namespace pfaff
