// The plug-ins that settings name and the numbers that they give, and what is said where a name, a number or
// a pair of plug-ins does not fit.
#pragma once

#include <string>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/system.hpp>

namespace pfaff {

/// The finite decimal number or fraction that a text is. InputError, which says `what` the text is,
/// otherwise.
Real finite_number(const std::string& text, const std::string& what);

/// A name in small letters.
std::string in_small_letters(std::string name);
/// A name as plug-ins are registered, in small letters, where it is that of one in others; else as it stands.
std::string spelled(const std::string& name);

/// The system or integrator of that name, in whatever letters, or of that file. InputError for an unknown
/// name, which says so where it is that of the other kind.
const SystemPlugin& system_asked_for(const std::string& name);
const MethodPlugin& integrator_asked_for(const std::string& name);

/// What whoever is told that a method refuses a model can do: write energies apart, or take another method.
/// To follow the refusal; may be empty.
std::string what_to_do(const MethodInstance& method, const Model& model);

/// ", or one of taylor, ...": the methods that choose their steps on a model; empty where there are none.
std::string or_methods_that_choose(const Model& model);

}  // namespace pfaff
