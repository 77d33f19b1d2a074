// Makes models of text declarations: every formula is evaluated onto a tape, as a formula written in C++ is.
#pragma once

#include <pfaff/systems/text/declaration.hpp>

namespace pfaff::text {

/// What the Model of a declaration is made of, with these values of its parameters, in their order. TextError
/// for what is wrong in a formula or does not have the size that it should.
ModelSource model_source(const TextDeclaration& declaration, const std::vector<Real>& values);

}  // namespace pfaff::text
