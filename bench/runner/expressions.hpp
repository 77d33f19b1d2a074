// Numbers that are asked for by expressions: --step "2*pi/200", time = "20*period".
#pragma once

#include <string>

#include <pfaff/core/registry/parameter.hpp>

namespace pfaff {

/// A number as text: the text itself where it is one, otherwise the value of the expression that it is, in
/// which names stand for pi and for those of `parameters` that are numbers. A text that is neither is given
/// back, for whoever reads the number to refuse. TextError, with `what` in the place of a file, for an
/// expression of other names and for one that has no finite value.
std::string evaluated(const std::string& text, const std::string& what, const Assignments& parameters = {});

}  // namespace pfaff
