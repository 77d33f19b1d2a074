// The gradients of all outputs of a tape, row by row, where most of their entries are zero by construction.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <pfaff/core/tape/recorder.hpp>

namespace pfaff {

/// The entries of a gradient that are not zero by construction, with their inputs, in ascending order.
using SparseGradient = std::vector<std::pair<std::size_t, Recorded>>;

/// The gradient of every output in the first `variables` inputs (reverse mode). The sweep of an output visits
/// only the instructions that it depends on, so that the constraints of a long chain cost a time linear in
/// their number.
std::vector<SparseGradient> sparse_gradients(const Tape& tape, const Recorded& t, std::span<const Recorded> z,
                                             std::size_t variables);

}  // namespace pfaff
