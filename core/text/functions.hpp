// The functions of expressions.
#pragma once

#include <span>

#include <pfaff/core/tape/recorder.hpp>
#include <pfaff/core/text/expression.hpp>

namespace pfaff::text {

/// A function and what it computes from as many values as it has arguments. Powers and select, which see how
/// their arguments are written, have no value here: a scope computes them.
struct KnownFunction {
  Function function;
  Recorded (*value)(std::span<const Recorded> arguments) = nullptr;
};

/// All of them.
std::span<const KnownFunction> known_functions();

/// The one of a name; null where there is none.
const KnownFunction* known_function(std::string_view name);

}  // namespace pfaff::text
