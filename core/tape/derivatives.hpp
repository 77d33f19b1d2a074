// Composition and differentiation of tapes, onto new tapes.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <pfaff/core/tape/recorder.hpp>

namespace pfaff {

/// The outputs of `tape` as recorded expressions of recorded arguments (composition of formulas).
std::vector<Recorded> evaluate(const Tape& tape, const Recorded& t, std::span<const Recorded> z);

/// One directional derivative (forward mode) of every output: d/ds f(t + s t_direction, z + s direction) at s
/// = 0.
std::vector<Recorded> directional_derivative(const Tape& tape, const Recorded& t, const Recorded& t_direction,
                                             std::span<const Recorded> z,
                                             std::span<const Recorded> direction);

/// The gradient in z (reverse mode) of sum_k weights[k] * output k. Cost: a small multiple of one evaluation,
/// whatever the dimension.
std::vector<Recorded> gradient(const Tape& tape, const Recorded& t, std::span<const Recorded> z,
                               std::span<const Recorded> weights);

/// The partial derivative in time of every output.
std::vector<Recorded> time_derivative(const Tape& tape, const Recorded& t, std::span<const Recorded> z);

/// The Jacobian of the outputs in z, row-major, outputs x inputs.
std::vector<Recorded> jacobian(const Tape& tape, const Recorded& t, std::span<const Recorded> z);

/// A tape whose outputs are the Jacobian of `tape`, row-major.
Tape jacobian_tape(const Tape& tape);

}  // namespace pfaff
