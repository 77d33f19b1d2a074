// Random parameters of methods, for the search of counterexamples.
#pragma once

#include <cstdint>
#include <vector>

#include <pfaff/core/facets/method_instance.hpp>

namespace pfaff {

/// At most so many settings of all numbers and choices of a method, drawn from their ranges; a function of
/// the seed. Whole numbers are rarely drawn more than eight above the least, since what they count costs
/// time. Lists, files and the settings of plug-ins that are values stay as they are. Settings that the method
/// refuses, those of `known` and repetitions are left out.
std::vector<Assignments> drawn_parameters(const MethodPlugin& plugin, const std::vector<Assignments>& known,
                                          std::uint64_t seed, int count);

}  // namespace pfaff
