// Parameters near the defaults, with which claims are verified besides: what an author claims without a
// condition holds for every value in the ranges that the author states.
#pragma once

#include <pfaff/core/bracket.hpp>
#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/system.hpp>

namespace pfaff {

/// Settings of all real numbers of a plug-in near their defaults, `count` at most, drawn with a fixed seed:
/// between 5/8 and 11/8 of the default, or of the size of one where that is zero. Those that the plug-in
/// refuses are left out.
std::vector<Assignments> parameters_near_defaults(const MethodPlugin& method, int count);
/// The same of a system, whose initial state may be off its constraints with them.
std::vector<Assignments> parameters_near_defaults(const SystemPlugin& system, int count);
/// The same of a bracket.
std::vector<Assignments> parameters_near_defaults(const BracketPlugin& bracket, int count);

/// Of each choice and each whole number of a few values the other values, one at a time: nothing is near to
/// them. None that one of the `instances` has.
std::vector<Assignments> other_values(const MethodPlugin& method, const std::vector<Assignments>& instances);

}  // namespace pfaff
